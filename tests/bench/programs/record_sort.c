// A table of parts in random order, sorted by two keys with whole records exchanged (Shell's method), then searched by halves.
#include <stdbool.h>
#include <stdio.h>

#define SIZE 2000
typedef struct {
    float weight, code, x, y, z;
    bool checked;
} part;
static part parts[SIZE];
static int seed = 7;

static int next_random(int limit) {
    seed = (seed * 137 + 29) % 30011;
    return seed % limit;
}

static bool is_before(const part* a, const part* b) {
    if (a->weight != b->weight) return a->weight < b->weight;
    return a->code < b->code;
}

static void fill(void) {
    for (int i = 1; i <= SIZE; i++) {
        const int weight = next_random(300), x = next_random(1000), y = next_random(1000);
        parts[i - 1] = (part){weight, i, x, y, i, i % 3 == 0};
    }
}

static void sort_parts(void) {
    for (int gap = 1000; gap > 0; gap /= 2)
        for (int i = gap; i < SIZE; i++) {
            const part moved = parts[i];
            int j = i;
            while (j >= gap && is_before(&moved, &parts[j - gap])) {
                parts[j] = parts[j - gap];
                j = j - gap;
            }
            parts[j] = moved;
        }
}

static int first_of(float weight) {
    int low = 1, high = SIZE + 1;
    while (low < high) {
        const int middle = (low + high) / 2;
        if (parts[middle - 1].weight < weight)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

int main(void) {
    int check = 0;
    for (int pass = 1; pass <= 300; pass++) {
        fill();
        sort_parts();
        for (int w = 0; w <= 299; w++)
            check = (check + first_of(w) * 3) % 99991;
        check = (int)(check + parts[pass - 1].code + parts[pass - 1].x) % 99991;
        if (parts[pass - 1].checked) check = check + 1;
    }
    printf("check %d\n", check);
    return 0;
}

// Records and arrays passed by value, some of them changed by the function, and records as results.
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { count = 16, samples = 9 };
typedef struct {
    float x, y, z;
} pos;
typedef struct {
    float id;
    pos size;
    float weight;
    bool fragile;
} box;
typedef struct {
    box bottom, top;
    float height;
} layer;
static box stock[count];

static box turned(box b) {
    const float x = b.size.x;
    b.size.x = b.size.y;
    b.size.y = x;
    return b;
}

static box filled(box b, float weight) {
    b.weight = b.weight + weight;
    if (b.weight > 60) {
        b.weight = b.weight - 60;
        b.fragile = !b.fragile;
    }
    return b;
}

static layer stacked(box a, box b) {
    if (a.weight < b.weight) return stacked(b, a);
    return (layer){a, b, a.size.z + b.size.z};
}

static float larger(float a, float b) {
    return a < b ? b : a;
}

static float overhang(layer l) {
    const float x = l.top.size.x - l.bottom.size.x;
    const float y = l.top.size.y - l.bottom.size.y;
    if (l.bottom.fragile) return x * x + y * y;
    return larger(x, 0) + larger(y, 0);
}

// Sorts its own copy of the list.
static float median(const float* values, int size) {
    float list[size];
    memcpy(list, values, sizeof list);
    for (int i = 1; i < size; i++) {
        const float value = list[i];
        int j = i;
        while (j > 0 && list[j - 1] > value) {
            list[j] = list[j - 1];
            j = j - 1;
        }
        list[j] = value;
    }
    return list[(size - 1) / 2];
}

static float spread(const float* list, int size, float middle) {
    float sum = 0;
    for (int i = 0; i < size; i++)
        sum = sum + fabsf(list[i] - middle);
    return sum;
}

int main(void) {
    float recent[samples] = {0}, saved[samples];
    layer l = {0};
    int sum = 0, spreads = 0, heavy = 0;
    for (int i = 1; i <= count; i++)
        stock[i - 1] = (box){(float)i,
                             {(float)(20 + i * 7 % 13), (float)(15 + i * 5 % 11), (float)(10 + i % 4)},
                             (float)(i * 3 % 17),
                             i % 2 == 0};
    for (int n = 1; n <= 8000000; n++) {
        l = stacked(stock[n % count], turned(stock[(n + 5) % count]));
        recent[n % samples] = overhang(l);
        stock[n % count] = filled(l.bottom, (float)(n % 5));
        stock[(n + 5) % count] = turned(l.top);
        memcpy(saved, recent, sizeof saved);
        const float middle = median(saved, samples);
        spreads = (spreads + (int)spread(recent, samples, middle)) % 99991;
        sum = (sum + (int)(l.height + middle)) % 99991;
        if (saved[0] > middle) heavy = heavy + 1;
    }
    printf("sum %d spreads %d\nheavy %d\n", sum, spreads, heavy);
    printf("last [%g,[%g,%g,%g],%g,%s]\n", l.top.id, l.top.size.x, l.top.size.y, l.top.size.z, l.top.weight,
           l.top.fragile ? "TRUE" : "FALSE");
    return 0;
}

#include <stdio.h>

enum { size = 20000 };
static float a[size];

static void quick(float* list, int first, int last) {
    int i = first, j = last;
    const float pivot = list[(first + last) / 2 - 1];
    while (i <= j) {
        while (list[i - 1] < pivot) i = i + 1;
        while (list[j - 1] > pivot) j = j - 1;
        if (i <= j) {
            const float t = list[i - 1];
            list[i - 1] = list[j - 1];
            list[j - 1] = t;
            i = i + 1;
            j = j - 1;
        }
    }
    if (first < j) quick(list, first, j);
    if (i < last) quick(list, i, last);
}

int main(void) {
    int check = 0;
    for (int n = 1; n <= 200; n++) {
        int seed = n;
        for (int i = 0; i < size; i++) {
            seed = (seed * 137 + 29) % 30011;
            a[i] = (float)seed;
        }
        quick(a, 1, size);
        check = (check + (int)a[n - 1] + (int)a[size / 2 - 1]) % 100000;
    }
    printf("check %d\n", check);
    return 0;
}

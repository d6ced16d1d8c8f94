#include <stdio.h>

enum { size = 1000 };
static float a[size], b[size];

int main(void) {
    float total = 0;
    for (int i = 1; i <= size; i++) {
        a[i - 1] = (float)(i % 7);
        b[i - 1] = (float)(i % 5 - 2);
    }
    for (int n = 1; n <= 400000; n++) {
        float sum = 0;
        for (int i = 0; i < size; i++) sum = sum + a[i] * b[i];
        total = total + sum;
        if (total > 1000000) total = 0;
        a[n % size] = (float)(n % 11);
    }
    printf("total %.0f\n", total);
    return 0;
}

#include <stdio.h>

enum { size = 2000 };
static float x[size], y[size];

int main(void) {
    float sum = 0;
    for (int i = 0; i < size; i++) {
        x[i] = (float)(i + 1);
        y[i] = 0;
    }
    for (int n = 1; n <= 1600000; n++) {
        for (int i = 0; i < size; i++) y[i] = y[i] * 0.5f + x[i];
        x[n % size] = (float)(n % 100);
    }
    for (int i = 0; i < size; i++) sum = sum + y[i];
    printf("sum %.1f\n", sum);
    return 0;
}

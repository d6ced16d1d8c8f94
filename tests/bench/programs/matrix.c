#include <stdio.h>

enum { size = 120 };
static float a[size][size], b[size][size], c[size][size];

static void multiply(float x[size][size], float y[size][size], float z[size][size]) {
    for (int i = 0; i < size; i++)
        for (int j = 0; j < size; j++) {
            float sum = 0;
            for (int k = 0; k < size; k++) sum = sum + x[i][k] * y[k][j];
            z[i][j] = sum;
        }
}

int main(void) {
    float trace = 0;
    for (int i = 1; i <= size; i++)
        for (int j = 1; j <= size; j++) {
            a[i - 1][j - 1] = (float)((i * j) % 10);
            b[i - 1][j - 1] = (float)((i + j) % 7 - 3);
        }
    for (int n = 1; n <= 360; n++) {
        multiply(a, b, c);
        a[n % size][n % size] = (float)(n % 5);
    }
    for (int i = 0; i < size; i++) trace = trace + c[i][i];
    printf("trace %.0f\n", trace);
    return 0;
}

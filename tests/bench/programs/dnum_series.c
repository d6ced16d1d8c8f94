#include <stdio.h>

int main(void) {
    double pi4 = 0, k = 1, seed = 42, sum = 0;
    for (int i = 1; i <= 60; i++)
        for (int j = 1; j <= 500000; j++) {
            pi4 = pi4 + 1 / k - 1 / (k + 2);
            k = k + 4;
        }
    printf("pi %.8f\n", 4 * pi4);
    for (int i = 1; i <= 300000; i++) {
        double e = 1, d = 20;
        while (d > 0) {
            e = 1 + e / d;
            d = d - 1;
        }
        sum = sum + e;
    }
    printf("e %.8f\n", sum / 300000);
    for (int i = 1; i <= 5000000; i++) seed = (double)((long long)(seed * 16807) % 2147483647LL);
    printf("seed %.0f\n", seed);
    return 0;
}

// Digits, common divisors and a table that is walked in steps of a parameter: whole numbers that loops carry through DIV and MOD.
#include <stdio.h>

#define SIZE 500
static float table[SIZE];

static int digit_sum(int value) {
    int sum = 0;
    for (; value > 0; value /= 10) sum += value % 10;
    return sum;
}

static int common_divisor(int a, int b) {
    while (b > 0) {
        const int rest = a % b;
        a = b;
        b = rest;
    }
    return a;
}

static float walked(int start, int stride) {
    float sum = 0;
    for (int i = start; i <= SIZE; i += stride) sum += table[i - 1];
    return sum;
}

int main(void) {
    int check = 0, seed = 1;
    for (int i = 0; i < SIZE; i++) {
        seed = (seed * 137 + 29) % 30011;
        table[i] = (float)(seed % 100);
    }
    for (int n = 1; n <= 10000000; n++) {
        check = (check + digit_sum(n) + common_divisor(n, 360)) % 99991;
        if (n % 8 == 0) check = (check + (int)walked(n % 50 + 1, n % 5 + 3)) % 99991;
    }
    printf("check %d\n", check);
    return 0;
}

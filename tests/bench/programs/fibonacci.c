#include <stdio.h>

static float fib(float n) {
    if (n < 2) return n;
    return fib(n - 1) + fib(n - 2);
}

int main(void) {
    float total = 0;
    for (int i = 1; i <= 3; i++) total = total + fib((float)(34 + i));
    printf("total %.0f\n", total);
    return 0;
}

#include <stdbool.h>
#include <stdio.h>

enum { limit = 1000000 };
static bool composite[limit + 1];

int main(void) {
    int primes = 0;
    for (int n = 1; n <= 160; n++) {
        for (int i = 1; i <= limit; i++) composite[i] = false;
        primes = 0;
        for (int i = 2; i <= limit; i++)
            if (!composite[i]) {
                primes = primes + 1;
                for (int j = 2 * i; j <= limit; j += i) composite[j] = true;
            }
    }
    printf("primes %d\n", primes);
    return 0;
}

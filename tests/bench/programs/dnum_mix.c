// Large integers and mixed calculations: powers modulo a number, roots, common divisors, encoder counts.
#include <math.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>

static int64_t power(int64_t base, int64_t exponent, int64_t modulus) {
    int64_t result = 1, factor = base % modulus;
    while (exponent > 0) {
        if (exponent % 2 == 1) result = result * factor % modulus;
        factor = factor * factor % modulus;
        exponent = exponent / 2;
    }
    return result;
}

static int64_t divisor(int64_t a, int64_t b) {
    while (b > 0) {
        const int64_t t = a % b;
        a = b;
        b = t;
    }
    return a;
}

// The whole part of the square root, by Newton's method.
static int64_t root(int64_t value) {
    int64_t better = value / 2 + 1, x = better + 1;
    while (better < x) {
        x = better;
        better = (x + value / x) / 2;
    }
    return x;
}

int main(void) {
    int64_t seed = 20240229, check = 0, count = 0;
    double place = 0, way = 0;
    float worst = 0;
    for (int n = 1; n <= 600000; n++) {
        seed = seed * 16807 % 2147483647;
        check = (check + power(seed, 65537 + n, 67108859)) % 1000000007;
        check = (check * 7 + divisor(seed, 360360 * (n % 97 + 1))) % 1000000007;
        check = (check + root(seed * 1000 + n)) % 1000000007;
    }
    printf("check %lld\n", (long long)check);
    for (int n = 1; n <= 8000000; n++) {
        // An encoder of 4096 counts per turn of 12.7 mm.
        const int counts = n % 29 - 11 + n % 3;
        count = count + (int64_t)counts * 1024;
        place = (double)count * 12.7 / 4096;
        const double difference = place - trunc(place);
        way = way + fabs(difference) + sqrt(fabs(place)) * 0.001;
        const float deviation = fabsf((float)difference * (float)counts);
        if (deviation > worst) worst = deviation;
        if (llabs(count) > 5000000000) count = count - 5000000000;
    }
    printf("count %lld place %.3f\nway %.3f worst %.3f\n", (long long)count, place, way, worst);
    return 0;
}

// Bit operations on up to 52 bits: a xorshift generator, a 32-bit hash with rotation, a map of occupied places.
#include <inttypes.h>
#include <stdint.h>
#include <stdio.h>

static const uint64_t mask52 = (UINT64_C(1) << 52) - 1;

static uint64_t shuffled(uint64_t x) {
    x = x ^ (x << 13 & mask52);
    x = x ^ x >> 7;
    return x ^ (x << 17 & mask52);
}

static uint32_t rotated(uint32_t x, int steps) {
    return x << steps | x >> (32 - steps);
}

static int set_bits(uint64_t value) {
    int count = 0;
    while (value > 0) {
        value = value & (value - 1);
        count = count + 1;
    }
    return count;
}

int main(void) {
    uint64_t state = 88172645463, places = 0;
    uint32_t hash = 0x811C9DC5;
    int clashes = 0, ones = 0;
    for (int pass = 1; pass <= 2; pass++)
        for (int n = 1; n <= 8000000; n++) {
            state = shuffled(state);
            hash = rotated(hash, n % 31 + 1) ^ (uint32_t)state;
            hash = hash * 31 + 7;
            const uint64_t place = UINT64_C(1) << (n % 52 * 5 % 52);
            if (places & place) {
                clashes = clashes + 1;
                places &= ~place;
            } else if (state >> 19 & 1) {
                places |= place;
            } else {
                hash = ~hash;
            }
            if (n % 16 == 0) ones = (ones + set_bits(state) + set_bits(places)) % 99991;
        }
    printf("state %" PRIu64 "\nhash %" PRIu32 "\nplaces %" PRIu64 "\n", state, hash, places);
    printf("clashes %d\nones %d\n", clashes, ones);
    return 0;
}

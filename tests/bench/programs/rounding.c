// Rounding and truncation with and without decimals, absolute values, limits, integer division.
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static inline float larger(float a, float b) {
    return a < b ? b : a;
}
static inline float smaller(float a, float b) {
    return b < a ? b : a;
}

static float limited(float value, float least, float most) {
    return larger(least, smaller(value, most));
}

int main(void) {
    int seed = 1, whole = 0, steps = 0;
    float difference = 0, cut = 0, top = 0, bottom = 0;
    for (int pass = 1; pass <= 2; pass++)
        for (int n = 1; n <= 8000000; n++) {
            seed = (seed * 137 + 29) % 30011;
            const float value = (float)(seed - 15000) / 7;
            const float offset = value - roundf(value);
            difference = difference + (roundf(value * 100) / 100 - truncf(value * 10) / 10) - offset;
            whole = (whole + abs((int)roundf(value))) % 99991;
            cut = (cut + truncf(fabsf(value) * 10) / 10 * 10) / 2;
            steps = (steps + seed / 12 + seed % 25) % 99991;
            top = larger(top, limited(offset * 100, -40, 45));
            bottom = smaller(bottom, value + (float)(n % 11));
            if (fabsf(difference) > 500) difference = 0;
        }
    printf("difference %.3f\nwhole %d cut %.2f\n", difference, whole, cut);
    printf("steps %d\ntop %.2f bottom %.2f\n", steps, top, bottom);
    return 0;
}

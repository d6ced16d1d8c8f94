// Errors as return codes in a loop: tried again, skipped, answered with another value, passed on to the caller.
#include <stdio.h>

typedef enum { OK, EMPTY = 11, JAMMED = 12, RANGE = 13 } status;
static float level = 20, jam, refills, skipped, passed_on;

// Takes parts out of the magazine; fails when it is empty or jammed.
static status feed(float amount) {
    if (jam > 0) {
        jam = jam - 1;
        return JAMMED;
    }
    if (level < amount) return EMPTY;
    level = level - amount;
    return OK;
}

// Mends what it can: an empty magazine is filled, a jammed part is put back.
static status supply(float amount) {
    status result = feed(amount);
    while (result == EMPTY) {
        level = level + 37;
        refills = refills + 1;
        result = feed(amount);
    }
    if (result == JAMMED) {
        level = level + 1;
        skipped = skipped + 1;
    } else if (result != OK) {
        return result;
    }
    if ((int)level % 13 == 5) jam = 2;
    return OK;
}

static status checked(float value, float* result) {
    if (value > 90) return RANGE;
    *result = value > 80 ? 80 : value * 2;
    return OK;
}

static float measured(float value) {
    float result;
    if (checked(value, &result) != OK) {
        passed_on = passed_on + 1;
        return -1;
    }
    return result + 1;
}

int main(void) {
    float seed = 1, sum = 0;
    for (int pass = 1; pass <= 2; pass++)
        for (int n = 1; n <= 8000000; n++) {
            seed = (float)((int)(seed * 137 + 29) % 30011);
            if (supply((float)((int)seed % 7 + 1)) != OK) return 1;
            sum = (float)((int)(sum + measured((float)((int)(seed + level) % 101))) % 99991);
        }
    printf("level %.0f sum %.0f\nrefills %.0f skipped %.0f\npassed on %.0f\n", level, sum, refills, skipped, passed_on);
    return 0;
}

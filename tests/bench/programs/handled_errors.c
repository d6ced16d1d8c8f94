// Three errors that come in turns, each now and then, as return codes handled one and two levels up.
#include <stdio.h>

typedef enum { OK, SLIPPED = 21, FULL, COLD } status;
static float grip = 5, stored, heat, retries, skips, fails;

static status close_gripper(float size) {
    grip = grip - 0.125f;
    return size > grip ? SLIPPED : OK;
}

static status store(float size) {
    const status result = close_gripper(size);
    if (result != OK) return result;
    stored = stored + size;
    return stored > 160 ? FULL : OK;
}

static status handle(float size) {
    status result;
    while ((result = store(size)) == SLIPPED) {
        grip = grip + 9;
        retries = retries + 1;
    }
    if (result == FULL) {
        stored = 0;
        skips = skips + 1;
    }
    heat = heat - 1;
    return heat < 0 ? COLD : OK;
}

static float cycle(int n) {
    if (handle((float)(n % 9 + 1)) == OK) return 1;
    heat = 60;
    fails = fails + 1;
    return 0;
}

int main(void) {
    float good = 0;
    for (int n = 1; n <= 16000000; n++)
        good = (float)((int)(good + cycle(n)) % 99991);
    printf("good %.0f retries %.0f\nskips %.0f fails %.0f\n", good, retries, skips, fails);
    return 0;
}

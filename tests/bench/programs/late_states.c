// A state machine whose states are functions called by name, with a structure and a pointer.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    float kind, load;
} job;
static char state[81] = "idle";
static float done, heat;

static void idle(job j, float* energy) {
    *energy = *energy - 1;
    if (j.kind == 0) return;
    strcpy(state, "pick");
}
static void pick(job j, float* energy) {
    *energy = *energy - j.load;
    strcpy(state, j.load > 6 ? "drop" : "move");
}
static void move(job j, float* energy) {
    heat = (float)((int)(heat + j.load) % 997);
    *energy = *energy - 2;
    strcpy(state, "place");
}
static void place(job j, float* energy) {
    (void)j;
    (void)energy;
    done = done + 1;
    strcpy(state, "idle");
}
static void drop(job j, float* energy) {
    (void)j;
    (void)energy;
    heat = (float)((int)(heat * 3 + 1) % 997);
    strcpy(state, "idle");
}

// Sorted by name.
typedef struct {
    const char* name;
    void (*function)(job, float*);
} entry;
static const entry functions[] = {{"state_drop", drop},
                                  {"state_idle", idle},
                                  {"state_move", move},
                                  {"state_pick", pick},
                                  {"state_place", place}};

static int by_name(const void* name, const void* item) {
    return strcmp(name, ((const entry*)item)->name);
}

static void call(const char* name, job j, float* energy) {
    const entry* found =
        bsearch(name, functions, sizeof functions / sizeof *functions, sizeof *functions, by_name);
    if (!found) exit(1);
    found->function(j, energy);
}

int main(void) {
    float energy = 1000;
    char name[81];
    for (int n = 1; n <= 8000000; n++) {
        const job j = {(float)(n % 4), (float)(n % 1000 * 7 % 10)};
        strcpy(name, "state_");
        strcat(name, state);
        call(name, j, &energy);
        if (energy < 0) energy = 1000;
    }
    printf("done %.0f heat %.0f energy %.0f %s\n", done, heat, energy, state);
    return 0;
}

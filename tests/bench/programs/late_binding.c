// Functions called by name: from a table, from a name put together, with arguments, and by number.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static int parts, angle, marks, ticks, check;

static void take(void) {
    parts = parts + 1;
}
static void place(void) {
    if (parts > 0) parts = parts - 1;
    check = check + parts;
}
static void turn(void) {
    angle = (angle + 37) % 360;
}
static void measure(void) {
    check = (check * 3 + angle) % 99991;
}
static void mark(void) {
    marks = marks + 1 + parts % 2;
}
static void reject(void) {
    parts = 0;
    marks = marks + 1;
}
static void wait_(void) {
    ticks = ticks + 2;
}
static void report(void) {
    check = (check + marks + ticks) % 99991;
    if (ticks > 50000) ticks = 0;
    if (marks > 50000) marks = 0;
}
static void program1(void) {
    check = check + 1;
}
static void program2(void) {
    angle = (angle + 11) % 360;
}
static void program3(void) {
    check = (check + angle * 2) % 99991;
}
static void tool1(int force, int* wear) {
    *wear = *wear + force;
}
static void tool2(int force, int* wear) {
    *wear = (*wear * 2 + force) % 9973;
}

// Sorted by name.
typedef struct {
    const char* name;
    void (*procedure)(void);
} entry;
static const entry procedures[] = {{"mark", mark},         {"measure", measure},   {"place", place},
                                   {"program1", program1}, {"program2", program2}, {"program3", program3},
                                   {"reject", reject},     {"report", report},     {"take", take},
                                   {"turn", turn},         {"wait", wait_}};
typedef struct {
    const char* name;
    void (*procedure)(int, int*);
} tool_entry;
static const tool_entry tools[] = {{"tool1", tool1}, {"tool2", tool2}};

static int by_name(const void* name, const void* item) {
    return strcmp(name, ((const entry*)item)->name);
}
static int by_tool_name(const void* name, const void* item) {
    return strcmp(name, ((const tool_entry*)item)->name);
}

static void call(const char* name) {
    const entry* found =
        bsearch(name, procedures, sizeof procedures / sizeof *procedures, sizeof *procedures, by_name);
    if (!found) exit(1);
    found->procedure();
}
static void call_tool(const char* name, int force, int* wear) {
    const tool_entry* found = bsearch(name, tools, sizeof tools / sizeof *tools, sizeof *tools, by_tool_name);
    if (!found) exit(1);
    found->procedure(force, wear);
}

enum { count = 8 };
static const char* const actions[count] = {"take", "place",  "turn", "measure",
                                           "mark", "reject", "wait", "report"};

int main(void) {
    int seed = 1, wear = 0;
    char name[32];
    for (int n = 1; n <= 2500000; n++) {
        seed = (seed * 137 + 29) % 30011;
        call(actions[(seed + angle) % count]);
        snprintf(name, sizeof name, "tool%d", n % 2 + 1);
        call_tool(name, parts % 50, &wear);
        snprintf(name, sizeof name, "program%d", check % 3 + 1);
        call(name);
        if (n % 16 == 0) wear = wear % 1000;
    }
    printf("check %d wear %d\nparts %d angle %d\nmarks %d ticks %d\n", check, wear, parts, angle, marks,
           ticks);
    return 0;
}

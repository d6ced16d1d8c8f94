// Looking into lines of a log: words, occurrences of a text, digits, the order of words.
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

enum { count = 12 };
static const char* const lines[count] = {"gripper 7 closed on part 1184 in fixture B, force 32.5 N",
                                         "conveyor stopped: no part at the stopper for 20 seconds",
                                         "welding gun 3 changed electrodes after 2500 welds",
                                         "camera found 14 parts, 2 of them outside the search area",
                                         "robot waits for the door of the press",
                                         "pallet 55 full, next pallet ordered from the store",
                                         "torque of axis 4 near its limit (87 %), path 12, speed 400",
                                         "tool changer locked, tool 2 on the flange",
                                         "part 1185 rejected: height 12.7 instead of 12.0 mm",
                                         "air pressure low: 4.9 bar",
                                         "fixture A opened, fixture B opened, fixture C still closed",
                                         "cycle 30412 ended after 41.3 seconds"};

// A text of up to 80 bytes and the zero behind it.
typedef struct {
    int length;
    char bytes[81];
} text;

static inline void set_text(text* t, const char* bytes, size_t length) {
    t->length = (int)length;
    memcpy(t->bytes, bytes, length);
    t->bytes[length] = 0;
}

// Places of the characters in an alphabet; others come after it, by code.
static int rank[256];

static void use_alphabet(const char* alphabet) {
    const int size = (int)strlen(alphabet);
    for (int c = 0; c < 256; c++)
        rank[c] = size + c;
    for (int i = 0; i < size; i++)
        rank[(unsigned char)alphabet[i]] = i;
}

static inline bool in_order(const text* a, const text* b) {
    const int shorter = a->length < b->length ? a->length : b->length;
    for (int i = 0; i < shorter; i++) {
        const int x = rank[(unsigned char)a->bytes[i]], y = rank[(unsigned char)b->bytes[i]];
        if (x != y) return x < y;
    }
    return a->length <= b->length;
}

static int words(const text* line, text* highest) {
    int found = 0;
    const char* next = line->bytes;
    while (*next) {
        const char* first = next + strspn(next, " ,:()");
        next = first + strcspn(first, " ,:()");
        if (next > first) {
            text word;
            set_text(&word, first, (size_t)(next - first));
            if (in_order(highest, &word)) *highest = word;
            found = found + 1;
        }
    }
    return found;
}

static int occurrences(const text* line, const char* pattern) {
    int found = 0;
    for (const char* at = strstr(line->bytes, pattern); at; at = strstr(at + 1, pattern))
        found = found + 1;
    return found;
}

static int digits(const text* line) {
    int found = 0;
    for (int i = 0; i < line->length; i++)
        if (line->bytes[i] >= '0' && line->bytes[i] <= '9') found = found + 1;
    return found;
}

int main(void) {
    static const char* const patterns[4] = {"part", "er", "12", "fixture"};
    text line, highest = {0};
    int total[3] = {0}, sizes = 0;
    use_alphabet("abcdefghijklmnopqrstuvwxyz");
    for (int n = 1; n <= 1000000; n++) {
        const char* const source = lines[n * 7 % count];
        set_text(&line, source, strlen(source));
        set_text(&highest, "a", 1);
        total[0] = (total[0] + words(&line, &highest)) % 99991;
        total[1] = (total[1] + occurrences(&line, patterns[n % 4])) % 99991;
        total[2] = (total[2] + digits(&line)) % 99991;
        sizes = sizes + highest.length;
    }
    printf("words %d\noccurrences %d\ndigits %d\n", total[0], total[1], total[2]);
    printf("highest %s %d\n", highest.bytes, sizes);
    return 0;
}

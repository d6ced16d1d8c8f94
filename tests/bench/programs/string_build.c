// Putting texts together and changing them: labels, characters replaced, upper case, comparison.
#include <ctype.h>
#include <stdbool.h>
#include <stdio.h>
#include <string.h>

// A text of up to 80 bytes; no zero behind it.
typedef struct {
    int length;
    char bytes[80];
} text;

static inline void append(text* t, const char* bytes, size_t length) {
    memcpy(t->bytes + t->length, bytes, length);
    t->length += (int)length;
}
static inline void append_string(text* t, const char* string) {
    append(t, string, strlen(string));
}
static inline void append_text(text* t, const text* other) {
    append(t, other->bytes, (size_t)other->length);
}
static inline text text_of(const char* string) {
    text t;
    t.length = 0;
    append_string(&t, string);
    return t;
}
static inline bool equal(const text* a, const text* b) {
    return a->length == b->length && memcmp(a->bytes, b->bytes, (size_t)a->length) == 0;
}
static inline bool equal_string(const text* a, const char* string) {
    const size_t length = strlen(string);
    return (size_t)a->length == length && memcmp(a->bytes, string, length) == 0;
}
static inline void part(text* result, const text* t, int first, int length) {
    result->length = length;
    memcpy(result->bytes, t->bytes + first, (size_t)length);
}
static inline void map(text* t, const char* from, const char* to) {
    for (int i = 0; i < t->length; i++) {
        const char* found = strchr(from, t->bytes[i]);
        if (found) t->bytes[i] = to[found - from];
    }
}
static inline void to_upper(text* t) {
    for (int i = 0; i < t->length; i++)
        t->bytes[i] = (char)toupper((unsigned char)t->bytes[i]);
}

enum { count = 8 };
static const char* const parts[count] = {"flange",  "housing", "cover plate", "shaft",
                                         "bearing", "seal",    "gear wheel",  "bolt"};
static const char* const suppliers[5] = {"North", "Lakeside", "Hill & Sons", "Metro", "Westend"};

static void label(text* result, const text* name, const char* supplier, const text* batch) {
    result->length = 0;
    append_string(result, "[");
    append_text(result, batch);
    append_string(result, "] ");
    append_text(result, name);
    append_string(result, " / ");
    append_string(result, supplier);
}

static void reversed(text* result, const text* line) {
    result->length = line->length;
    for (int i = 0; i < line->length; i++)
        result->bytes[i] = line->bytes[line->length - 1 - i];
}

int main(void) {
    static const char* const ends[5] = {"A", "B", "C", "X", "Z"};
    text name, plain = {0}, mirror = {0}, piece, other, previous = text_of("flange"), batch = text_of("K0");
    int length = 0, repeated = 0, special = 0;
    for (int n = 1; n <= 4800000; n++) {
        name = text_of(parts[n * 3 % count]);
        label(&plain, &name, suppliers[n * 2 % 5], &batch);
        map(&plain, " /&", "_-+");
        if (n % 3 == 0) to_upper(&plain);
        reversed(&mirror, &name);
        part(&piece, &mirror, 0, 1);
        part(&other, &previous, 0, 1);
        if (equal(&piece, &other)) repeated = repeated + 1;
        if (equal_string(&plain, "[K0B]_COVER_PLATE_-_WESTEND") || equal_string(&mirror, "tlob"))
            special = special + 1;
        if (!equal(&mirror, &name)) length = (length + plain.length) % 99991;
        previous = mirror;
        if (batch.length < 12 && n % 7 > 0)
            append_string(&batch, ends[n % 5]);
        else
            batch = text_of("K0");
    }
    printf("%.*s\n%.*s %.*s\n", plain.length, plain.bytes, mirror.length, mirror.bytes, batch.length,
           batch.bytes);
    printf("length %d\nrepeated %d\nspecial %d\n", length, repeated, special);
    return 0;
}

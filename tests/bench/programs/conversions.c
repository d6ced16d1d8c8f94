// Numbers, bytes and positions to text and back; decimal and hexadecimal digits.
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    float x, y, z;
} pos;

static inline bool read_float(const char* text, float* value) {
    char* end;
    *value = strtof(text, &end);
    return end != text && *end == 0;
}

static inline bool read_pos(const char* text, pos* value) {
    char* end;
    if (*text != '[') return false;
    value->x = strtof(text + 1, &end);
    if (*end != ',') return false;
    value->y = strtof(end + 1, &end);
    if (*end != ',') return false;
    value->z = strtof(end + 1, &end);
    return strcmp(end, "]") == 0;
}

static inline void binary_digits(char* text, uint8_t value) {
    for (int i = 0; i < 8; i++)
        text[i] = (char)('0' + (value >> (7 - i) & 1));
    text[8] = 0;
}

int main(void) {
    char line[81], hex[81], decimal[81];
    float sum = 0;
    int failed = 0, length = 0, hex_length = 0;
    uint8_t total = 0;
    uint64_t serial = 123456789;
    for (int n = 1; n <= 250000; n++) {
        // A measured value with two decimals.
        const float value = (float)(n % 4099 * 37 % 10007 - 5000) / 8;
        float back = 0;
        length = (length + sprintf(line, "%.2f", value)) % 99991;
        if (!read_float(line, &back)) failed = failed + 1;
        sum = sum + (back - value);
        // A byte in hexadecimal and binary digits.
        const uint8_t code = (uint8_t)(n * 7);
        sprintf(hex, "%02X", code);
        total += (uint8_t)strtoul(hex, NULL, 16);
        binary_digits(line, code ^ 85);
        total += (uint8_t)strtoul(line, NULL, 2);
        // A position as it is written in a program.
        const pos place = {(float)(n % 1201), -value, (float)code / 4};
        pos read = {0};
        length = (length + sprintf(line, "[%.6g,%.6g,%.6g]", place.x, place.y, place.z)) % 99991;
        if (!read_pos(line, &read)) failed = failed + 1;
        if (read.x != place.x || read.y != place.y || read.z != place.z) failed = failed + 1;
        // A serial number in hexadecimal digits.
        serial = serial * 16807 % 2147483647;
        sprintf(decimal, "%llu", (unsigned long long)serial);
        hex_length = hex_length + sprintf(hex, "%llX", strtoull(decimal, NULL, 10));
        sprintf(decimal, "%llu", strtoull(hex, NULL, 16));
        if (strtoull(decimal, NULL, 10) != serial) failed = failed + 1;
    }
    printf("%s %s\n", line, hex);
    printf("sum %.3f\nfailed %d\nlength %d %d\ntotal %d\n", sum, failed, length, hex_length, total);
    return 0;
}

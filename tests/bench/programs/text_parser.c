// Expressions in texts, evaluated by recursive descent.
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

// A text of up to 80 bytes.
typedef struct {
    int length;
    char bytes[80];
} text;

static text source;
static int at;

static float sum(void);

static char look(void) {
    return at < source.length ? source.bytes[at] : 0;
}

static float number(void) {
    char digits[81];
    const int first = at;
    while (at < source.length && source.bytes[at] >= '0' && source.bytes[at] <= '9')
        at = at + 1;
    memcpy(digits, source.bytes + first, (size_t)(at - first));
    digits[at - first] = 0;
    return strtof(digits, NULL);
}

static float factor(void) {
    if (look() == '(') {
        at = at + 1;
        const float value = sum();
        at = at + 1;
        return value;
    }
    if (look() == '-') {
        at = at + 1;
        return -factor();
    }
    return number();
}

static float term(void) {
    float value = factor();
    while (look() == '*') {
        at = at + 1;
        value = value * factor();
    }
    return value;
}

static float sum(void) {
    float value = term();
    while (1) {
        if (look() == '+') {
            at = at + 1;
            value = value + term();
        } else if (look() == '-') {
            at = at + 1;
            value = value - term();
        } else {
            return value;
        }
    }
}

static text text_of(const char* bytes) {
    text t;
    t.length = (int)strlen(bytes);
    memcpy(t.bytes, bytes, (size_t)t.length);
    return t;
}

int main(void) {
    const text sources[4] = {text_of("1+2*3-(4+5)*2"), text_of("12*(3+4*(2-7))-9"),
                             text_of("-(8-3)*7+100*(2+2)"), text_of("((1+2)*(3+4)-5)*6")};
    float result = 0;
    for (int n = 1; n <= 1000000; n++) {
        source = sources[n % 4];
        at = 0;
        result = (float)((int)(result + sum() + 1000) % 99991);
    }
    printf("result %.0f\n", result);
    return 0;
}

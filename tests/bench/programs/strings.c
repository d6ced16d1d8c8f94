#include <stdio.h>
#include <string.h>

static const char* const words[8] = {"gripper", "conveyor", "pallet", "welding gun",
                                     "tool",    "fixture",  "camera", "robot"};

int main(void) {
    char line[81], key[81], part[81];
    int length = 0, found = 0, equal = 0, vowels = 0;
    for (int n = 1; n <= 4800000; n++) {
        strcpy(key, words[n % 8]);
        strcpy(line, key);
        strcat(line, " station, ");
        strcat(line, words[(n + 3) % 8]);
        length = (length + (int)strlen(line)) % 99991;
        const char* hit = strstr(line, "station");
        found = (found + (hit ? (int)(hit - line) + 1 : (int)strlen(line) + 1)) % 99991;
        vowels = (vowels + (int)strcspn(line + 1, "aeiou") + 2) % 99991;
        memcpy(part, line, strlen(key));
        part[strlen(key)] = 0;
        if (strcmp(part, key) == 0) equal = (equal + 1) % 99991;
        if (strcmp(line, "robot station, pallet") == 0) equal = equal + 1;
    }
    printf("length %d\nfound %d\nvowels %d\nequal %d\n", length, found, vowels, equal);
    return 0;
}

#include <stdbool.h>
#include <stdio.h>

enum { count = 500 };
typedef struct {
    float x, y, z;
} pos;
typedef struct {
    pos place, speed;
    float bounces;
    bool alive;
} particle;
static particle cloud[count];

static void move(particle* p) {
    p->place.x = p->place.x + p->speed.x;
    p->place.y = p->place.y + p->speed.y;
    p->place.z = p->place.z + p->speed.z;
    if (p->place.x < 0 || p->place.x > 1000) {
        p->speed.x = -p->speed.x;
        p->bounces = p->bounces + 1;
    }
    if (p->place.y < 0 || p->place.y > 1000) {
        p->speed.y = -p->speed.y;
        p->bounces = p->bounces + 1;
    }
    if (p->place.z < 0 || p->place.z > 1000) {
        p->speed.z = -p->speed.z;
        p->bounces = p->bounces + 1;
    }
}

int main(void) {
    float bounces = 0;
    particle last = {0};
    for (int i = 1; i <= count; i++)
        cloud[i - 1] = (particle){{(float)i, (float)(2 * i % 1000), 500},
                                  {(float)(i % 13 - 6), (float)(i % 7 - 3), (float)(i % 5 - 2)},
                                  0,
                                  true};
    for (int n = 1; n <= 400000; n++)
        for (int i = 0; i < count; i++) move(&cloud[i]);
    for (int i = 0; i < count; i++) {
        last = cloud[i];
        bounces = bounces + last.bounces;
    }
    printf("bounces %.0f\n", bounces);
    printf("last %.0f %.0f\n", last.place.x, last.place.y);
    return 0;
}

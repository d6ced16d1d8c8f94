// The flange of a six-axis arm from its joint angles: frames of links and turns about z, multiplied.
#include "frames.h"
#include <stdio.h>

#define QUARTER 0.7071068f

static const pose links[6] = {{{0, 0, 290}, {1, 0, 0, 0}},
                              {{0, 0, 0}, {QUARTER, -QUARTER, 0, 0}},
                              {{0, -270, 0}, {1, 0, 0, 0}},
                              {{70, 0, 0}, {QUARTER, -QUARTER, 0, 0}},
                              {{0, 0, 302}, {QUARTER, QUARTER, 0, 0}},
                              {{0, -72, 0}, {QUARTER, -QUARTER, 0, 0}}};

static float dot_prod(pos a, pos b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

static pose forward(const float* joints) {
    pose t = {{0, 0, 0}, {1, 0, 0, 0}};
    pose turn = t;
    for (int i = 0; i < 6; i++) {
        turn.rot = orient_zyx(joints[i], 0, 0);
        t = pose_mult(t, pose_mult(links[i], turn));
    }
    return t;
}

int main(void) {
    float joints[6];
    pos low = {9999, 9999, 9999}, last = {0, 0, 0};
    int inside = 0, way = 0;
    for (int n = 1; n <= 1000000; n++) {
        for (int i = 1; i <= 6; i++)
            joints[i - 1] = (float)(n * (i + 2) % 181 - 90);
        const pose t = forward(joints);
        if (t.trans.z < low.z) low = t.trans;
        if (sqrtf(dot_prod(t.trans, t.trans)) < 600) inside = inside + 1;
        if (dot_prod(t.trans, last) > 0) way = way + 1;
        last = t.trans;
    }
    printf("low %.0f %.0f inside %d way %d\n", low.x, low.z, inside, way);
    return 0;
}

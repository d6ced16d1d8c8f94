// Frames of a palletising cell: places of a layer in chained frames, and back into the frame of the pallet.
#include "frames.h"
#include <stdio.h>

static inline float vect_magn(pos a) {
    return sqrtf(a.x * a.x + a.y * a.y + a.z * a.z);
}

static inline pose pose_inv(pose a) {
    const orient inverse = {a.rot.q1, -a.rot.q2, -a.rot.q3, -a.rot.q4};
    return (pose){scale(rotate(inverse, a.trans), -1), inverse};
}
static inline pos pose_vect(pose a, pos p) {
    return add(a.trans, rotate(a.rot, p));
}
static inline robtarget offs(robtarget p, float x, float y, float z) {
    p.trans = add(p.trans, (pos){x, y, z});
    return p;
}

enum { count = 24 };
static const robtarget corner = {{50, 60, 0}, {0, 0, 1, 0}, 0, 0, 0, 0, {9e9f, 9e9f, 9e9f, 9e9f, 9e9f, 9e9f}};
static pose frames[count];

int main(void) {
    double sum_x = 0, sum_y = 0, sum_z = 0, sum_back = 0;
    int away = 0;
    for (int i = 1; i <= count; i++)
        frames[i - 1] = (pose){{(float)(40 * i), (float)(300 - 10 * i), (float)(5 * i)},
                               orient_zyx((float)(15 * i), (float)(4 * i - 50), (float)(3 * i))};
    for (int n = 1; n <= 1000000; n++) {
        const pose world = pose_mult(frames[n % count], frames[n * 7 % 19]);
        const pose inverse = pose_inv(world);
        const float height = (float)(25 * (n % 5));
        for (int row = 0; row < 4; row++)
            for (int column = 0; column < 3; column++) {
                const robtarget target = offs(corner, (float)(120 * column), (float)(80 * row), height);
                const pos place = pose_vect(world, target.trans);
                sum_x = sum_x + place.x;
                sum_y = sum_y + place.y;
                sum_z = sum_z + place.z;
                const pos shift =
                    add(scale(subtract(place, world.trans), 0.5f), (pos){(float)row, (float)column, 0});
                const pos back = pose_vect(inverse, add(world.trans, scale(shift, 0.5f)));
                sum_back = sum_back + (back.x + back.y + back.z);
                if (vect_magn(subtract(back, corner.trans)) > 45) away = away + 1;
            }
    }
    printf("x %.2f y %.2f z %.2f\n", sum_x / 12000000, sum_y / 12000000, sum_z / 12000000);
    printf("back %.2f\naway %d\n", sum_back / 12000000, away);
    return 0;
}

// Frames of a palletising cell: places of a layer in chained frames, and back into the frame of the pallet.
#include <math.h>
#include <stdio.h>

typedef struct {
    float x, y, z;
} pos;
typedef struct {
    float q1, q2, q3, q4;
} orient;
typedef struct {
    pos trans;
    orient rot;
} pose;
typedef struct {
    pos trans;
    orient rot;
    float cf1, cf4, cf6, cfx;
    float eax[6];
} robtarget;

static inline pos add(pos a, pos b) {
    return (pos){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline pos subtract(pos a, pos b) {
    return (pos){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline pos scale(pos a, float k) {
    return (pos){a.x * k, a.y * k, a.z * k};
}
static inline float vect_magn(pos a) {
    return sqrtf(a.x * a.x + a.y * a.y + a.z * a.z);
}

static inline orient multiply(orient a, orient b) {
    return (orient){a.q1 * b.q1 - a.q2 * b.q2 - a.q3 * b.q3 - a.q4 * b.q4,
                    a.q1 * b.q2 + a.q2 * b.q1 + a.q3 * b.q4 - a.q4 * b.q3,
                    a.q1 * b.q3 - a.q2 * b.q4 + a.q3 * b.q1 + a.q4 * b.q2,
                    a.q1 * b.q4 + a.q2 * b.q3 - a.q3 * b.q2 + a.q4 * b.q1};
}
static inline pos cross_prod(pos a, pos b) {
    return (pos){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline pos rotate(orient q, pos p) {
    const pos u = {q.q2, q.q3, q.q4};
    const pos t = scale(cross_prod(u, p), 2);
    return add(add(p, scale(t, q.q1)), cross_prod(u, t));
}
static inline pose pose_mult(pose a, pose b) {
    return (pose){add(a.trans, rotate(a.rot, b.trans)), multiply(a.rot, b.rot)};
}
static inline pose pose_inv(pose a) {
    const orient inverse = {a.rot.q1, -a.rot.q2, -a.rot.q3, -a.rot.q4};
    return (pose){scale(rotate(inverse, a.trans), -1), inverse};
}
static inline pos pose_vect(pose a, pos p) {
    return add(a.trans, rotate(a.rot, p));
}
static inline orient orient_zyx(float z, float y, float x) {
    const float half = 3.14159265f / 360;
    const orient rz = {cosf(z * half), 0, 0, sinf(z * half)};
    const orient ry = {cosf(y * half), 0, sinf(y * half), 0};
    const orient rx = {cosf(x * half), sinf(x * half), 0, 0};
    return multiply(multiply(rz, ry), rx);
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

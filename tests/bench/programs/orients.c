// Orientations: from Euler angles and back, products, normalising, turning about the axes of the tool, angles.
#include "frames.h"
#include <stdio.h>

static inline float dot_prod(pos a, pos b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
static inline float vect_magn(pos a) {
    return sqrtf(dot_prod(a, a));
}
static inline orient n_orient(orient q) {
    const float k = 1 / sqrtf(q.q1 * q.q1 + q.q2 * q.q2 + q.q3 * q.q3 + q.q4 * q.q4);
    return (orient){q.q1 * k, q.q2 * k, q.q3 * k, q.q4 * k};
}
static inline float euler_z(orient q) {
    return atan2f(2 * (q.q1 * q.q4 + q.q2 * q.q3), 1 - 2 * (q.q3 * q.q3 + q.q4 * q.q4)) / degree;
}
static inline float euler_y(orient q) {
    return asinf(fmaxf(-1, fminf(1, 2 * (q.q1 * q.q3 - q.q2 * q.q4)))) / degree;
}
static inline float euler_x(orient q) {
    return atan2f(2 * (q.q1 * q.q2 + q.q3 * q.q4), 1 - 2 * (q.q2 * q.q2 + q.q3 * q.q3)) / degree;
}
static inline robtarget rel_tool_z(robtarget p, float x, float y, float z, float angle) {
    const float half = angle * degree / 2;
    p.trans = add(p.trans, rotate(p.rot, (pos){x, y, z}));
    p.rot = multiply(p.rot, (orient){cosf(half), 0, 0, sinf(half)});
    return p;
}

int main(void) {
    const robtarget start = {
        {600, 0, 800}, {0.5f, 0, 0.8660254f, 0}, 0, 0, 0, 0, {9e9f, 9e9f, 9e9f, 9e9f, 9e9f, 9e9f}};
    const orient turn = orient_zyx(5, 2.5f, -1);
    robtarget target = start;
    orient turned = start.rot;
    pos last = {0, 0, 1};
    double sum_z = 0, sum_y = 0, sum_x = 0, sum_dot = 0, way = 0;
    for (int n = 1; n <= 3000000; n++) {
        // A new orientation now and then, small turns from it in between.
        if (n % 4 == 1)
            turned = orient_zyx((float)(n % 359 - 179), (float)(n % 151 - 75), (float)(n % 283 - 141));
        else
            turned = n_orient(multiply(turned, turn));
        target.rot = turned;
        const robtarget near = rel_tool_z(target, (float)(n % 3), 0, -50, (float)(n % 90));
        const pose product = pose_mult((pose){near.trans, near.rot}, (pose){{0, 0, 10}, turn});
        sum_z = sum_z + fabsf(euler_z(product.rot));
        sum_y = sum_y + euler_y(product.rot);
        sum_x = sum_x + fabsf(euler_x(product.rot));
        const pos approach = subtract(near.trans, target.trans);
        const float angle = dot_prod(approach, last) / (vect_magn(approach) * vect_magn(last));
        sum_dot = sum_dot + angle;
        way = way + vect_magn(cross_prod(approach, last));
        last = approach;
    }
    printf("z %.2f y %.2f x %.2f\n", sum_z / 3000000, sum_y / 3000000, sum_x / 3000000);
    printf("dot %.3f\nway %.1f\n", sum_dot / 3000000, way / 3000000);
    return 0;
}

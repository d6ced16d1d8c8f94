// Arithmetic of frames, inlined as a C programmer would have it in a header.
#include "geometry_types.h"
#include <math.h>

typedef struct {
    pos trans;
    orient rot;
    float cf1, cf4, cf6, cfx;
    float eax[6];
} robtarget;

static const float degree = 3.14159265f / 180;

static inline pos add(pos a, pos b) {
    return (pos){a.x + b.x, a.y + b.y, a.z + b.z};
}
static inline pos subtract(pos a, pos b) {
    return (pos){a.x - b.x, a.y - b.y, a.z - b.z};
}
static inline pos scale(pos a, float k) {
    return (pos){a.x * k, a.y * k, a.z * k};
}
static inline pos cross_prod(pos a, pos b) {
    return (pos){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
static inline orient multiply(orient a, orient b) {
    return (orient){a.q1 * b.q1 - a.q2 * b.q2 - a.q3 * b.q3 - a.q4 * b.q4,
                    a.q1 * b.q2 + a.q2 * b.q1 + a.q3 * b.q4 - a.q4 * b.q3,
                    a.q1 * b.q3 - a.q2 * b.q4 + a.q3 * b.q1 + a.q4 * b.q2,
                    a.q1 * b.q4 + a.q2 * b.q3 - a.q3 * b.q2 + a.q4 * b.q1};
}
static inline pos rotate(orient q, pos p) {
    const pos u = {q.q2, q.q3, q.q4};
    const pos t = scale(cross_prod(u, p), 2);
    return add(add(p, scale(t, q.q1)), cross_prod(u, t));
}
static inline pose pose_mult(pose a, pose b) {
    return (pose){add(a.trans, rotate(a.rot, b.trans)), multiply(a.rot, b.rot)};
}
static inline orient orient_zyx(float z, float y, float x) {
    const float half = degree / 2;
    const orient rz = {cosf(z * half), 0, 0, sinf(z * half)};
    const orient ry = {cosf(y * half), 0, sinf(y * half), 0};
    const orient rx = {cosf(x * half), sinf(x * half), 0, 0};
    return multiply(multiply(rz, ry), rx);
}

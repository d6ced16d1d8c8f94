#include "geometry_library.h"
#include <math.h>

static orient multiply(orient a, orient b) {
    return (orient){a.q1 * b.q1 - a.q2 * b.q2 - a.q3 * b.q3 - a.q4 * b.q4,
                    a.q1 * b.q2 + a.q2 * b.q1 + a.q3 * b.q4 - a.q4 * b.q3,
                    a.q1 * b.q3 - a.q2 * b.q4 + a.q3 * b.q1 + a.q4 * b.q2,
                    a.q1 * b.q4 + a.q2 * b.q3 - a.q3 * b.q2 + a.q4 * b.q1};
}

static pos rotate(orient q, pos p) {
    const orient r = multiply(multiply(q, (orient){0, p.x, p.y, p.z}), (orient){q.q1, -q.q2, -q.q3, -q.q4});
    return (pos){r.q2, r.q3, r.q4};
}

pose pose_mult(pose a, pose b) {
    const pos t = rotate(a.rot, b.trans);
    return (pose){{a.trans.x + t.x, a.trans.y + t.y, a.trans.z + t.z}, multiply(a.rot, b.rot)};
}

pose pose_inv(pose a) {
    const orient inverse = {a.rot.q1, -a.rot.q2, -a.rot.q3, -a.rot.q4};
    const pos t = rotate(inverse, a.trans);
    return (pose){{-t.x, -t.y, -t.z}, inverse};
}

pos pose_vect(pose a, pos p) {
    const pos t = rotate(a.rot, p);
    return (pos){a.trans.x + t.x, a.trans.y + t.y, a.trans.z + t.z};
}

orient n_orient(orient q) {
    const float length = sqrtf(q.q1 * q.q1 + q.q2 * q.q2 + q.q3 * q.q3 + q.q4 * q.q4);
    return (orient){q.q1 / length, q.q2 / length, q.q3 / length, q.q4 / length};
}

pos cross_prod(pos a, pos b) {
    return (pos){a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}

float dot_prod(pos a, pos b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}

float vect_magn(pos a) {
    return sqrtf(dot_prod(a, a));
}

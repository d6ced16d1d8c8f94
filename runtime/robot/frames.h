#pragma once
// Points, orientations and frames. Lengths in mm; quaternions in RAPID's order w, x, y, z (q1..q4), unit
// length; a Pose named a_b ("b in a") turns coordinates given in frame b into coordinates in frame a.

#include <cmath>

namespace robot {

/// Position or direction, mm when it is a position.
struct Vec3 {
    double x = 0, y = 0, z = 0;
    friend bool operator==(const Vec3&, const Vec3&) = default;
};

/// Orientation as a unit quaternion; w = q1, x = q2, y = q3, z = q4 of RAPID's orient.
struct Quat {
    double w = 1, x = 0, y = 0, z = 0;
    friend bool operator==(const Quat&, const Quat&) = default;
};

/// RAPID's pose: trans and rot. Default: the identity.
struct Pose {
    Vec3 pos;
    Quat rot;
    friend bool operator==(const Pose&, const Pose&) = default;
};

inline Vec3 operator+(const Vec3& a, const Vec3& b) {
    return {a.x + b.x, a.y + b.y, a.z + b.z};
}
inline Vec3 operator-(const Vec3& a, const Vec3& b) {
    return {a.x - b.x, a.y - b.y, a.z - b.z};
}
inline Vec3 operator*(const Vec3& a, double k) {
    return {a.x * k, a.y * k, a.z * k};
}
inline double dot(const Vec3& a, const Vec3& b) {
    return a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 cross(const Vec3& a, const Vec3& b) {
    return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
inline double norm(const Vec3& a) {
    return std::sqrt(dot(a, a));
}

/// Rotation b followed, seen from outside, by a: (a*b) v = a (b v).
inline Quat operator*(const Quat& a, const Quat& b) {
    return {a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z, a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y,
            a.w * b.y - a.x * b.z + a.y * b.w + a.z * b.x, a.w * b.z + a.x * b.y - a.y * b.x + a.z * b.w};
}
/// Half of an angle of rotation.
struct HalfAngle {
    double cosine = 1, sine = 0;
};
/// The quaternion times a rotation about x, or z: without the products of components that are 0.
inline Quat turnedAboutX(const Quat& q, const HalfAngle& x) {
    return {q.w * x.cosine - q.x * x.sine, q.w * x.sine + q.x * x.cosine, q.y * x.cosine + q.z * x.sine,
            q.z * x.cosine - q.y * x.sine};
}
inline Quat turnedAboutZ(const Quat& q, const HalfAngle& z) {
    return {q.w * z.cosine - q.z * z.sine, q.x * z.cosine + q.y * z.sine, q.y * z.cosine - q.x * z.sine,
            q.w * z.sine + q.z * z.cosine};
}
/// Rotations about z, then the new y, then the new x.
inline Quat fromHalvesZyx(const HalfAngle& z, const HalfAngle& y, const HalfAngle& x) {
    return turnedAboutX({z.cosine * y.cosine, -(z.sine * y.sine), z.cosine * y.sine, z.sine * y.cosine}, x);
}
/// Rotations about x, then the new y, then the new z.
inline Quat fromHalvesXyz(const HalfAngle& x, const HalfAngle& y, const HalfAngle& z) {
    return turnedAboutZ({x.cosine * y.cosine, x.sine * y.cosine, x.cosine * y.sine, x.sine * y.sine}, z);
}
inline Quat conjugate(const Quat& q) {
    return {q.w, -q.x, -q.y, -q.z};
}
inline double dot(const Quat& a, const Quat& b) {
    return a.w * b.w + a.x * b.x + a.y * b.y + a.z * b.z;
}
inline Vec3 rotate(const Quat& q, const Vec3& v) {
    const Vec3 u{q.x, q.y, q.z};
    const Vec3 t = cross(u, v) * 2.0;
    return v + t * q.w + cross(u, t);
}

/// Length of the quaternion, to be compared with 1 (RAPID's ERR_ORIENT_VALUE).
inline double norm(const Quat& q) {
    return std::sqrt(dot(q, q));
}
/// Scaled to unit length; `length`: of `q`. A quaternion of length zero becomes the identity.
inline Quat normalized(const Quat& q, double length) {
    if (!(length > 0)) return {};
    return {q.w / length, q.x / length, q.y / length, q.z / length};
}
inline Quat normalized(const Quat& q) {
    return normalized(q, norm(q));
}

/// Coordinates of frame c in a, from b in a and c in b (RAPID's PoseMult).
inline Pose operator*(const Pose& a_b, const Pose& b_c) {
    return {a_b.pos + rotate(a_b.rot, b_c.pos), a_b.rot * b_c.rot};
}
inline bool isIdentity(const Pose& pose) {
    const Vec3& p = pose.pos;
    const Quat& q = pose.rot;
    return p.x == 0 && p.y == 0 && p.z == 0 && q.w == 1 && q.x == 0 && q.y == 0 && q.z == 0;
}
/// `a_b * b_c`. Most frames are identities: planning asks for frames at thousands of places.
inline Pose chained(const Pose& a_b, const Pose& b_c) {
    return isIdentity(a_b) ? b_c : isIdentity(b_c) ? a_b : a_b * b_c;
}
/// RAPID's PoseInv: from b in a to a in b.
inline Pose inverse(const Pose& a_b) {
    const Quat rot = conjugate(a_b.rot);
    return {rotate(rot, a_b.pos) * -1.0, rot};
}
/// RAPID's PoseVect: a point given in b, expressed in a.
inline Vec3 apply(const Pose& a_b, const Vec3& point) {
    return a_b.pos + rotate(a_b.rot, point);
}

/// Angle of the shortest rotation between two orientations, degrees, 0..180.
double angleBetween(const Quat& a, const Quat& b);
/// Spherical interpolation along the shortest way, constant angular speed; k = 0 gives a, k = 1 gives b.
Quat slerp(const Quat& a, const Quat& b, double k);
/// Rotation of angleDeg degrees about the unit vector axis.
Quat fromAxisAngle(const Vec3& axis, double angleDeg);
/// Rotation vector (axis times angle in radians, angle 0..pi) of a unit quaternion.
Vec3 rotationVector(const Quat& q);
/// Orientation turned by a share of a rotation vector in rad, which is given as seen from the orientation itself.
Quat turnedBy(const Quat& base, const Vec3& rotation, double share = 1);
/// RAPID's OrientZYX: rotations in degrees about z, then the new y, then the new x.
Quat fromEulerZyx(double zDeg, double yDeg, double xDeg);
/// RAPID's EulerZYX: the three angles in degrees, as x, y, z members; y within +-90.
Vec3 eulerZyx(const Quat& q);
/// One of the three alone.
double eulerX(const Quat& q);
double eulerY(const Quat& q);
double eulerZ(const Quat& q);

/// RAPID's Offs: displaced by x, y, z mm along the axes of the frame the pose is given in.
Pose offs(const Pose& target, double x, double y, double z);
/// RAPID's RelTool: displaced by x, y, z mm along the tool's own axes, then turned by degrees about x, then
/// y, then z of the tool.
Pose relTool(const Pose& target, double x, double y, double z, double rxDeg, double ryDeg, double rzDeg);

} // namespace robot

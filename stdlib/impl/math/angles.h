#pragma once
// Trigonometry in degrees, in double; exact at multiples of 90 degrees, where a conversion to radians would
// leave noise.

namespace rt::lib {

double sinDeg(double degrees);
double cosDeg(double degrees);
/// At odd multiples of 90 degrees, where the tangent has no value: +-1.633123935319537e16.
double tanDeg(double degrees);

} // namespace rt::lib

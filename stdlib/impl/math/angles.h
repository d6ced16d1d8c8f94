#pragma once
// Trigonometry in degrees, in double; exact at multiples of 90 degrees, where a conversion to radians would
// leave noise.

namespace rt::lib {

double sinDeg(double degrees);
double cosDeg(double degrees);
/// At odd multiples of 90 degrees, where the tangent has no value: +-1.633123935319537e16.
double tanDeg(double degrees);
double asinDeg(double value);
double acosDeg(double value);
double atanDeg(double value);
double atan2Deg(double y, double x);

} // namespace rt::lib

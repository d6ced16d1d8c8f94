#pragma once
// Round and Trunc. Halves are rounded away from zero. Scaling by a power of ten is done in the precision of
// the type, so that a num written 0.29 truncates to 0.29 with two decimals although its binary value lies
// below.

namespace rt::lib {

float roundNum(float value, int decimals);
double roundDnum(double value, int decimals);
float truncNum(float value, int decimals);
double truncDnum(double value, int decimals);

} // namespace rt::lib

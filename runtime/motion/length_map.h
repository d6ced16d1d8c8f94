#pragma once
// LengthMap: from the distance along a curve to the curve's own parameter (0..1).

#include <functional>
#include <vector>

namespace motion {

class LengthMap {
  public:
    /// The parameter grows in proportion to the distance.
    static LengthMap even(double length);
    /// `rate`: length per unit of the parameter, measured at 2 * `pieces` + 1 places, or more where it
    /// changes fast. `isSmooth`: the second derivative of the parameter is continuous, too.
    static LengthMap measured(const std::function<double(double)>& rate, int pieces, bool isSmooth = false);

    double length() const { return length_; }
    /// The parameter at this distance from the start (clamped).
    double parameterAt(double distance) const;
    /// The reverse.
    double distanceAt(double parameter) const;

  private:
    double smoothShare(std::size_t piece, double x) const;

    double length_ = 0;
    std::vector<double> distances_, rates_; // at even steps of the parameter; empty when even
    std::vector<double> bends_;             // derivatives of the rates; empty unless smooth
};

} // namespace motion

#pragma once
// Warp: a smooth, growing map from the profile's parameter u to the path parameter s, both 0..1. It slows the
// motion down where axes have to turn fast, so that one constant bound on u's derivatives serves the whole
// path.

#include <cstddef>
#include <vector>

namespace motion {

class Warp {
  public:
    struct Point {
        double s = 0, first = 1, second = 0; ///< s and its derivatives by u
    };

    /// The identity.
    Warp() = default;
    /// A cubic spline through places `s` (from 0 to 1, growing) with the pace ds/du proportional to
    /// 1/slowness there. Gives the identity if no growing spline comes out.
    static Warp fromSlowness(const std::vector<double>& s, const std::vector<double>& slowness);

    bool isIdentity() const { return knots_.empty(); }
    Point at(double u) const;
    /// At the k-th of the places the spline was made from.
    Point atPlace(std::size_t k) const;
    /// u at which s is reached.
    double inverse(double s) const;

  private:
    struct Knot {
        double u = 0, s = 0, curvature = 0; // second derivative
    };
    Point inside(std::size_t left, double u) const;
    bool isGrowing() const;
    std::vector<Knot> knots_;
};

} // namespace motion

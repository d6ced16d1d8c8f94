#pragma once
// LengthMap: from the distance along a curve to the curve's own parameter (0..1).

#include <utility>
#include <vector>

namespace motion {

class LengthMap {
  public:
    LengthMap() = default;
    /// The parameter grows in proportion to the distance.
    static LengthMap even(double length);
    /// `rate`: length per unit of the parameter, measured at 2 * `pieces` + 1 places, or more where it
    /// changes fast. `isSmooth`: the second derivative of the parameter is continuous, too.
    template <class Rate> static LengthMap measured(const Rate& rate, int pieces, bool isSmooth = false) {
        for (;; pieces *= 4) {
            const auto count = static_cast<std::size_t>(pieces);
            const double step = 1.0 / pieces;
            Measured found;
            found.rates.resize(count + 1);
            found.middles.resize(count);
            for (std::size_t i = 0; i <= count; ++i) {
                found.rates[i] = rate(static_cast<double>(i) * step);
                if (i < count) found.middles[i] = rate((static_cast<double>(i) + 0.5) * step);
            }
            if (4 * pieces > kMostPieces || found.changesLittle(isSmooth))
                return LengthMap(std::move(found), isSmooth);
        }
    }

    double length() const { return length_; }
    /// The parameter at this distance from the start (clamped).
    double parameterAt(double distance) const;
    /// The reverse.
    double distanceAt(double parameter) const;

  private:
    static constexpr int kMostPieces = 2000;
    /// Rates at even steps of the parameter and half way between them.
    struct Measured {
        std::vector<double> rates, middles;
        double largest() const;
        bool changesLittle(bool isSmooth) const;
    };
    /// Between two even steps of the parameter.
    struct Piece {
        double begin = 0, width = 0; // of the distance
        double mean = 0;             // parameter a unit of distance
        double first = 0, last = 0;  // the same at both ends, so low that the parameter grows everywhere
        bool isSmooth = false;       // its share is a polynomial of the fifth degree
    };
    LengthMap(Measured measured, bool isSmooth);
    double smoothShare(std::size_t piece, double x) const;

    double length_ = 0;
    double step_ = 1;                   // of the parameter
    std::vector<Piece> pieces_;         // empty when even
    std::vector<double> rates_, bends_; // at the steps, and their derivatives; empty unless smooth
};

} // namespace motion

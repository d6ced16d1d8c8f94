#pragma once
// The fastest speed along a path under limits of speed, acceleration and jerk of several quantities. The square of the
// speed is a quadratic spline over the place, so that speed and acceleration are continuous and jerk changes at borders of
// cells only. Found by an interior-point method; the work grows in proportion to the number of cells. Knows no robot.

#include "runtime/motion/profile_terms.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace motion {

/// A limit of speed, acceleration or jerk above it does not count.
inline constexpr double kNoLimit = 1e200;

/// How one quantity (an axis, or the TCP) depends on the place, and its limits.
struct ProfileRow {
    double first, second, third; ///< derivatives by the place
    double up, down;             ///< largest acceleration in both directions, per s^2; 1e300 = unlimited
    double jerk;                 ///< per s^3; 1e300 = unlimited
};

/// The quantities at one place.
struct ProfileRows {
    static constexpr std::size_t kMost = 14;
    std::array<ProfileRow, kMost> rows; // the first ones are set
    std::size_t count = 0;
    ProfileRows() {} // NOLINT: `rows` remains as it is, cells are created often
    ProfileRows(const ProfileRows& other) : count(other.count) {
        std::copy_n(other.rows.begin(), count, rows.begin());
    }
    ProfileRows& operator=(const ProfileRows& other) {
        count = other.count;
        std::copy_n(other.rows.begin(), count, rows.begin());
        return *this;
    }
    ~ProfileRows() = default;
    void add(const ProfileRow& row) {
        if (count < kMost) rows[count++] = row;
    }
};

/// A piece of the path on which the derivatives change steadily.
struct ProfileCell {
    double width = 0;      ///< mm
    double mostSquare = 0; ///< (mm/s)^2
    bool isSmooth = true;  ///< the derivatives at its beginning are those at the end of the cell before
    ProfileRows first, last;
};

/// Place (mm from the beginning of the first cell), speed and acceleration between two cells.
struct ProfileKnot {
    double s = 0, v = 0, a = 0;
};

/// Begins with this speed and acceleration.
struct ProfileStart {
    double v = 0, a = 0; ///< both 0: at rest, and `restWidth` counts
    /// mm before the first cell, which are covered with constant jerk from rest.
    double restWidth = 0;
};

class ProfileSolver {
  public:
    struct Result {
        bool isSolved = false;
        int iterations = 0;
        double excess = 0;              ///< largest limit that is passed, as a share of it
        std::vector<ProfileKnot> knots; ///< at both ends of each cell
    };
    /// From `start` over all cells to rest `endWidth` mm after the last one. Not solved when the limits cannot be kept from
    /// `start` on.
    Result solve(const std::vector<ProfileCell>& cells, const ProfileStart& start, double endWidth);

  private:
    struct Lines {
        std::array<double, 3> place{},
            slope{}; // of a node: square of the speed and acceleration by coefficients
    };
    void prepare(const std::vector<ProfileCell>& cells, const ProfileStart& start, double endWidth);
    void setCaps(const std::vector<ProfileCell>& cells, const ProfileStart& start, double endWidth);
    void tightenCaps(const std::vector<ProfileCell>& cells);
    void setGuess(const std::vector<ProfileCell>& cells, const ProfileStart& start, double endWidth);
    void addTerms(std::size_t cell, const ProfileCell& data);
    void addAccelerations(std::size_t cell, const ProfileRows& rows, const Lines& at, double capSquare);
    void addJerks(std::size_t cell, bool isLast, const ProfileRows& rows, const Lines& at,
                  const std::array<double, 3>& change, double capSquare);
    ProfileTerms::Three folded(std::size_t cell, ProfileTerms::Three line) const;
    bool factorAndSolve();

    std::size_t cells_ = 0;
    ProfileTerms terms_;
    std::vector<double> width_, cap_, weight_;
    std::vector<char> fixed_;
    std::vector<double> coefficient_, step_; // as many as whole blocks of terms need
    ProfileMatrix matrix_;
    double firstRatio_ = 1, lastRatio_ = 1; // of the outermost coefficients to their neighbours, at rest
    bool startsAtRest_ = true;
};

} // namespace motion

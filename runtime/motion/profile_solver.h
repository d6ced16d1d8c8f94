#pragma once
// The fastest speed along a path under limits of speed, acceleration and jerk of several quantities. The square of the
// speed is a quadratic spline over the place, so that speed and acceleration are continuous and jerk changes at borders of
// cells only. Found by an interior-point method; the work grows in proportion to the number of cells. Knows no robot.

#include <algorithm>
#include <array>
#include <cstddef>
#include <vector>

namespace motion {

/// How one quantity (an axis, or the TCP) depends on the place, and its limits.
struct ProfileRow {
    double first = 0, second = 0, third = 0; ///< derivatives by the place
    double up = 1e300, down = 1e300;         ///< largest acceleration in both directions, per s^2
    double jerk = 1e300;                     ///< per s^3
};

/// The quantities at one place.
struct ProfileRows {
    static constexpr std::size_t kMost = 14;
    std::array<ProfileRow, kMost> rows;
    std::size_t count = 0;
    ProfileRows() = default;
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
    using Pair = double __attribute__((vector_size(16))); // for both sides of a term, calculated together
    struct Term { // row * coefficients lies between two limits, which fall with the speed when it is a jerk
        std::size_t at = 0;
        bool isJerk = false;
        double fall = 0;                       // of the limits of a jerk by the square of the speed
        std::array<double, 3> row{}, square{}; // square: of the speed at the place of the term
        Pair most{};                           // up and down
        Pair limit{}, value{}; // at the present coefficients; the value is below 0 when the limit is kept
        Pair slack{}, force{}, inverse{}, slackStep{}, forceStep{}; // inverse: of the slack
    };
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
    void addJerks(std::size_t cell, const ProfileRows& rows, const Lines& at,
                  const std::array<double, 3>& change, double capSquare);
    void addTerm(Term term);
    void evaluate(Term& term) const;
    void begin();
    bool evaluateTerms();
    void assemble(double target);
    bool factorAndSolve();
    struct Lengths { // of a step
        double speeds = 0, forces = 0;
    };
    Lengths stepLengths();
    void advance(const Lengths& lengths);
    double imbalance();
    double worstExcess() const;

    std::size_t cells_ = 0;
    std::vector<double> width_, coefficient_, cap_, capSlack_, capForce_, capSlackStep_, capForceStep_;
    std::vector<Term> terms_;
    double gap_ = 0; // what is still to be gained, s
    std::vector<double> diagonal_, next_, second_, right_, step_;
    std::vector<char> fixed_;
    double firstRatio_ = 1, lastRatio_ = 1; // of the outermost coefficients to their neighbours, at rest
    double target_ = 0;                     // product of slack and force that is aimed at
    bool startsAtRest_ = true;
};

} // namespace motion

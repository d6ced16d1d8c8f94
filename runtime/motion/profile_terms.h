#pragma once
// ProfileTerms: the limits of a speed profile as an interior-point method sees them, with their slacks and forces. The
// variables are coefficients of a quadratic spline, one more than the cells at each end; a cell depends on three of them.
// Four cells are calculated at a time. Knows no path.

#include <array>
#include <cstddef>
#include <vector>

namespace motion {

/// Of the normal equations: five diagonals of a symmetric matrix and the right side, one entry for each coefficient.
struct ProfileMatrix {
    std::vector<double> diagonal, next, second, right;
};

class ProfileTerms {
  public:
    using Three = std::array<double, 3>;
    static constexpr double kMargin = 1e-7; ///< share of each limit that is kept free for rounding

    /// How many numbers there are in an array with this many coefficients: up to whole blocks, the rest is 1.
    static std::size_t paddedCount(std::size_t coefficients) {
        return (coefficients + 1) / kLanes * kLanes + kLanes;
    }
    /// Forgets all terms. `caps`: the largest value of each coefficient, two more than there are cells; `weights`: what each
    /// contributes to the duration, divided by its root; `isFixed`: it does not change.
    void reset(const std::vector<double>& caps, const std::vector<double>& weights,
               const std::vector<char>& isFixed);
    /// An acceleration of a cell: row * coefficients lies between -down and up. Cells follow in ascending order.
    void addAcceleration(std::size_t cell, const Three& row, double up, double down);
    /// One end of a cell: the square of the speed by the coefficients, and what the jerks there keep when the speed is 1.
    void setEnd(std::size_t cell, bool isLast, const Three& square, double bound);
    /// A jerk there: |row * coefficients| is at most the bound divided by the speed.
    void addJerk(std::size_t cell, bool isLast, const Three& row);

    /// Slacks and forces of all limits at these coefficients, near a common product.
    void begin(const double* coefficients, double duration);
    /// The time that can still be gained, s, divided among all limits.
    double gap() const { return gap_; }
    /// Number of limits.
    std::size_t pairs() const { return pairs_; }
    double duration(const double* coefficients) const;
    /// Sets up the step towards this product of slack and force.
    void assemble(const double* coefficients, double target, ProfileMatrix& matrix);
    /// Shares of a step, of the coefficients and of the forces.
    struct Lengths {
        double speeds = 0, forces = 0;
    };
    /// The longest shares, at most 1, that keep slacks, forces and coefficients positive.
    Lengths stepLengths(const double* coefficients, const double* step);
    /// Takes the step, except for the coefficients.
    void advance(const Lengths& lengths);
    /// How far the forces are from holding the coefficients in balance, as the time that a change by their own size gains, s.
    double imbalance(const double* coefficients);
    /// Largest limit that is passed, as a share of it.
    double worstExcess(const double* coefficients) const;

    // ---- For the calculation ----
    static constexpr std::size_t kLanes = 4;
    using Quad = double __attribute__((vector_size(32)));
    /// Two limits, up and down, of one row in each of four cells.
    struct Slot {
        std::array<Quad, 3> row{};
        std::array<Quad, 2> slack{}, force{}, slackStep{}, forceStep{}, inverse{}, miss{};
        std::array<Quad, 2> most{}; // of accelerations; jerks have that of their end
        Quad used{};                // 1, or 0 where a cell has fewer rows
    };
    struct End {
        std::array<Quad, 3> square{};
        Quad bound{}, limit{}, fall{}; // fall: of the limit by the square of the speed
    };
    /// A row of slots in each of their vectors.
    struct Range {
        std::size_t begin = 0, count = 0;
    };
    /// Four cells.
    struct Block {
        std::array<End, 2> ends;
        Range accelerations;
        std::array<Range, 2> jerks;
    };
    /// Four coefficients.
    struct Caps {
        Quad cap{}, weight{}, free{}; // free: 1, or 0 when it does not change
        Quad slack{}, force{}, slackStep{}, forceStep{}, inverse{}, miss{};
    };
    struct Data {
        std::vector<Block> blocks;
        std::vector<Slot> accelerations;
        std::array<std::vector<Slot>, 2> jerks;
        std::vector<Caps> caps;
        Lengths lengths; // of the step that the slacks and forces still have to take
        double target = 0;
    };

  private:
    Slot& slotFor(std::vector<Slot>& slots, Range& range, std::size_t& used, std::size_t cell);

    Data data_;
    std::vector<std::size_t> fixed_;    // coefficients
    std::vector<double> pull_;          // of the forces on each coefficient
    std::array<std::size_t, 3> used_{}; // rows of the present cell: accelerations, jerks at both ends
    std::size_t cell_ = 0;              // the present one
    std::size_t pairs_ = 0;
    double gap_ = 0;
    std::array<double, 3> change_{}; // of the gap with a step: by the slacks, by the forces, by both
};

} // namespace motion

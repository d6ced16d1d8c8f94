#pragma once
// Joints: one figure per axis of an arm. Arms have four to seven axes, so the number is a value and not a type.

#include <algorithm>
#include <array>
#include <cstddef>
#include <initializer_list>

namespace robot {

/// Most axes an arm may have.
inline constexpr std::size_t kMostJoints = 7;
/// Number of external axis a in messages and errors; the axes of the arm, 1 to 7, come before it. (RAPID keeps axis 7 of a
/// seven-axis arm in the place of external axis a.)
inline constexpr int kFirstExternalAxis = 8;

/// Axis angles in degrees (mm for a linear axis), or a figure per axis in the unit named; at most kMostJoints, in
/// the order of Kinematics::axisNumber. Default: six zeros. The index must be below kMostJoints; entries from
/// size() on are 0.
class Joints {
  public:
    using value_type = double;
    using iterator = double*;
    using const_iterator = const double*;

    constexpr Joints() = default;
    /// As many axes as figures given (those after the seventh are left out).
    constexpr Joints(std::initializer_list<double> values) : size_(std::min(values.size(), kMostJoints)) {
        std::copy_n(values.begin(), size_, values_.begin());
    }
    /// `size` zeros (at most seven).
    static constexpr Joints zeros(std::size_t size) {
        Joints joints;
        joints.size_ = std::min(size, kMostJoints);
        return joints;
    }

    constexpr std::size_t size() const { return size_; }
    constexpr double& operator[](std::size_t i) { return values_[i]; }
    constexpr double operator[](std::size_t i) const { return values_[i]; }
    constexpr double* data() { return values_.data(); }
    constexpr const double* data() const { return values_.data(); }
    constexpr iterator begin() { return values_.data(); }
    constexpr iterator end() { return values_.data() + size_; }
    constexpr const_iterator begin() const { return values_.data(); }
    constexpr const_iterator end() const { return values_.data() + size_; }
    /// Sets every axis.
    constexpr void fill(double value) { std::fill(begin(), end(), value); }

    friend constexpr bool operator==(const Joints& a, const Joints& b) {
        return a.size_ == b.size_ && std::equal(a.begin(), a.end(), b.begin());
    }

  private:
    std::array<double, kMostJoints> values_{};
    std::size_t size_ = 6;
};

} // namespace robot

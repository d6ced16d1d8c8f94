#pragma once
// Labels of a picture that do not lie on each other.

#include <cstddef>
#include <string>
#include <vector>

namespace rt::report {

/// The place of a label: its left end and base line, and the place it belongs to.
struct PlacedLabel {
    double x = 0, y = 0;
    double atX = 0, atY = 0;
    bool placed = false; ///< false: there is no room for it
    static double widthOf(const std::string& text);
};

/// Texts that belong to the same place of the picture, as one label.
class LabelGroups {
  public:
    struct Group {
        double x = 0, y = 0;
        std::vector<std::string> texts; ///< different ones
    };
    void add(double x, double y, const std::string& text);
    const std::vector<Group>& groups() const { return groups_; }
    /// "p10, p20, p30 +2", with `most` of them by name.
    static std::string textOf(const Group& group, std::size_t most);

  private:
    std::vector<Group> groups_;
};

class LabelPlacer {
  public:
    /// Labels stay within this rectangle.
    LabelPlacer(double left, double top, double width, double height)
        : left_(left), top_(top), right_(left + width), bottom_(top + height) {}

    /// Keeps labels off a dot.
    void keepFree(double x, double y, double radius);
    PlacedLabel place(double x, double y, const std::string& text);

  private:
    struct Box {
        double left, top, right, bottom;
    };
    bool isFree(const Box& box) const;
    double left_, top_, right_, bottom_;
    std::vector<Box> taken_;
};

} // namespace rt::report

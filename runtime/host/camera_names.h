#pragma once
// The cameras of the controller by name: those of --camera, and those that the program names without.

#include "runtime/abi/rt_abi.h"
#include "runtime/base/text_util.h"

#include <string>
#include <string_view>
#include <vector>

namespace rt {

/// A service of the controller. The library reads the files of --camera before the program is connected.
class CameraNames {
  public:
    /// The error of --camera; "" when there is none.
    std::string problem;

    std::size_t size() const { return names_.size(); }
    /// -1: no camera is called so. Without regard to case.
    int find(std::string_view name) const {
        for (std::size_t i = 0; i < names_.size(); ++i)
            if (sameName(names_[i], name)) return static_cast<int>(i);
        return -1;
    }
    /// Number of the camera, which is added when it is new.
    int add(std::string_view name) {
        if (const int found = find(name); found >= 0) return found;
        names_.emplace_back(name);
        return static_cast<int>(names_.size()) - 1;
    }
    const std::string& name(int camera) const { return names_[static_cast<std::size_t>(camera)]; }
    static Handle handleOf(int camera) { return static_cast<Handle>(camera) + 1; }
    /// -1: the variable names no camera.
    int cameraOf(Handle handle) const {
        return handle >= 1 && handle <= static_cast<Handle>(names_.size()) ? static_cast<int>(handle) - 1
                                                                           : -1;
    }

  private:
    std::vector<std::string> names_;
};

} // namespace rt

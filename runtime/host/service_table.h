#pragma once
// ServiceTable: data that parts of the standard library keep in the controller or in a motion group, one object a type.

#include <map>
#include <memory>

namespace rt {

class ServiceTable {
  public:
    /// Made on first use.
    template <class T> T& get() {
        static char key = 0;
        std::shared_ptr<void>& slot = objects_[&key];
        if (!slot) slot = std::make_shared<T>();
        return *static_cast<T*>(slot.get());
    }
    void clear() { objects_.clear(); }

  private:
    std::map<const void*, std::shared_ptr<void>> objects_;
};

} // namespace rt

#pragma once
// HandleTable: objects that the controller owns and a program names by a number (clocks, files, sockets ...).
// 0 is "not connected"; a handle whose object is gone is never given out again.

#include "runtime/abi/rt_abi.h"

#include <map>
#include <utility>

namespace rt {

template <class T> class HandleTable {
  public:
    /// Makes an object; its handle is > 0.
    template <class... Args> Handle create(Args&&... args) {
        objects_.try_emplace(++last_, std::forward<Args>(args)...);
        return last_;
    }
    /// Null for 0 and for handles whose object is gone.
    T* find(Handle handle) {
        const auto found = objects_.find(handle);
        return found == objects_.end() ? nullptr : &found->second;
    }
    /// The object of a variable of the program; made on first use, the variable then holds its handle.
    T& at(Handle& slot) {
        if (T* object = find(slot)) return *object;
        slot = create();
        return objects_.at(slot);
    }
    bool erase(Handle handle) { return objects_.erase(handle) != 0; }
    void clear() { objects_.clear(); }
    std::size_t size() const { return objects_.size(); }
    auto begin() { return objects_.begin(); }
    auto end() { return objects_.end(); }

  private:
    std::map<Handle, T> objects_; // nodes: references stay valid
    Handle last_ = 0;
};

} // namespace rt

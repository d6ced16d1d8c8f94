#pragma once
// DataWatches: reports every change of module data, at safepoints, waits and when a client writes. Watches continue when the controller is
// restarted or the program replaced. While there are none, programs pay nothing.

#include "tools/service/data_path.h"
#include "tools/service/observers.h"

#include <cstdint>
#include <functional>
#include <map>
#include <string>

namespace rapidc::service {

class DataWatches {
  public:
    using Token = uint64_t;

    explicit DataWatches(VirtualController& controller);
    ~DataWatches();
    DataWatches(const DataWatches&) = delete;
    DataWatches& operator=(const DataWatches&) = delete;

    /// `changed` gets the new value as text. It may be called on the fibre of a task: it copies what it needs and returns at once.
    Token add(DataPath path, std::function<void(const std::string& value)> changed);
    void remove(Token token);
    /// A client has written data.
    void look();

  private:
    struct Watched {
        DataPath path;
        std::function<void(const std::string&)> changed;
        FoundData found;  ///< data null: not in memory at present
        std::string last; ///< bytes
    };
    /// Other modules, or another controller.
    void findAgain(bool anotherController);
    void find(Watched& watched);
    void attach();

    VirtualController& controller_;
    Observers::Token observer_ = 0;
    std::map<Token, Watched> watches_;
    Token last_ = 0;
    uint64_t schedulerWatch_ = 0; ///< 0: none
};

} // namespace rapidc::service

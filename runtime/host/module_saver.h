#pragma once
// ModuleSaver: current values of persistents into the source files (manual 1.2.2): instruction Save, option --save.

#include "runtime/host/module_store.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

class Controller;
class Task;
struct GlobalDesc;
struct LoadedModule;

class ModuleSaver {
  public:
    explicit ModuleSaver(Controller& controller) : controller_(controller) {}
    ~ModuleSaver();

    /// The writer; null: the installed rapidc.
    void setStore(std::unique_ptr<ModuleStore> store) { store_ = std::move(store); }
    /// To be called before anything changes data: what persistents hold now is what their declarations say.
    void remember();

    enum class Outcome : uint8_t { Saved, NoModule, NotWritten };
    struct Result {
        Outcome outcome = Outcome::Saved;
        std::string text; ///< why not
    };
    /// Writes a module of the task with the values its persistents have now. `destination`: path on the host; empty:
    /// the file it came from if that lies in HOME: or --save was given, else the file of that name in HOME:.
    Result save(const Task& task, std::string_view module, const std::string& destination);
    /// --save: every file whose persistents have changed. Problems are events; false when there was one.
    bool saveAll();

  private:
    /// A row of the program's table of data with what the declaration says.
    struct Declared {
        const GlobalDesc* data = nullptr;
        std::string bytes;
    };
    bool hasChanged(const Declared& declared, std::string& text) const;
    void reportOthers(const Declared& saved, const std::string& value) const;
    void remember(const GlobalDesc& data);
    void addUnit(const LoadedModule& module, ModuleText& text) const;
    std::string defaultDestination(const std::string& source) const;
    std::string hostPath(const char* file) const;
    std::string shown(const std::string& path) const;
    /// Values of changed persistents in a file; `task` < 0: of all tasks.
    std::vector<Declared*> changedIn(const std::string& source, int32_t task, ModuleText& text);
    Result write(ModuleText& text, const std::vector<Declared*>& rows, const Task* task);

    Controller& controller_;
    std::unique_ptr<ModuleStore> store_;
    std::vector<Declared> declared_;
};

} // namespace rt

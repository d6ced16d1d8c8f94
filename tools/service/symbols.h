#pragma once
// Symbols: declarations of the modules in program memory and of everything predefined, by URL ("RAPID/T_ROB1/Module1/x"), as clients look
// them up. Used on the controller's thread.

#include "frontend/sema/checked.h"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace rt {
class Task;
}

namespace rapidc::service {

class VirtualController;

enum class SymbolType : uint8_t {
    Task,
    Module,
    Atomic,
    Record,
    Alias,
    Component, ///< of a record
    Constant,
    Variable,
    Persistent,
    Parameter,
    Procedure,
    Function,
    Trap,
};

struct SymbolInfo {
    SymbolType type = SymbolType::Variable;
    std::string url, name;
    std::string dataType, typeUrl; ///< of data, components, functions, aliases; "" = none
    std::vector<int32_t> dims;     ///< 0: known at run time only
    bool isLocal = false;
    bool isTaskOnly = false; ///< TASK PERS, TASK VAR
    bool isReadOnly = false;
    bool isPredefined = false;
    bool isSystemModule = false; ///< of a module
    bool isUsed = true;
    uint32_t count = 0;           ///< components of a record, parameters of a routine
    uint32_t number = 0;          ///< of a component or a parameter, from 1
    bool isRequired = true;       ///< of a parameter
    rapid::LineColumn begin, end; ///< of the declaration; line 1, column 1 for what is predefined
};

struct SymbolQuery {
    enum class View : uint8_t {
        Block, ///< what the block declares
        Scope, ///< everything that the block sees
        Stack, ///< data of the routine in progress
    };
    View view = View::Block;
    std::string block;                               ///< URL: "RAPID", a task, module, routine or record
    std::set<SymbolType> types;                      ///< empty: any
    bool recursive = true;                           ///< with what is inside the blocks in it
    bool onlyUsed = false;                           ///< without what the program does not use
    bool skipPredefined = false;                     ///< without what all tasks share
    uint32_t frame = 0;                              ///< of the call chain, 0 = innermost
    std::string dataType;                            ///< "" = any
    std::string typeUrl;                             ///< "" = any
    std::function<bool(const std::string&)> matches; ///< a name; empty: any
};

class Symbols {
  public:
    explicit Symbols(VirtualController& controller) : controller_(controller) {}

    /// None: there is no such symbol.
    std::optional<SymbolInfo> find(std::string_view url);
    /// In the order of modules and texts. False: there is no such block.
    bool search(const SymbolQuery& query, std::vector<SymbolInfo>& found);

  private:
    /// A module with its text and, when it was compiled with the program, what the checker knows of it.
    struct ModuleView {
        std::string url;
        const rapid::syntax::SyntaxTree* tree = nullptr;
        const rapid::syntax::ModuleDecl* decl = nullptr;
        const rapid::sema::Module* checked = nullptr;
        const rapid::sema::Task* task = nullptr; ///< null: predefined
        int32_t index = -1;                      ///< of the task
    };
    struct Parsed {
        std::string text;
        std::unique_ptr<rapid::syntax::SyntaxTree> tree;
    };
    class Reader;
    class Collector;

    std::vector<ModuleView> modulesOf(const rt::Task& task);
    std::vector<ModuleView> predefined() const;
    const rapid::syntax::SyntaxTree* parsed(const rt::Task& task, const std::string& module);
    std::optional<SymbolInfo> findPredefined(std::string_view name, std::string_view component);
    std::string urlOfType(const ModuleView& view, const std::string& name);
    bool searchInside(const ModuleView& view, const std::string& name, Collector& collector);
    bool searchPredefined(const std::vector<std::string>& names, Collector& collector);
    bool searchStack(const SymbolQuery& query, const rt::Task& task, std::vector<SymbolInfo>& found);

    VirtualController& controller_;
    std::map<std::string, std::string>
        typeUrls_;                         ///< of types that other modules declare; during one question
    std::map<std::string, Parsed> parsed_; ///< modules that came while the program runs, by task and name
};

} // namespace rapidc::service

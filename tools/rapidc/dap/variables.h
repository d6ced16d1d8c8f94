#pragma once
// Variables: the client's view of data: scopes, values, their parts. References are valid until the program continues.

#include "tools/rapidc/dap/context.h"

#include <map>
#include <memory>
#include <string>
#include <vector>

namespace rapidc::dap {

class Variables {
  public:
    explicit Variables(Context& context) : context_(context) {}

    /// The scopes of a frame, or, without one, those of the task.
    Json scopes(rt::Task& task, rt::Frame* frame);
    /// The answer to `variables`.
    Json children(const Arguments& arguments);
    /// "value", "type", "variablesReference" and what belongs to it. `expression`: under which the value can be found again.
    Json describe(const rt::DebugVariable& variable, const std::string& expression,
                  std::shared_ptr<void> storage = {});
    Json set(const Arguments& arguments);
    /// Under which a child can be found again. Throws a Refusal.
    std::string expressionOf(int64_t reference, const std::string& name) const;
    /// A value as RAPID text or an expression is assigned. Throws a Refusal.
    static void assign(const rt::DebugVariable& variable, const std::string& text);
    void forget() { nodes_.clear(); }
    /// The data of the modules of a task that an expression in `module` can name.
    std::vector<rt::DebugVariable> moduleData(const rt::Task& task, const std::string& module) const;

  private:
    enum class Scope : uint8_t { None, Locals, Parameters, Module, Task, Persistents };
    struct Node {
        Scope scope = Scope::None;
        rt::Task* task = nullptr;
        rt::Frame* frame = nullptr;
        rt::DebugVariable value; ///< without scope
        std::string expression;
        std::shared_ptr<void> storage;
    };
    struct Child {
        std::string name, expression;
        rt::DebugVariable value;
        std::string text = {}, type = {}; ///< constants of a routine, which lie nowhere: instead of `value`
    };
    Child findChild(const Node& node, const std::string& name) const;

    int64_t add(Node node);
    const Node& find(int64_t reference) const;
    std::vector<Child> childrenOf(const Node& node, uint64_t start, uint64_t count) const;
    std::vector<Child> scopeOf(const Node& node) const;
    /// Of the routine of a frame: its parameters, or its own data and constants.
    std::vector<Child> routineData(const Node& node, bool parameters) const;
    Json entry(const Child& child, const std::shared_ptr<void>& storage);

    Context& context_;
    std::map<int64_t, Node> nodes_;
    int64_t last_ = 0;
};

} // namespace rapidc::dap

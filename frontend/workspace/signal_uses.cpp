#include "frontend/workspace/signal_uses.h"

#include "frontend/sema/names.h"
#include "frontend/syntax/tree_walk.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <set>

namespace rapid::workspace {

namespace {

using namespace syntax;
using sema::BoundArg;
using sema::BoundCall;
using sema::CheckedProgram;
using sema::ConstValue;
using sema::DataSymbol;
using sema::Module;
using sema::TypeKind;

/// The values that a group signal is written with or compared with.
struct GroupValues {
    double most = 0;
    bool seen = false;
    bool unknown = false; ///< of one the value is not known
    void add(const GroupValues& other) {
        most = std::max(most, other.most);
        seen |= other.seen;
        unknown |= other.unknown;
    }
    bool operator==(const GroupValues&) const = default;
};

bool isSignal(const DataSymbol& data) {
    return data.type.type && data.type.type->kind == TypeKind::SemiValue;
}

/// "GI" of "signalgi".
std::string shortType(const DataSymbol& data) {
    const std::string name = sema::foldName(data.type.type->base()->name);
    std::string type = name.size() > 6 ? name.substr(6) : name;
    std::transform(type.begin(), type.end(), type.begin(), [](unsigned char c) { return std::toupper(c); });
    return type;
}

/// Reads all modules: the values of groups, and which signal another name stands for.
class UseReader {
  public:
    explicit UseReader(const CheckedProgram& program) : program_(program) {}

    void read(const Module& module) {
        module_ = &module;
        for (const sema::RoutineSymbol* routine : module.routines)
            if (routine->routineDecl) visit(*routine->routineDecl);
    }

    /// What is known of a parameter or an alias holds for the signals it stands for.
    void finish() {
        constexpr int kMostRounds = 20;
        for (int round = 0; round < kMostRounds; ++round) {
            bool changed = false;
            for (const auto& [name, signal] : standsFor_) {
                const GroupValues before = values_[signal];
                values_[signal].add(values_[name]);
                changed |= !(before == values_[signal]);
            }
            if (!changed) return;
        }
    }

    unsigned bitsOf(const DataSymbol& signal) const {
        const auto found = values_.find(&signal);
        if (found == values_.end() || !found->second.seen || found->second.unknown) return 32;
        constexpr double kByte = 256, kWord = 65536;
        return found->second.most < kByte ? 8 : found->second.most < kWord ? 16 : 32;
    }
    /// Names in strings of AliasIO, with an alias of the type.
    const std::vector<std::pair<std::string, const DataSymbol*>>& byText() const { return byText_; }

  private:
    const sema::ExprInfo& info(const Expr& e) const { return program_.info(*module_, e); }

    const DataSymbol* signalIn(const Expr& expr) const {
        const Expr& e = bare(expr);
        if (e.kind == NodeKind::Call) { // GInput(giPart)
            const BoundCall* call = find(e);
            return call && call->routine && call->routine->predefined && !call->args.empty() &&
                           call->args.front().value
                       ? signalIn(*call->args.front().value)
                       : nullptr;
        }
        if (e.kind != NodeKind::Name) return nullptr;
        const sema::Symbol* symbol = info(e).symbol;
        if (!symbol || symbol->kind != sema::SymbolKind::Data) return nullptr;
        const auto& data = static_cast<const DataSymbol&>(*symbol);
        return isSignal(data) ? &data : nullptr;
    }

    const BoundCall* find(const Node& node) const {
        const auto found = module_->facts->calls.find(&node);
        return found == module_->facts->calls.end() ? nullptr : &found->second;
    }

    const ConstValue* constantOf(const Expr& e) const {
        const sema::ExprInfo& known = info(e);
        if (known.constant || !known.symbol || known.symbol->kind != sema::SymbolKind::Data)
            return known.constant;
        const auto& data = static_cast<const DataSymbol&>(*known.symbol);
        return data.isLiteralConstant() ? &data.value() : nullptr;
    }

    void noteValue(const DataSymbol& signal, const Expr& value) {
        GroupValues& values = values_[&signal];
        values.seen = true;
        const ConstValue* known = constantOf(value);
        if (known && known->kind == ConstValue::Kind::Number)
            values.most = std::max(values.most, known->number);
        else
            values.unknown = true;
    }

    void compare(const Expr& side, const Expr& value) {
        if (const DataSymbol* signal = signalIn(side); signal && !signalIn(value)) noteValue(*signal, value);
    }

    void visit(const Node& node) {
        if (node.kind == NodeKind::Aggregate && as<AggregateExpr>(node).isPlain()) return;
        if (node.kind == NodeKind::Binary) {
            for (const Node* e = &node;; e = as<BinaryExpr>(*e).left) {
                if (e->kind != NodeKind::Binary) return visit(*e);
                const auto& binary = as<BinaryExpr>(*e);
                if (binary.op >= BinaryOp::Lt && binary.op <= BinaryOp::Ge) {
                    compare(*binary.left, *binary.right);
                    compare(*binary.right, *binary.left);
                }
                visit(*binary.right);
            }
        }
        if (node.kind == NodeKind::Test && as<TestStmt>(node).subject)
            for (const TestCase* c : as<TestStmt>(node).cases)
                for (const Expr* value : c->values)
                    compare(*as<TestStmt>(node).subject, *value);
        if (node.kind == NodeKind::CallStmt || node.kind == NodeKind::Call)
            if (const BoundCall* call = find(node); call && call->routine) visitCall(*call);
        forEachChild(node, [this](const Node& child) { visit(child); });
    }

    /// SetGO, WaitGI, TriggIO: the values beside the group. A routine of the program: its parameter is the signal.
    void visitCall(const BoundCall& call) {
        const DataSymbol* signal = nullptr;
        for (const BoundArg& arg : call.args) {
            if (!arg.value || arg.kind != BoundArg::Kind::Present) continue;
            const DataSymbol* given =
                bare(*arg.value).kind == NodeKind::Name ? signalIn(*arg.value) : nullptr;
            if (!given) continue;
            if (call.routine->predefined)
                signal = signal ? signal : given;
            else
                standsFor_.insert({arg.param, given});
        }
        if (!signal || !call.routine->predefined) return;
        for (const BoundArg& arg : call.args) {
            if (!arg.value || !arg.param || arg.kind != BoundArg::Kind::Present) continue;
            if (arg.param->accepts == sema::ParamClass::SignalOrString) alias(call, *arg.value);
            const bool isValue = sema::foldName(arg.param->name).find("value") != std::string::npos;
            if (isValue && !signalIn(*arg.value)) noteValue(*signal, *arg.value);
        }
    }

    /// AliasIO "config_do", alias_do;
    void alias(const BoundCall& call, const Expr& from) {
        for (const BoundArg& arg : call.args) {
            const DataSymbol* to = arg.value && arg.value != &from ? signalIn(*arg.value) : nullptr;
            if (!to) continue;
            if (const DataSymbol* signal = signalIn(from)) standsFor_.insert({to, signal});
            const ConstValue* text = constantOf(from);
            if (text && text->kind == ConstValue::Kind::String && !text->text().empty())
                byText_.emplace_back(std::string(text->text()), to);
        }
    }

    const CheckedProgram& program_;
    const Module* module_ = nullptr;
    std::map<const DataSymbol*, GroupValues> values_;
    std::set<std::pair<const DataSymbol*, const DataSymbol*>> standsFor_; ///< parameter or alias, signal
    std::vector<std::pair<std::string, const DataSymbol*>> byText_;
};

} // namespace

std::vector<UsedSignal> usedSignals(const CheckedProgram& program,
                                    const std::vector<sema::SignalInfo>& configured) {
    UseReader reader(program);
    for (const auto& task : program.tasks)
        for (const Module* module : task->modules)
            reader.read(*module);
    reader.finish();
    std::map<std::string, UsedSignal> found; // by name in lower case
    std::set<std::string> known;
    for (const sema::SignalInfo& signal : configured)
        known.insert(sema::foldName(signal.name));
    const auto add = [&](const std::string& name, const DataSymbol& data, const std::string& task) {
        const std::string type = shortType(data);
        const unsigned bits = type[0] == 'G' ? reader.bitsOf(data) : 0;
        const auto [entry, isNew] = found.try_emplace(sema::foldName(name), UsedSignal{name, type, bits, {}});
        UsedSignal& signal = entry->second;
        if (isNew) return;
        if (signal.type == type)
            signal.bits = std::max(signal.bits, bits);
        else
            signal.contradiction = fmt::format("{} in task '{}'", type, task);
    };
    for (const auto& task : program.tasks)
        for (const DataSymbol* signal : task->signals)
            if (isSignal(*signal) && signal->assumed) add(signal->name, *signal, task->name);
    for (const auto& [name, data] : reader.byText())
        if (!known.contains(sema::foldName(name))) add(name, *data, "");
    std::vector<UsedSignal> signals;
    for (auto& [name, signal] : found)
        signals.push_back(std::move(signal));
    return signals;
}

std::string writeSignals(const std::vector<UsedSignal>& signals) {
    std::string text = "EIO:CFG_1.0:7:0::\n#\n\nEIO_SIGNAL:\n";
    for (const UsedSignal& signal : signals) {
        text += fmt::format("\n      -Name \"{}\" -SignalType \"{}\"", signal.name, signal.type);
        if (signal.bits > 0) text += fmt::format(" -Size {}", signal.bits);
        text += "\n";
    }
    return text;
}

std::string describeSignals(const std::vector<UsedSignal>& signals) {
    std::map<std::string, size_t> counts;
    for (const UsedSignal& signal : signals)
        ++counts[signal.type];
    std::string types;
    for (const auto& [type, count] : counts)
        types += fmt::format("{}{} {}", types.empty() ? "" : ", ", count, type);
    return fmt::format("{} signal{} assumed ({})", signals.size(), signals.size() == 1 ? " is" : "s are",
                       types);
}

} // namespace rapid::workspace

#pragma once
// Facts that the walks over routines collect for the judgements about the whole task. Internal to frontend/lint.

#include "frontend/lint/warnings.h"
#include "frontend/sema/checked.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <tuple>
#include <unordered_map>
#include <unordered_set>

namespace rapid::lint {

using diag::Code;
namespace say = diag::say;

/// Reports what is switched on.
class Reporter {
  public:
    Reporter(const WarningLevels& levels, diag::Sink& sink, bool severalTasks)
        : levels_(levels), sink_(sink), severalTasks_(severalTasks) {}
    bool isOn(Code code) const { return levels_.isOn(code); }
    /// Null when the warning is switched off.
    template <size_t N>
    diag::Diagnostic* report(diag::Message<N> message, const syntax::SyntaxTree& tree, SourceRange where,
                             diag::MessageArgs<N> args) {
        return report(message.code, tree, where, std::span<const std::string>(args));
    }
    /// For a code that is known at run time only; the number of `args` must match the catalogue.
    diag::Diagnostic* report(Code code, const syntax::SyntaxTree& tree, SourceRange where,
                             std::span<const std::string> args);

  private:
    const WarningLevels& levels_;
    diag::Sink& sink_;
    bool severalTasks_;
    std::set<std::tuple<Code, std::string, uint32_t>> reported_;
};

/// The possible effects of a call of a routine, through all calls in it.
enum Conduct : uint8_t {
    kWaits = 1,  ///< it can wait: for a time, a signal, a movement, somebody
    kEnds = 2,   ///< it can end what calls it: EXIT, RAISE, Stop ...
    kRaises = 4, ///< something in it can fail, which may be meant to end what calls it
};

struct RoutineFacts {
    uint8_t conduct = 0;               ///< of Conduct; its own, later also that of what it calls
    size_t firstCall = 0, endCall = 0; ///< in TaskFacts::calls
};

/// A finding that holds unless one of the routines called there has a certain conduct.
struct Suspicion {
    Code code{};
    const syntax::SyntaxTree* tree = nullptr;
    SourceRange where;
    std::string arg; ///< of the message; empty if it takes none
    size_t firstCall = 0, endCall = 0;
    uint8_t refutedBy = 0; ///< of Conduct
};

/// An interrupt passed to an instruction that needs it connected.
struct InterruptUse {
    const sema::DataSymbol* interrupt = nullptr;
    const sema::RoutineSymbol* native = nullptr;
    const syntax::SyntaxTree* tree = nullptr;
    SourceRange where;
};

/// Data compared with a fraction. It meets it exactly when it was set from the same value.
struct FractionUse {
    const sema::DataSymbol* data = nullptr;
    double value = 0;
    const syntax::SyntaxTree* tree = nullptr;
    SourceRange where;
    std::string operation, text; ///< the arguments of the message
};

struct TaskFacts {
    std::unordered_map<const sema::RoutineSymbol*, RoutineFacts> routines;
    std::vector<const sema::RoutineSymbol*> calls; ///< of routines of the user, those of one routine together
    std::vector<Suspicion> suspicions;
    std::vector<InterruptUse> interrupts;
    std::vector<FractionUse> fractions; ///< of data that outlives a routine, parameters
    std::set<std::pair<const sema::DataSymbol*, double>> numbers; ///< fractions such data is set from
    std::unordered_set<const sema::Symbol*> connected; ///< interrupts that stand in CONNECT or are passed on
    bool callsByName = false;                          ///< late binding: any procedure may be called
    bool dataByName = false;                           ///< GetDataVal and the like: any data may be used
};

/// Calls `visit` for the numbers in a constant that are not integers; of large constants for the first ones.
template <class Visit> void forEachFraction(const sema::ConstValue& value, const Visit& visit) {
    constexpr size_t kMost = 32;
    if (value.kind == sema::ConstValue::Kind::Number && value.number != std::floor(value.number))
        visit(value.number);
    const std::span<sema::ConstValue> members = value.members();
    for (const sema::ConstValue& member : members.first(std::min(members.size(), kMost)))
        forEachFraction(member, visit);
}

/// byte, or another name of it.
bool isByte(const sema::DataType& type);
/// The first number outside 0 to 255, or not whole, in the value of a byte or array of bytes; null if none is.
const double* firstBeyondByte(const sema::ConstValue& value);

/// Predefined things by name, for what hides them.
struct Predefined {
    std::vector<const sema::Symbol*> byName; ///< by Symbol::nameId
    explicit Predefined(const sema::CheckedProgram& program);
};

} // namespace rapid::lint

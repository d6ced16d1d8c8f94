// The rule of BACKWARD handlers: their movements mirror kind and order of those in the body (manual 1.21).

#include "frontend/lint/backward.h"
#include "frontend/diag/messages/warnings.h"

#include <algorithm>
#include <fmt/format.h>
#include <optional>

namespace rapid::lint {

using namespace syntax;
using sema::BoundCall;
using sema::DataSymbol;
using sema::RoutineSymbol;

namespace {

struct Movement {
    enum class Kind : uint8_t { Joint, Linear, Circular } kind = Kind::Joint;
    const CallStmt* stmt = nullptr;
    const RoutineSymbol* routine = nullptr;
    const Expr* circlePoint = nullptr;
    const Expr* target = nullptr;
};
using Movements = std::vector<Movement>;

bool continues(sema::Flow flow) {
    return flow == sema::Flow::Continues || flow == sema::Flow::Stops;
}

constexpr const char* kKindNames[] = {"joint", "linear", "circular"};

class BackwardJudge {
  public:
    BackwardJudge(const RoutineSymbol& routine, Reporter& reporter)
        : module_(*routine.module), tree_(*module_.tree), reporter_(reporter) {}

    void run(const RoutineDecl& decl) {
        const std::optional<Movements> body = movements(decl.body), handler = movements(decl.backward);
        if (!body || !handler || handler->empty())
            return; // an empty handler says that there is nothing to do
        for (size_t i = 0; i < handler->size(); ++i) {
            const Movement& found = (*handler)[i];
            if (i >= body->size())
                return report(found, body->empty() ? "the body moves nothing"
                                                   : fmt::format("the body has only {} movement{}",
                                                                 body->size(), body->size() == 1 ? "" : "s"));
            if (differs(found, (*body)[body->size() - 1 - i], body->size() - i)) return;
        }
        if (handler->size() < body->size())
            return report(handler->back(), fmt::format("the body has {} movements, the handler only {}",
                                                       body->size(), handler->size()));
        judgeOrder(*body, *handler);
    }

  private:
    /// Those of a part that is carried out from its beginning to its end; nothing where that is not certain.
    std::optional<Movements> movements(StmtList list) const {
        Movements out;
        for (const Stmt* s : list) {
            if (s->kind == NodeKind::Assign || s->kind == NodeKind::Connect) continue;
            if (s->kind == NodeKind::Return && s == list.back()) continue;
            if (s->kind != NodeKind::CallStmt) return std::nullopt;
            const auto call = module_.facts->calls.find(s);
            if (call == module_.facts->calls.end() || !call->second.routine) return std::nullopt;
            const RoutineSymbol& routine = *call->second.routine;
            if (!routine.native || !continues(routine.flow)) return std::nullopt;
            if (routine.effects != sema::Effects::Motion) continue;
            std::optional<Movement> movement = movementOf(as<CallStmt>(*s), call->second);
            if (!movement) return std::nullopt;
            if (movement->target) out.push_back(*movement);
        }
        return out;
    }

    /// Without a target where the instruction moves to none; nothing where the kind of its path is not declared.
    std::optional<Movement> movementOf(const CallStmt& stmt, const BoundCall& call) const {
        Movement out;
        out.stmt = &stmt;
        out.routine = call.routine;
        for (const sema::BoundArg& arg : call.args) {
            if (!arg.param || arg.param->optional) continue;
            if (arg.param->name == "CirPoint") out.circlePoint = arg.value;
            if (arg.param->name == "ToPoint" || arg.param->name == "ToJointPos") out.target = arg.value;
        }
        const sema::Traits& traits = call.routine->traits;
        if (traits.has(sema::Trait::Circular))
            out.kind = Movement::Kind::Circular;
        else if (traits.has(sema::Trait::Joint))
            out.kind = Movement::Kind::Joint;
        else if (traits.has(sema::Trait::Linear))
            out.kind = Movement::Kind::Linear;
        else if (out.target)
            return std::nullopt;
        return out;
    }

    bool differs(const Movement& found, const Movement& mirrored, size_t number) {
        if (found.kind != mirrored.kind) {
            report(found, fmt::format("it is {}, but '{}', movement {} of the body, is {}",
                                      kKindNames[static_cast<size_t>(found.kind)], mirrored.routine->name,
                                      number, kKindNames[static_cast<size_t>(mirrored.kind)]));
            return true;
        }
        if (!found.circlePoint) return false;
        const DataSymbol *circle = named(mirrored.circlePoint), *target = named(mirrored.target);
        const bool swapped = circle && target && circle != target && named(found.circlePoint) == target &&
                             named(found.target) == circle;
        if (swapped)
            report(found, fmt::format("circle point and end point stay in the order of the body, '{}', '{}'",
                                      circle->name, target->name));
        return swapped;
    }

    /// The same targets in the order of the body: not turned round.
    void judgeOrder(const Movements& body, const Movements& handler) {
        const auto sameTarget = [&](const Movement& a, const Movement& b) {
            return named(a.target) && named(a.target) == named(b.target);
        };
        if (!std::equal(body.begin(), body.end(), handler.begin(), sameTarget)) return;
        if (std::equal(body.rbegin(), body.rend(), handler.begin(), sameTarget)) return;
        report(handler.front(), fmt::format("the targets are in the order of the body, expected '{}' first",
                                            named(body.back().target)->name));
    }

    const DataSymbol* named(const Expr* e) const {
        if (!e || e->kind != NodeKind::Name) return nullptr;
        const sema::Symbol* symbol = (*module_.exprs)[e->id].symbol;
        return symbol && symbol->kind == sema::SymbolKind::Data ? static_cast<const DataSymbol*>(symbol)
                                                                : nullptr;
    }

    void report(const Movement& movement, std::string why) {
        reporter_.report(say::BackwardNotMirrored, tree_, tree_.range(movement.stmt->name),
                         {movement.routine->name, std::move(why)});
    }

    const sema::Module& module_;
    const SyntaxTree& tree_;
    Reporter& reporter_;
};

} // namespace

void judgeBackward(const RoutineSymbol& routine, Reporter& reporter) {
    if (routine.routineDecl->backward.empty() || !reporter.isOn(say::BackwardNotMirrored.code)) return;
    BackwardJudge(routine, reporter).run(*routine.routineDecl);
}

} // namespace rapid::lint

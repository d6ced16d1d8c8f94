// Knowledge about optional parameters at each place, from conditions with Present. Presence never changes while a
// routine runs, so what is known stays known, but for the places where several ways meet.

#include "frontend/lint/presence.h"

#include "frontend/diag/messages/warnings.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <utility>

namespace rapid::lint {

using namespace syntax;
using sema::DataSymbol;
using sema::RoutineSymbol;

namespace {

class PresenceWalk {
  public:
    PresenceWalk(const RoutineSymbol& routine, Reporter& reporter)
        : routine_(routine), module_(*routine.module), reporter_(reporter),
          known_(routine.params.size(), Known::Nothing), reported_(routine.params.size(), false) {}

    void run() {
        const RoutineDecl& decl = *routine_.routineDecl;
        list(decl.body);
        // An ERROR handler may be the answer to a parameter that is missing (ERR_NOTPRES).
        if (!decl.errors.empty()) std::erase_if(uses_, [](const Use& use) { return use.passedBy; });
        for (const ErrorClause* clause : decl.errors)
            handler(clause->body);
        handler(decl.backward);
        handler(decl.undo);
        for (const Use& use : uses_) // the checker reports parameters that are never checked
            if (tested_.count(use.param->group) > 0) report(*use.param, *use.place);
    }

  private:
    /// Doubtful: the condition asks for it and holds without it all the same, "Present(x) OR ...".
    enum class Known : uint8_t { Nothing, Present, Absent, Doubtful };
    using State = std::vector<Known>;
    struct Use {
        const DataSymbol* param;
        const Expr* place;
        bool passedBy; ///< it was not checked on the way to this place
    };

    /// The place where the body was left is not known.
    void handler(StmtList body) {
        std::fill(known_.begin(), known_.end(), Known::Nothing);
        certain_ = false;
        list(body);
    }

    const sema::ExprInfo& info(const Expr& e) const { return (*module_.exprs)[e.id]; }

    const DataSymbol* ownOptional(const Expr& e) const {
        if (e.kind != NodeKind::Name) return nullptr;
        const sema::Symbol* symbol = info(e).symbol;
        if (!symbol || symbol->kind != sema::SymbolKind::Data) return nullptr;
        const auto* data = static_cast<const DataSymbol*>(symbol);
        const bool own = data->routine == &routine_ && data->storage == sema::Storage::Parameter;
        return own && data->optional && !data->isSwitch ? data : nullptr;
    }
    bool isCallOf(const Expr& e, sema::Role role) const {
        if (e.kind != NodeKind::Call) return false;
        const auto found = module_.facts->calls.find(&e);
        const RoutineSymbol* routine = found == module_.facts->calls.end() ? nullptr : found->second.routine;
        return routine && routine->role == role;
    }
    /// The parameter that `e` checks: Present(x). Also of switches, which decide about their alternatives.
    const DataSymbol* asked(const Expr& e) const {
        if (!isCallOf(e, sema::Role::Present)) return nullptr;
        const sema::BoundCall& call = module_.facts->calls.find(&e)->second;
        if (call.args.empty()) return nullptr;
        const Expr* value = call.args.front().value;
        if (!value || value->kind != NodeKind::Name) return nullptr;
        const sema::Symbol* symbol = info(*value).symbol;
        if (!symbol || symbol->kind != sema::SymbolKind::Data) return nullptr;
        const auto* data = static_cast<const DataSymbol*>(symbol);
        const bool own = data->routine == &routine_ && data->optional;
        return own && data->index < known_.size() ? data : nullptr;
    }
    bool isConstant(const Expr& e, bool value) const {
        const sema::ConstValue* constant = info(e).constant;
        return constant && constant->kind == sema::ConstValue::Kind::Bool && constant->boolean == value;
    }

    /// The knowledge when `e` is TRUE, or FALSE.
    void learn(const Expr& e, bool truth) {
        if (const DataSymbol* param = asked(e)) {
            settle(*param, truth);
        } else if (e.kind == NodeKind::Paren) {
            learn(*as<ParenExpr>(e).inner, truth);
        } else if (e.kind == NodeKind::Unary && as<UnaryExpr>(e).op == UnaryOp::Not) {
            learn(*as<UnaryExpr>(e).operand, !truth);
        } else if (e.kind == NodeKind::Binary) {
            const auto& binary = as<BinaryExpr>(e);
            const bool both = binary.op == (truth ? BinaryOp::And : BinaryOp::Or);
            if (both) {
                learn(*binary.left, truth);
                learn(*binary.right, truth);
            } else if (binary.op == BinaryOp::Or) {
                doubt(*binary.left);
                doubt(*binary.right);
            } else if (binary.op == BinaryOp::Eq || binary.op == BinaryOp::Ne) {
                const bool equal = (binary.op == BinaryOp::Eq) == truth;
                if (isConstant(*binary.right, true)) learn(*binary.left, equal);
                if (isConstant(*binary.right, false)) learn(*binary.left, !equal);
            }
        }
    }

    void settle(const DataSymbol& param, bool present) {
        if (present) // it excludes its alternatives
            for (const DataSymbol* other : routine_.params)
                if (other->optional && other->group == param.group) known_[other->index] = Known::Absent;
        known_[param.index] = present ? Known::Present : Known::Absent;
    }
    /// One side of an OR that holds: what it asks for need not be there.
    void doubt(const Expr& side) {
        const DataSymbol* param = asked(side);
        if (!param && side.kind == NodeKind::Unary) param = asked(*as<UnaryExpr>(side).operand);
        if (param && known_[param->index] == Known::Nothing) known_[param->index] = Known::Doubtful;
    }

    /// The knowledge that both paths share.
    static State merged(State a, const State& b) {
        for (size_t i = 0; i < a.size(); ++i)
            if (a[i] != b[i]) a[i] = Known::Nothing;
        return a;
    }

    void use(const DataSymbol& param, const Expr& e) {
        const Known known = known_[param.index];
        const bool passedBy = certain_ && isOpen(param);
        if (known == Known::Absent || known == Known::Doubtful || passedBy)
            uses_.push_back({&param, &e, passedBy});
    }

    /// Whether nothing is known of the parameter and of those that exclude it.
    bool isOpen(const DataSymbol& param) const {
        return std::all_of(routine_.params.begin(), routine_.params.end(), [&](const DataSymbol* other) {
            return other->group != param.group || known_[other->index] == Known::Nothing;
        });
    }

    void expr(const Expr& e) {
        if (const DataSymbol* param = ownOptional(e)) {
            use(*param, e);
            return;
        }
        if (const DataSymbol* param = asked(e)) {
            tested_.insert(param->group);
            return;
        }
        if (e.kind == NodeKind::Call) {
            arguments(e, as<CallExpr>(e).args);
            return;
        }
        if (e.kind == NodeKind::Binary) {
            const auto& binary = as<BinaryExpr>(e);
            expr(*binary.left);
            if (binary.op != BinaryOp::And && binary.op != BinaryOp::Or) {
                expr(*binary.right);
                return;
            }
            const State before = known_;
            const bool outer = std::exchange(certain_, false);
            learn(*binary.left, binary.op == BinaryOp::And);
            expr(*binary.right);
            known_ = before;
            certain_ = outer;
            return;
        }
        forEachChild(e, [&](const Node& child) {
            if (isExpr(child.kind)) expr(static_cast<const Expr&>(child));
        });
    }

    void arguments(const Node& node, std::span<Argument* const> args) {
        const auto found = module_.facts->calls.find(&node);
        const bool looksOnly = found != module_.facts->calls.end() && found->second.routine &&
                               found->second.routine->traits.has(sema::Trait::Inspects);
        for (const Argument* arg : args) {
            if (!arg->value || arg->argKind == ArgKind::Conditional) continue;
            if (looksOnly && ownOptional(*arg->value)) continue;
            expr(*arg->value);
        }
    }

    /// A condition of IF or WHILE: it is understood, or else nothing after it is certain.
    bool isPlain(const Expr& e) const {
        if (asked(e)) return true;
        if (e.kind == NodeKind::Paren) return isPlain(*as<ParenExpr>(e).inner);
        if (e.kind == NodeKind::Unary) return isPlain(*as<UnaryExpr>(e).operand);
        return false;
    }

    /// Whether the end of the list is reached.
    bool list(StmtList stmts) {
        bool continues = true;
        for (const Stmt* s : stmts) {
            if (s->kind == NodeKind::Label) {
                std::fill(known_.begin(), known_.end(), Known::Nothing); // a jump may come from anywhere
                certain_ = false;
                continues = true;
            }
            const bool passes = statement(*s);
            continues = continues && passes;
        }
        return continues;
    }

    bool branch(StmtList body) {
        const bool outer = std::exchange(certain_, false);
        const bool continues = list(body);
        certain_ = outer;
        return continues;
    }

    void whileStmt(const WhileStmt& loop) {
        if (!loop.condition) return;
        expr(*loop.condition);
        const State before = known_;
        learn(*loop.condition, true);
        const size_t leaves = leaves_;
        branch(loop.body);
        certain_ = certain_ && leaves == leaves_;
        known_ = before;
    }

    void forStmt(const ForStmt& loop) {
        for (const Expr* bound : {loop.from, loop.to, loop.step})
            if (bound) expr(*bound);
        const State before = known_;
        // It runs at least once where its bounds are written down.
        const bool outer = certain_;
        certain_ = certain_ && runsOnce(loop);
        const size_t leaves = leaves_;
        list(loop.body);
        certain_ = outer && leaves == leaves_ && !hopeless_;
        known_ = before;
    }

    bool statement(const Stmt& s) {
        switch (s.kind) {
        case NodeKind::If: return ifStmt(as<IfStmt>(s));
        case NodeKind::CompactIf: {
            const auto& compact = as<CompactIfStmt>(s);
            if (!compact.condition || !compact.body) return true;
            IfBranch branchOf;
            Stmt* body = compact.body;
            branchOf.condition = compact.condition;
            branchOf.body = StmtList(&body, 1);
            IfBranch* branches[] = {&branchOf};
            IfStmt whole;
            whole.branches = branches;
            return ifStmt(whole);
        }
        case NodeKind::While: whileStmt(as<WhileStmt>(s)); return true;
        case NodeKind::For: forStmt(as<ForStmt>(s)); return true;
        case NodeKind::Test: return testStmt(as<TestStmt>(s));
        case NodeKind::CallStmt: {
            const auto& call = as<CallStmt>(s);
            if (call.lateName) expr(*call.lateName);
            arguments(s, call.args);
            return continuesAfter(s);
        }
        case NodeKind::Assign: {
            const auto& assign = as<AssignStmt>(s);
            // "bGiven := Present(x);": what depends on it cannot be followed.
            if (assign.value && mentionsPresent(*assign.value)) {
                hopeless_ = true;
                certain_ = false;
            }
            break;
        }
        default: break;
        }
        forEachChild(s, [&](const Node& child) {
            if (isExpr(child.kind)) expr(static_cast<const Expr&>(child));
        });
        switch (s.kind) {
        case NodeKind::Break:
        case NodeKind::Continue:
            if (module_.facts->calls.find(&s) != module_.facts->calls.end()) return continuesAfter(s);
            ++leaves_;
            return false;
        case NodeKind::Return:
        case NodeKind::Raise:
        case NodeKind::Exit:
        case NodeKind::Goto:
        case NodeKind::Retry:
        case NodeKind::TryNext: ++leaves_; return false;
        default: return true;
        }
    }

    /// Whether it is written down that the body is carried out.
    bool runsOnce(const ForStmt& loop) const {
        const auto* from = numberOf(loop.from);
        if (!from || !loop.to) return false;
        const auto* to = numberOf(loop.to);
        if (!to) return !loop.step && *from <= 1 && isCallOf(*loop.to, sema::Role::Dim);
        const auto* step = numberOf(loop.step);
        if (loop.step && !step) return false;
        return !step || (*step < 0 ? *from >= *to : *from <= *to);
    }
    const double* numberOf(const Expr* e) const {
        const sema::ConstValue* value = e ? info(*e).constant : nullptr;
        return value && value->kind == sema::ConstValue::Kind::Number ? &value->number : nullptr;
    }

    bool continuesAfter(const Stmt& s) {
        const auto found = module_.facts->calls.find(&s);
        if (found == module_.facts->calls.end() || !found->second.routine) return true;
        const bool comesBack =
            continues(found->second.routine->flow) && !endsElsewhere(*found->second.routine);
        if (!comesBack) ++leaves_;
        return comesBack;
    }
    static bool continues(sema::Flow flow) {
        return flow == sema::Flow::Continues || flow == sema::Flow::Stops;
    }

    /// "IF NOT Present(x) giveUp;": a procedure of this module whose last instruction is EXIT or RAISE.
    bool endsElsewhere(const RoutineSymbol& routine) const {
        if (routine.module != &module_ || !routine.routineDecl || routine.routineDecl->body.empty())
            return false;
        const Stmt* last = routine.routineDecl->body.back();
        if (last->kind != NodeKind::CallStmt)
            return last->kind == NodeKind::Exit || last->kind == NodeKind::Raise;
        const auto found = module_.facts->calls.find(last);
        return found != module_.facts->calls.end() && found->second.routine &&
               !continues(found->second.routine->flow);
    }

    bool mentionsPresent(const Expr& e) const {
        if (asked(e)) return true;
        bool found = false;
        forEachChild(e, [&](const Node& child) {
            if (child.kind == NodeKind::Argument) {
                const Expr* value = static_cast<const Argument&>(child).value;
                found = found || (value && mentionsPresent(*value));
            } else if (isExpr(child.kind)) {
                found = found || mentionsPresent(static_cast<const Expr&>(child));
            }
        });
        return found;
    }

    bool ifStmt(const IfStmt& s) {
        State after;
        bool completes = false;
        const auto meet = [&](bool continues) {
            if (!continues) return;
            after = completes ? merged(std::move(after), known_) : known_;
            completes = true;
        };
        const bool outer = certain_;
        bool understood = true;
        for (const IfBranch* one : s.branches) {
            if (one->condition) expr(*one->condition);
            certain_ = false; // the next condition is evaluated on one of the ways only
            const State before = known_;
            if (one->condition) learn(*one->condition, true);
            const bool continues = branch(one->body);
            if (!continues && one->condition && !isPlain(*one->condition)) understood = false;
            meet(continues);
            known_ = before;
            if (one->condition) learn(*one->condition, false);
        }
        meet(!s.hasElse || branch(s.elseBody));
        certain_ = outer && understood && !hopeless_;
        if (completes) known_ = after;
        return completes;
    }

    bool testStmt(const TestStmt& s) {
        if (s.subject) expr(*s.subject);
        const State before = known_;
        const bool outer = std::exchange(certain_, false);
        const bool isTrue = s.subject && isConstant(*s.subject, true);
        const bool asks = s.subject && asked(*s.subject);
        bool leaves = false;
        for (const TestCase* one : s.cases) {
            for (const Expr* value : one->values)
                expr(*value);
            const Expr* only = one->values.size() == 1 ? one->values.front() : nullptr;
            if (only && isTrue) learn(*only, true);
            if (only && asks && (isConstant(*only, true) || isConstant(*only, false)))
                learn(*s.subject, isConstant(*only, true));
            leaves |= !list(one->body);
            known_ = before;
        }
        const bool last = list(s.defaultBody);
        known_ = before;
        certain_ = outer && !leaves && last && !hopeless_;
        return true;
    }

    void report(const DataSymbol& param, const Expr& e) {
        if (reported_[param.index]) return;
        reported_[param.index] = true;
        const SyntaxTree& tree = *module_.tree;
        diag::Diagnostic* d = reporter_.report(say::OptionalMayBeMissing, tree, tree.range(e), {param.name});
        if (d)
            d->notes.push_back(
                {tree.source, tree.range(param.nameToken), "'" + param.name + "' is declared here"});
    }

    const RoutineSymbol& routine_;
    const sema::Module& module_;
    Reporter& reporter_;
    State known_; ///< by index of the parameter
    std::vector<bool> reported_;
    size_t leaves_ = 0;                   ///< instructions seen so far that continue elsewhere
    bool certain_ = true;                 ///< every call of the routine comes here
    bool hopeless_ = false;               ///< what Present said has been stored
    std::unordered_set<uint32_t> tested_; ///< groups of alternatives
    std::vector<Use> uses_;
};

} // namespace

void judgePresence(const RoutineSymbol& routine, Reporter& reporter) {
    if (!reporter.isOn(say::OptionalMayBeMissing.code)) return;
    const bool any = std::any_of(routine.params.begin(), routine.params.end(),
                                 [](const DataSymbol* p) { return p->optional && !p->isSwitch; });
    if (any) PresenceWalk(routine, reporter).run();
}

} // namespace rapid::lint

// Errors that a caller means to handle but never gets (manual 1.12).

#include "frontend/lint/error_routes.h"

#include "config/letter_case.h"
#include "frontend/diag/messages/warnings.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::lint {

using namespace syntax;
using sema::DataSymbol;
using sema::RoutineSymbol;

namespace {

constexpr size_t kLongestPath = 4;

const DataSymbol* named(const Expr& e, const sema::Module& module) {
    if (e.kind == NodeKind::Paren) return named(*as<ParenExpr>(e).inner, module);
    if (e.kind != NodeKind::Name) return nullptr;
    const sema::Symbol* symbol = (*module.exprs)[e.id].symbol;
    return symbol != nullptr && symbol->kind == sema::SymbolKind::Data
               ? static_cast<const DataSymbol*>(symbol)
               : nullptr;
}

bool isErrno(const Expr& e, const sema::Module& module) {
    const DataSymbol* data = named(e, module);
    return data != nullptr && data->meaning == sema::Meaning::ErrorNumber;
}

/// "ERR_A, ERR_B" as the declarations of natives have it.
void addNames(std::string_view text, std::vector<std::string>& names) {
    while (!text.empty()) {
        const size_t end = std::min(text.find_first_of(", "), text.size());
        if (end > 0) names.push_back(config::upperCase(text.substr(0, end)));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

bool has(const std::vector<std::string>& names, const std::string& name) {
    return std::find(names.begin(), names.end(), name) != names.end();
}

} // namespace

bool ErrorRoutes::Routine::canRaise(const Error& error) const {
    return (divides && error.languageError == sema::LanguageError::Divisor) ||
           has(fromNatives, config::upperCase(error.name));
}

ErrorRoutes::Error ErrorRoutes::errorOf(const Expr& number, const sema::Module& module) {
    Error error;
    error.where = module.tree->range(number);
    error.name = std::string(
        module.tree->source->text().substr(error.where.begin, error.where.end - error.where.begin));
    const DataSymbol* data = named(number, module);
    if (data != nullptr) error.meaning = data->meaning, error.languageError = data->languageError;
    const sema::ConstValue* value = (*module.exprs)[number.id].constant;
    if (value != nullptr && value->kind == sema::ConstValue::Kind::Number)
        error.number = value->number;
    else if (data != nullptr && data->routine == nullptr)
        error.variable = data;
    return error;
}

void ErrorRoutes::routine(const RoutineSymbol& symbol) {
    const sema::Module& module = *symbol.module;
    const RoutineDecl& decl = *symbol.routineDecl;
    Routine out;
    out.symbol = &symbol;
    out.hasHandler = !decl.errors.empty();
    for (const Stmt* s : decl.body)
        body(*s, module, out);
    bool lists = false;
    for (const ErrorClause* clause : decl.errors) {
        lists = lists || clause->hasList;
        for (const Expr* number : clause->numbers) {
            Error error = errorOf(*number, module);
            allListed_ = allListed_ || error.meaning == sema::Meaning::AllErrors;
            listed_.push_back(std::move(error));
        }
        out.takesAll = true;
        for (const Stmt* s : clause->body)
            handler(*s, module, out);
    }
    if (lists) out.takesAll = false, out.handled.clear();
    index_[&symbol] = routines_.size();
    routines_.push_back(std::move(out));
}

void ErrorRoutes::body(const Node& node, const sema::Module& module, Routine& out) const {
    if (node.kind == NodeKind::Raise) {
        if (const Expr* value = as<RaiseStmt>(node).value) {
            Error error = errorOf(*value, module);
            if (error.variable != nullptr || error.number != 0) out.raised.push_back(std::move(error));
        }
    } else if (node.kind == NodeKind::CallStmt || node.kind == NodeKind::Call) {
        const auto found = module.facts->calls.find(&node);
        const RoutineSymbol* callee = found == module.facts->calls.end() ? nullptr : found->second.routine;
        if (callee == nullptr)
            out.callsByName = true;
        else if (callee->predefined)
            addNames(callee->raisedErrors, out.fromNatives);
        else
            out.calls.push_back({callee, module.tree->range(node)});
    } else if (node.kind == NodeKind::Binary) {
        const BinaryOp op = as<BinaryExpr>(node).op;
        if (op == BinaryOp::Div || op == BinaryOp::IntDiv || op == BinaryOp::Mod)
            if ((*module.exprs)[as<BinaryExpr>(node).right->id].constant == nullptr) out.divides = true;
    }
    forEachChild(node, [&](const Node& child) { body(child, module, out); });
}

void ErrorRoutes::handler(const Node& node, const sema::Module& module, Routine& out) const {
    switch (node.kind) {
    case NodeKind::Raise: out.passesOn = true; break;
    case NodeKind::Binary: {
        const auto& e = as<BinaryExpr>(node);
        if (e.op != BinaryOp::Eq) break;
        if (isErrno(*e.left, module)) out.handled.push_back(errorOf(*e.right, module));
        if (isErrno(*e.right, module)) out.handled.push_back(errorOf(*e.left, module));
        break;
    }
    case NodeKind::Test: {
        const auto& test = as<TestStmt>(node);
        if (!isErrno(*test.subject, module)) break;
        for (const TestCase* row : test.cases)
            for (const Expr* value : row->values)
                out.handled.push_back(errorOf(*value, module));
        break;
    }
    case NodeKind::Name:
        if (isErrno(static_cast<const Expr&>(node), module)) out.takesAll = false;
        break;
    default: break;
    }
    forEachChild(node, [&](const Node& child) { handler(child, module, out); });
}

const ErrorRoutes::Routine* ErrorRoutes::find(const RoutineSymbol* symbol) const {
    const auto found = index_.find(symbol);
    return found == index_.end() ? nullptr : &routines_[found->second];
}

bool ErrorRoutes::isListed(const Error& error) const {
    return allListed_ || std::any_of(listed_.begin(), listed_.end(), [&](const Error& listed) {
               return listed.isSame(error) || (listed.variable == nullptr && listed.number == 0);
           });
}

/// The handler of the caller may be there for an error of its own instructions, or one that a handler passes on to it.
bool ErrorRoutes::hasOtherSource(const Routine& caller, const Error& error) const {
    if (caller.callsByName || caller.canRaise(error)) return true;
    return std::any_of(caller.calls.begin(), caller.calls.end(), [&](const Call& call) {
        const Routine* callee = find(call.callee);
        return callee == nullptr || callee->passesOn;
    });
}

/// Whether an error that `caller` plainly means to handle is lost in `routine` or in what that calls.
bool ErrorRoutes::find(const Routine& routine, const Routine& caller, Lost& lost) const {
    if (routine.hasHandler || lost.path.size() >= kLongestPath ||
        std::find(lost.path.begin(), lost.path.end(), &routine) != lost.path.end())
        return false;
    lost.path.push_back(&routine);
    for (const Error& error : routine.raised) {
        const bool meant = caller.takesAll || std::any_of(caller.handled.begin(), caller.handled.end(),
                                                          [&](const Error& e) { return e.isSame(error); });
        if (!meant || isListed(error)) continue;
        lost.raiser = &routine;
        lost.error = &error;
        return true;
    }
    for (const Error& wanted : caller.handled) {
        if (!routine.canRaise(wanted) || wanted.meaning == sema::Meaning::CommonError || isListed(wanted) ||
            hasOtherSource(caller, wanted))
            continue;
        lost.raiser = &routine;
        lost.error = &wanted;
        return true;
    }
    for (const Call& call : routine.calls)
        if (const Routine* callee = find(call.callee); callee != nullptr && find(*callee, caller, lost))
            return true;
    lost.path.pop_back();
    return false;
}

void ErrorRoutes::judge(Reporter& reporter) const {
    if (!reporter.isOn(say::ErrorNotPassedOn.code)) return;
    std::unordered_set<const Routine*> reported;
    for (const Routine& caller : routines_) {
        if (!caller.takesAll && caller.handled.empty()) continue;
        for (const Call& call : caller.calls) {
            const Routine* callee = find(call.callee);
            Lost lost;
            if (callee == nullptr || !find(*callee, caller, lost) || !reported.insert(lost.raiser).second)
                continue;
            std::string without;
            for (const Routine* routine : lost.path)
                without += fmt::format("{}'{}'", without.empty() ? "" : " and ", routine->symbol->name);
            reporter.report(say::ErrorNotPassedOn, *caller.symbol->module->tree, call.where,
                            {caller.symbol->name, lost.error->name, without});
        }
    }
}

} // namespace rapid::lint

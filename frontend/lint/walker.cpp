// Routines and instructions: what is reached, what has been assigned on the way.

#include "frontend/lint/walker.h"

#include "frontend/diag/messages/warnings.h"
#include "frontend/sema/names.h"
#include "frontend/sema/type_rules.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::lint {

using namespace syntax;
using sema::DataSymbol;
using sema::RoutineSymbol;
using sema::Storage;

namespace {

bool containsToken(const SyntaxTree& tree, const Node& node, TokenKind kind) {
    for (TokenIndex t = node.first; t != kNoToken && t <= node.last; ++t)
        if (tree.tokens[t].kind == kind) return true;
    return false;
}

/// Variables whose value is that of a zeroed memory until something is assigned.
bool isTracked(const DataSymbol& data) {
    return data.storage == Storage::RoutineData && data.dataKind == DataKind::Var && !data.init &&
           !data.type.type->containsNonValue && data.type.type->kind != sema::TypeKind::NonValue &&
           data.type.type->kind != sema::TypeKind::SemiValue && data.type.type->kind != sema::TypeKind::Error;
}

} // namespace

void Walker::routine(const RoutineSymbol& routine) {
    begin(routine);
    const RoutineDecl& decl = *routine.routineDecl;
    RoutineFacts& own = facts_.routines[&routine];
    own.firstCall = facts_.calls.size();
    list(decl.body);
    const Slots body = written_;
    own.conduct = static_cast<uint8_t>((ends_ > 0 ? kEnds : 0) | (errors_ > 0 ? kRaises : 0));
    handlers(decl, body);
    own.endCall = facts_.calls.size();
    if (waits_ > 0) own.conduct |= kWaits;
    finish();
}

void Walker::begin(const RoutineSymbol& routine) {
    routine_ = &routine;
    module_ = routine.module;
    tree_ = module_->tree;
    const size_t count = routine.params.size() + routine.data.size();
    access_.assign(count, 0);
    slots_.assign(count, -1);
    updates_.assign(routine.params.size(), nullptr);
    tracked_ = 0;
    for (const DataSymbol* data : routine.data)
        if (isTracked(*data) && tracked_ < kMaxTracked && data->index < count)
            slots_[data->index] = static_cast<int16_t>(tracked_++);
    handlerContinues_ = inHandler_ = false;
    for (const ErrorClause* clause : routine.routineDecl->errors)
        handlerContinues_ |= containsToken(*tree_, *clause, TokenKind::KwTrynext);
    assigned_.reset();
    written_.reset();
    pending_.clear();
    fractions_.clear();
    numbers_.clear();
    writes_.clear();
    labels_.clear();
    targets_.clear();
    labelIndex_.clear();
    waits_ = jumps_ = ends_ = errors_ = 0;
    breakSeen_ = false;
    loopDepth_ = branchDepth_ = 0;
    flyBy_ = nullptr;
    list_ = nullptr;
}

// An error can happen anywhere in the body, and RETRY and TRYNEXT go back there: what one of them assigns may be
// assigned in the other.
void Walker::handlers(const RoutineDecl& decl, const Slots& body) {
    const auto startWith = [&](const Slots& state) {
        assigned_ = state;
        written_.reset();
        flyBy_ = nullptr;
    };
    if (!decl.backward.empty()) {
        startWith(Slots().set());
        list(decl.backward);
    }
    Slots assignedInHandlers;
    for (const ErrorClause* clause : decl.errors) {
        startWith(body);
        errorClause(*clause);
        assignedInHandlers |= written_;
    }
    if (!decl.undo.empty()) {
        startWith(body | assignedInHandlers);
        list(decl.undo);
    }
    std::erase_if(pending_, [&](const Pending& p) {
        const int16_t slot = slots_[p.data->index];
        return slot >= 0 && assignedInHandlers[static_cast<size_t>(slot)];
    });
}

void Walker::errorClause(const ErrorClause& clause) {
    for (const Expr* number : clause.numbers)
        expr(*number);
    const unsigned left = jumps_ + ends_;
    const size_t calls = facts_.calls.size();
    inHandler_ = true;
    handlerResumes_ = containsToken(*tree_, clause, TokenKind::KwRetry) ||
                      containsToken(*tree_, clause, TokenKind::KwTrynext);
    const bool continues = list(clause.body);
    inHandler_ = handlerResumes_ = false;
    if (!continues || jumps_ + ends_ != left || facts_.callsByName || !routine_->routineDecl->closed ||
        !reporter_.isOn(say::UnhandledError.code))
        return;
    facts_.suspicions.push_back({say::UnhandledError.code, tree_, tree_->range(clause.first), routine_->name,
                                 calls, facts_.calls.size(), kEnds});
}

/// `list := empty;` with an array or record that nothing ever assigns: it is there to clear others.
bool Walker::isEmptyValue(const DataSymbol& data) const {
    const bool aggregate = data.type.rank > 0 || data.type.type->kind == sema::TypeKind::Record;
    return aggregate && (access_[data.index] & (kAssigned | kFromCall)) == 0;
}

void Walker::finish() {
    for (const Pending& p : pending_)
        if (!p.copied || !isEmptyValue(*p.data)) usedTooEarly(*p.data, *p.place);
    judgeFractions();
    for (const Label& label : labels_)
        if (targets_.count(label.node) == 0) unusedLabel(as<LabelStmt>(*label.node));
    for (const DataSymbol* param : routine_->params)
        if ((access_[param->index] & kUpdated) != 0)
            report(say::ParameterAssigned, range(*updates_[param->index]), {param->name});
    for (const DataSymbol* data : routine_->data) {
        if (data->init) byteValue(data->type, *data->init);
        if (data->storage != Storage::RoutineData || data->index >= access_.size()) continue;
        if (access_[data->index] == kAssigned)
            report(say::UnreadVariable, tree_->range(data->nameToken), {data->name});
    }
}

/// Whether a procedure without parameters, which the routine can call, has this name.
bool Walker::isProcedure(std::string_view name) const {
    const std::string folded = sema::foldName(name);
    for (const sema::Module* module : task_.modules)
        for (const RoutineSymbol* routine : module->routines)
            if (routine->routineKind == RoutineKind::Proc && routine->params.empty() &&
                sema::foldName(routine->name) == folded &&
                (module == module_ || !routine->routineDecl->local))
                return true;
    return false;
}

void Walker::unusedLabel(const LabelStmt& label) {
    const std::string name(tree_->text(label.name));
    const bool meansCall = isProcedure(name);
    diag::Diagnostic* d =
        report(say::UnusedLabel, tree_->range(label.name),
               {name, meansCall ? fmt::format("; to call the procedure '{}', write ';' in place of ':'", name)
                                : ""});
    if (!d || meansCall) return;
    // With its line, if there is nothing else on it.
    const SourceFile& file = *tree_->source;
    SourceRange where = range(label);
    const uint32_t line = file.lineColumn(where.begin).line;
    const std::string_view text = file.lineText(line);
    const size_t used = text.find_last_not_of(" \t") + 1, first = text.find_first_not_of(" \t");
    const bool alone =
        file.lineStart(line) + first == where.begin && file.lineStart(line) + used == where.end;
    if (alone && line < file.lineCount()) where = {file.lineStart(line), file.lineStart(line + 1)};
    d->fix(where, "");
}

bool Walker::list(StmtList stmts) {
    const void* outer = std::exchange(list_, stmts.data());
    bool reachable = true;
    bool reported = false;
    for (size_t i = 0; i < stmts.size(); ++i) {
        const Stmt& s = *stmts[i];
        if (s.kind == NodeKind::Label) {
            reachable = true;
        } else if (!reachable && !reported && s.kind != NodeKind::Empty) {
            reported = true;
            unreachable(stmts, i);
        }
        const bool continues = statement(s);
        reachable = reachable && continues;
    }
    flyBy_ = nullptr;
    list_ = outer;
    return reachable;
}

void Walker::unreachable(StmtList stmts, size_t at) {
    assigned_.set(); // nothing is said of variables here
    // A closing RETURN is a habit, and functions seem to need one.
    if (at + 1 == stmts.size() && stmts[at]->kind == NodeKind::Return) return;
    const NodeKind kind = stmts[at]->kind;
    if (kind == NodeKind::ErrorStmt || kind == NodeKind::DeclStmt || kind == NodeKind::PlaceholderStmt)
        return;
    report(say::UnreachableCode, range(*stmts[at]));
}

bool Walker::statement(const Stmt& s) {
    switch (s.kind) {
    case NodeKind::Assign: assign(as<AssignStmt>(s)); return true;
    case NodeKind::CallStmt: {
        const auto& callStmt = as<CallStmt>(s);
        if (!callStmt.lateName) return call(s, callStmt.args);
        lateCall(callStmt);
        return true;
    }
    default: break;
    }
    flyBy_ = nullptr;
    switch (s.kind) {
    case NodeKind::If: return ifStmt(as<IfStmt>(s));
    case NodeKind::CompactIf: {
        const auto& compact = as<CompactIfStmt>(s);
        if (compact.condition) expr(*compact.condition);
        judgeJumpBack(compact);
        const Slots before = assigned_;
        Stmt* body = compact.body;
        const bool continues = !body || branch(StmtList(&body, 1));
        assigned_ = continues ? assigned_ | before : before;
        return true;
    }
    case NodeKind::For: forStmt(as<ForStmt>(s)); return true;
    case NodeKind::While: return whileStmt(as<WhileStmt>(s));
    case NodeKind::Test: return testStmt(as<TestStmt>(s));
    case NodeKind::Label: labelStmt(as<LabelStmt>(s)); return true;
    case NodeKind::Goto: gotoStmt(as<GotoStmt>(s)); return false;
    case NodeKind::Connect: connect(as<ConnectStmt>(s)); return true;
    case NodeKind::Return:
        if (const Expr* value = as<ReturnStmt>(s).value) {
            expr(*value);
            byteValue(routine_->returnType, *value);
        }
        ++jumps_;
        return false;
    case NodeKind::Raise:
        if (const Expr* value = as<RaiseStmt>(s).value) expr(*value);
        return raises();
    case NodeKind::Retry:
    case NodeKind::TryNext:
    case NodeKind::Exit: ++ends_; return false;
    case NodeKind::Break:
    case NodeKind::Continue:
        if (find(s)) return call(s, {}); // a procedure of that name in old files
        breakSeen_ |= s.kind == NodeKind::Break;
        return false;
    default: return true;
    }
}

// TRYNEXT in the handler of the routine continues after the RAISE.
bool Walker::raises() {
    ++ends_;
    return handlerContinues_ && !inHandler_;
}

void Walker::assign(const AssignStmt& s) {
    if (!s.target || !s.value) return;
    const DataSymbol* root = rootOf(*s.target);
    const bool own = root && isOwn(*root);
    const uint8_t before = own ? access_[root->index] : uint8_t{0};
    if (own) access_[root->index] &= static_cast<uint8_t>(~kRead);
    copied_ = s.value->kind == NodeKind::Name ? s.value : nullptr;
    expr(*s.value);
    copied_ = nullptr;
    if (root) setFrom(*root, *s.value);
    byteValue(info(*s.target).type(), *s.value);
    const bool fromItself = own && (access_[root->index] & kRead) != 0;
    if (own) access_[root->index] |= before & kRead;
    subscripts(*s.target);
    const bool fromCall = s.value->kind == NodeKind::Call;
    const bool place = s.value->kind == NodeKind::Name || s.value->kind == NodeKind::Index ||
                       s.value->kind == NodeKind::Component;
    if (place && sameText(*s.target, *s.value))
        report(say::SelfAssignment, range(s), {text(*s.target)}); // and no assignment at all
    else
        write(*s.target, fromCall ? kFromCall : kAssigned, fromItself);
}

/// Statements that a condition may leave out.
bool Walker::branch(StmtList body) {
    ++branchDepth_;
    const bool continues = list(body);
    --branchDepth_;
    return continues;
}

bool Walker::ifStmt(const IfStmt& s) {
    Slots merged;
    Slots otherwise; // the way on which no condition so far was TRUE
    bool completes = !s.hasElse;
    for (const IfBranch* part : s.branches) {
        if (part->condition) expr(*part->condition);
        otherwise = assigned_;
        if (branch(part->body)) {
            merged |= assigned_;
            completes = true;
        }
        assigned_ = otherwise;
    }
    if (s.hasElse && branch(s.elseBody)) {
        merged |= assigned_;
        completes = true;
    }
    assigned_ = s.hasElse ? merged : merged | otherwise;
    if (s.branches.size() > 1) duplicateConditions(s);
    return completes;
}

void Walker::duplicateConditions(const IfStmt& s) {
    constexpr size_t kMost = 64; // branches compared with each other
    const size_t count = std::min(s.branches.size(), kMost);
    for (size_t i = 1; i < count; ++i) {
        const Expr* condition = s.branches[i]->condition;
        if (!condition || constant(*condition)) continue;
        for (size_t k = 0; k < i; ++k) {
            if (!s.branches[k]->condition || !sameText(*s.branches[k]->condition, *condition)) continue;
            if (diag::Diagnostic* d = report(say::DuplicateCondition, range(*condition)))
                d->notes.push_back({tree_->source, range(*s.branches[k]->condition), "it is here first"});
            break;
        }
    }
}

bool Walker::testStmt(const TestStmt& s) {
    if (s.subject) expr(*s.subject);
    for (const TestCase* c : s.cases)
        for (const Expr* value : c->values) {
            expr(*value);
            if (s.subject) judgeCase(*s.subject, *value);
        }
    const Slots before = assigned_;
    Slots merged;
    bool completes = !s.hasDefault;
    const auto way = [&](StmtList body) {
        assigned_ = before;
        if (!branch(body)) return;
        merged |= assigned_;
        completes = true;
    };
    for (const TestCase* c : s.cases)
        way(c->body);
    if (s.hasDefault) way(s.defaultBody);
    assigned_ = s.hasDefault ? merged : merged | before;
    if (!s.hasDefault) missingDefault(s);
    return completes;
}

// Only for values from outside the program text, whose list of values is never known to be complete.
void Walker::missingDefault(const TestStmt& s) {
    constexpr size_t kFewest = 2; // one CASE alone is an IF
    if (s.cases.size() < kFewest || !s.subject || !isOpenSubject(*s.subject)) return;
    if (info(*s.subject).type().type->kind == sema::TypeKind::Bool) return;
    report(say::MissingDefault, {range(s).begin, range(*s.subject).end}, {text(*s.subject)});
}

bool Walker::isOpenSubject(const Expr& subject) const {
    if (subject.kind == NodeKind::Paren) return isOpenSubject(*as<ParenExpr>(subject).inner);
    if (subject.kind == NodeKind::Call) return true;
    const DataSymbol* root = subject.kind == NodeKind::Name ? rootOf(subject) : nullptr;
    if (!root) return false;
    if (root->type.type->kind == sema::TypeKind::SemiValue) return !isDigital(*root->type.type);
    return root->storage == Storage::SystemVariable ||
           (root->storage == Storage::Parameter && root->mode == ParamMode::In);
}

std::string Walker::text(const Node& node) const {
    constexpr uint32_t kLongest = 40;
    const SourceRange r = range(node);
    const std::string_view all = tree_->source->text();
    uint32_t end = std::min(r.end, r.begin + kLongest);
    while (end < r.end && end > r.begin && (static_cast<unsigned char>(all[end]) & 0xC0) == 0x80)
        --end; // not inside a character
    std::string out(all.substr(r.begin, end - r.begin));
    std::replace_if(out.begin(), out.end(), [](char c) { return c == '\n' || c == '\r' || c == '\t'; }, ' ');
    return end < r.end ? out + "..." : out;
}

} // namespace rapid::lint

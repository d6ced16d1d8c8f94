#include "tests/fuzz/tree_mutator.h"

#include "frontend/syntax/tree_walk.h"

#include <algorithm>

namespace rapid::fuzz {

using namespace syntax;

namespace {

using sema::TypeKind;

bool same(const sema::DataType& a, const sema::DataType& b) {
    return a.type->base() == b.type->base() && a.rank == b.rank && std::equal(a.dims, a.dims + 3, b.dims);
}

bool isScalar(const sema::DataType& type, TypeKind kind) {
    return type.rank == 0 && type.type->base()->kind == kind;
}

bool isNumber(const sema::DataType& type) {
    return isScalar(type, TypeKind::Num) || isScalar(type, TypeKind::Dnum);
}

/// Can be written beside an operator as it is.
bool isPrimary(NodeKind kind) {
    return kind != NodeKind::Binary && kind != NodeKind::Unary;
}

bool isLiteral(NodeKind kind) {
    return kind == NodeKind::NumLiteral || kind == NodeKind::StringLiteral || kind == NodeKind::BoolLiteral;
}

/// As writable as the other: of one declaration word and no parameter beside data.
bool isAlike(const sema::DataSymbol& a, const sema::DataSymbol& b) {
    const auto isParameter = [](const sema::DataSymbol& data) {
        return data.storage == sema::Storage::Parameter;
    };
    if (isParameter(a) || isParameter(b)) return isParameter(a) && isParameter(b) && a.mode == b.mode;
    return a.dataKind == b.dataKind && a.storage == b.storage && a.predefined == b.predefined;
}

/// Values at the boundaries of num (24 bits, binary32), of bytes and of arrays.
constexpr const char* kNumbers[] = {
    "0",        "1",          "2",          "3",          "(-1)", "0.5",   "(-0.5)",    "3.7",
    "80",       "255",        "256",        "65536",      "1E10", "1E38",  "(-3.4E38)", "8388607",
    "16777215", "16777216",   "16777217",   "2147483647", "1E-6", "1E-45", "32",        "33",
    "(-32768)", "4294967296", "(-8388609)", "1E-38",      "100",  "0.1",   "1.5",       "2.5"};
constexpr const char* kDoubles[] = {"0",   "1",     "(-1)",     "4503599627370496",     "9007199254740993",
                                    "0.1", "1E308", "(-1E308)", "18446744073709551616", "4.9E-324"};
constexpr const char* kTexts[] = {
    "\"\"",          "\"a\"",
    "\"0\"",         "\"-1E38\"",
    "\"TRUE\"",      "\"[1,2,3]\"",
    "\"\\\\ \\00\"", "\"01234567890123456789012345678901234567890123456789012345678901234567890123456789\""};
constexpr const char* kArithmetic[] = {"+", "-", "*", "/", " DIV ", " MOD "};
constexpr const char* kComparisons[] = {"<", "<=", ">", ">=", "=", "<>"};
constexpr const char* kLogic[] = {" AND ", " OR ", " XOR ", "=", "<>"};

} // namespace

std::string TreeMutator::textOf(const Node& node, const Scope& scope) {
    const SourceRange range = tree(scope).range(node);
    return std::string(tree(scope).source->text().substr(range.begin, range.end - range.begin));
}

Edit TreeMutator::replaced(const Node& node, const Scope& scope, std::string text) {
    const SourceRange range = tree(scope).range(node);
    return {scope.task, range.begin, range.end, std::move(text)};
}

Edit TreeMutator::inserted(uint32_t at, const Scope& scope, std::string text) {
    return {scope.task, at, at, std::move(text)};
}

std::optional<Edit> TreeMutator::change() {
    static constexpr std::optional<Edit> (TreeMutator::* kChanges[])() = {
        &TreeMutator::replaceValue,    &TreeMutator::replaceValue,     &TreeMutator::combineValue,
        &TreeMutator::combineValue,    &TreeMutator::exchangeOperator, &TreeMutator::changeLiteral,
        &TreeMutator::changeLiteral,   &TreeMutator::swapName,         &TreeMutator::moveStatement,
        &TreeMutator::moveStatement,   &TreeMutator::wrapStatement,    &TreeMutator::wrapStatement,
        &TreeMutator::insertStatement, &TreeMutator::insertStatement,  &TreeMutator::addHandler};
    return (this->*kChanges[below(random_, std::size(kChanges))])();
}

bool TreeMutator::isVisible(const Node& node, const Scope& from, const Scope& scope, uint32_t at) const {
    if (from.task != scope.task) return false;
    if (node.kind == NodeKind::Name) {
        const sema::Symbol* symbol = program_.info(*from.module, as<Expr>(node)).symbol;
        if (!symbol || symbol->kind != sema::SymbolKind::Data) return from.routine == scope.routine;
        const auto& data = static_cast<const sema::DataSymbol&>(*symbol);
        if (data.routine && data.routine != scope.routine) return false;
        if (data.isLocal && data.module != scope.module) return false;
        if (data.storage != sema::Storage::LoopVariable || !data.decl) return true;
        const SourceRange loop = tree(scope).range(*data.decl);
        return loop.begin < at && at < loop.end;
    }
    bool visible = true;
    forEachChild(node, [&](const Node& child) { visible = visible && isVisible(child, from, scope, at); });
    return visible;
}

std::vector<const sema::DataSymbol*> TreeMutator::dataOf(const sema::DataType& type, const Scope& scope,
                                                         const sema::DataSymbol* like) const {
    std::vector<const sema::DataSymbol*> found;
    const auto add = [&](const std::vector<sema::DataSymbol*>& all) {
        for (const sema::DataSymbol* data : all)
            if (same(data->type, type) && !data->isSwitch && data->storage != sema::Storage::LoopVariable &&
                (!like || isAlike(*data, *like)))
                found.push_back(data);
    };
    add(scope.module->data);
    if (scope.routine) {
        add(scope.routine->params);
        add(scope.routine->data);
    }
    return found;
}

std::string TreeMutator::literal(const sema::Type& type) {
    switch (type.base()->kind) {
    case TypeKind::Num: return kNumbers[below(random_, std::size(kNumbers))];
    case TypeKind::Dnum: return kDoubles[below(random_, std::size(kDoubles))];
    case TypeKind::Bool: return chance(50) ? "TRUE" : "FALSE";
    case TypeKind::String: return kTexts[below(random_, std::size(kTexts))];
    default: return {};
    }
}

std::string TreeMutator::value(const sema::DataType& type, const Scope& scope, uint32_t at, Role role) {
    constexpr uint32_t kLongest = 200; // bytes
    if (type.rank == 0 && chance(25)) {
        std::string text = literal(*type.type);
        if (!text.empty()) return text;
    }
    if (role == Role::Value && chance(45)) {
        const auto data = dataOf(type, scope, nullptr);
        if (const auto* one = oneOf(data)) return (*one)->name;
    }
    std::vector<const Site*> donors;
    for (const Site& site : sites_) {
        const bool fits = role == Role::Constant ? site.role == Role::Constant : site.role != Role::Fixed;
        if (!fits || !same(site.type, type) || !isVisible(*site.expr, site.scope, scope, at)) continue;
        const SourceRange range = tree(scope).range(*site.expr);
        if (range.end - range.begin <= kLongest) donors.push_back(&site);
    }
    const Site* const* donor = oneOf(donors);
    if (!donor) return type.rank == 0 ? literal(*type.type) : std::string();
    std::string text = textOf(*(*donor)->expr, (*donor)->scope);
    return isPrimary((*donor)->expr->kind) ? text : "(" + text + ")";
}

std::string TreeMutator::condition(const Scope& scope, uint32_t at) {
    if (chance(40)) return value({program_.boolean}, scope, at);
    return value({program_.num}, scope, at) + kComparisons[below(random_, std::size(kComparisons))] +
           value({program_.num}, scope, at);
}

// ---- Expressions ---------------------------------------------------------------------------------------------------

std::optional<Edit> TreeMutator::replaceValue() {
    const Site* site = oneOf(sites_);
    if (!site || site->role == Role::Fixed || site->role == Role::Reference) return {};
    std::string text = value(site->type, site->scope, tree(site->scope).range(*site->expr).begin, site->role);
    if (text.empty()) return {};
    return replaced(*site->expr, site->scope, std::move(text));
}

std::optional<Edit> TreeMutator::combineValue() {
    const Site* site = oneOf(sites_);
    if (!site || site->role == Role::Fixed || site->role == Role::Reference) return {};
    const uint32_t at = tree(site->scope).range(*site->expr).begin;
    const std::string old = "(" + textOf(*site->expr, site->scope) + ")";
    const std::string other = value(site->type, site->scope, at, site->role);
    std::string text;
    if (other.empty()) return {};
    if (isNumber(site->type))
        text = chance(20) ? "-" + old : old + kArithmetic[below(random_, std::size(kArithmetic))] + other;
    else if (isScalar(site->type, TypeKind::Bool))
        text = chance(20) ? "NOT " + old : old + kLogic[below(random_, std::size(kLogic))] + other;
    else if (isScalar(site->type, TypeKind::String))
        text = old + "+" + other;
    else
        return {};
    return replaced(*site->expr, site->scope, "(" + text + ")");
}

std::optional<Edit> TreeMutator::exchangeOperator() {
    std::vector<const Site*> found;
    for (const Site& site : sites_)
        if (site.expr->kind == NodeKind::Binary) found.push_back(&site);
    const Site* const* site = oneOf(found);
    if (!site) return {};
    const auto& binary = as<BinaryExpr>(*(*site)->expr);
    const Scope& scope = (*site)->scope;
    const sema::DataType& left = program_.info(*scope.module, *binary.left).type();
    const SourceRange range = tree(scope).range(binary.opToken);
    std::string other;
    if (isNumber((*site)->type))
        other = kArithmetic[below(random_, std::size(kArithmetic))];
    else if (isNumber(left))
        other = kComparisons[below(random_, std::size(kComparisons))];
    else if (isScalar(left, TypeKind::Bool))
        other = kLogic[below(random_, std::size(kLogic))];
    else
        return {};
    return Edit{scope.task, range.begin, range.end, other};
}

std::optional<Edit> TreeMutator::changeLiteral() {
    std::vector<const Site*> found;
    for (const Site& site : sites_)
        if (isLiteral(site.expr->kind)) found.push_back(&site);
    const Site* const* site = oneOf(found);
    if (!site) return {};
    std::string text = literal(*(*site)->type.type);
    if (text.starts_with("(") &&
        (*site)->role == Role::Constant) // not within an initial value of a persistent
        text = text.substr(1, text.size() - 2);
    return replaced(*(*site)->expr, (*site)->scope, text);
}

std::optional<Edit> TreeMutator::swapName() {
    std::vector<const Site*> found;
    for (const Site& site : sites_)
        if (site.expr->kind == NodeKind::Name) found.push_back(&site);
    const Site* const* site = oneOf(found);
    if (!site) return {};
    const sema::Symbol* symbol = program_.info(*(*site)->scope.module, *(*site)->expr).symbol;
    if (!symbol || symbol->kind != sema::SymbolKind::Data) return {};
    const auto& data = static_cast<const sema::DataSymbol&>(*symbol);
    const bool any = (*site)->role == Role::Value;
    const auto fitting = dataOf(data.type, (*site)->scope, any ? nullptr : &data);
    const auto* other = oneOf(fitting);
    if (!other) return {};
    return replaced(*(*site)->expr, (*site)->scope, (*other)->name);
}

// ---- Statements ----------------------------------------------------------------------------------------------------

std::optional<Edit> TreeMutator::moveStatement() {
    const StatementSite* site = oneOf(statements_);
    if (!site) return {};
    const std::string text = textOf(*site->statement, site->scope);
    const SourceRange range = tree(site->scope).range(*site->statement);
    switch (below(random_, 4)) {
    case 0: return replaced(*site->statement, site->scope, {});
    case 1: return inserted(range.end, site->scope, "\n" + text);
    case 2:
        if (!site->next) return {};
        return Edit{site->scope.task, range.begin, tree(site->scope).range(*site->next).end,
                    textOf(*site->next, site->scope) + "\n" + text};
    default: {
        const StatementSite* donor = oneOf(statements_);
        if (!isVisible(*donor->statement, donor->scope, site->scope, range.begin)) return {};
        return inserted(range.begin, site->scope, textOf(*donor->statement, donor->scope) + "\n");
    }
    }
}

std::optional<Edit> TreeMutator::wrapStatement() {
    const StatementSite* site = oneOf(statements_);
    if (!site) return {};
    const Scope& scope = site->scope;
    const uint32_t at = tree(scope).range(*site->statement).begin;
    const std::string text = textOf(*site->statement, scope);
    const sema::DataType num{program_.num};
    const std::string variable = "f" + std::to_string(below(random_, 1000));
    std::string whole;
    switch (below(random_, 6)) {
    case 0: whole = "IF " + condition(scope, at) + " THEN\n" + text + "\nENDIF"; break;
    case 1:
        whole = "IF " + condition(scope, at) + " THEN\n" + madeStatement(scope, at) + "\nELSEIF " +
                condition(scope, at) + " THEN\n" + text + "\nELSE\n" + madeStatement(scope, at) + "\nENDIF";
        break;
    case 2:
        whole = "FOR " + variable + " FROM " + value(num, scope, at) + " TO " + value(num, scope, at) +
                (chance(30) ? " STEP " + value(num, scope, at) : "") + " DO\n" + text + "\n" +
                madeStatement(scope, at) + "\nENDFOR";
        break;
    case 3: whole = "FOR " + variable + " FROM 1 TO 3 DO\n" + text + "\nENDFOR"; break;
    case 4:
        whole =
            "WHILE " + condition(scope, at) + " DO\n" + text + "\n" + madeStatement(scope, at) + "\nENDWHILE";
        break;
    default:
        whole = "TEST " + value(num, scope, at) + "\nCASE " + value(num, scope, at) + ", " +
                value(num, scope, at) + ":\n" + text + "\nDEFAULT:\n" + madeStatement(scope, at) +
                "\nENDTEST";
    }
    return replaced(*site->statement, scope, whole);
}

std::string TreeMutator::madeStatement(const Scope& scope, uint32_t at) {
    const Site* site = oneOf(sites_);
    switch (below(random_, 8)) {
    case 0: return "TPWrite \"reached\";";
    case 1: return "IF " + condition(scope, at) + " RAISE " + value({program_.num}, scope, at) + ";";
    case 2: return "IF " + condition(scope, at) + " RETURN;";
    case 3: {
        if (!site || site->type.type->containsNonValue || site->type.type->kind == TypeKind::SemiValue) break;
        const std::string text = value(site->type, scope, at);
        if (!text.empty()) return "TPWrite ValToStr(" + text + ");";
        break;
    }
    case 4: {
        if (scope.module->routines.empty()) break;
        const sema::RoutineSymbol& called = **oneOf(scope.module->routines);
        const bool simple = called.routineKind == RoutineKind::Proc && called.params.empty();
        if (simple && &called != scope.routine) return called.name + ";";
        break;
    }
    default: { // an assignment
        if (!site || site->role != Role::Reference || !isVisible(*site->expr, site->scope, scope, at)) break;
        const std::string text = value(site->type, scope, at);
        if (!text.empty()) return textOf(*site->expr, site->scope) + ":=" + text + ";";
    }
    }
    return "TPWrite ValToStr(" + condition(scope, at) + ");";
}

std::optional<Edit> TreeMutator::insertStatement() {
    const StatementSite* site = oneOf(statements_);
    if (!site) return {};
    const uint32_t at = tree(site->scope).range(*site->statement).begin;
    return inserted(at, site->scope, madeStatement(site->scope, at) + "\n");
}

std::string TreeMutator::handlerBody(const Scope& scope, uint32_t at) {
    std::string text = chance(60) ? "TPWrite \"error \" \\Num:=ERRNO;\n" : std::string();
    for (size_t n = below(random_, 3); n > 0; --n)
        text += madeStatement(scope, at) + "\n";
    static const char* const kEnds[] = {"RETRY;", "TRYNEXT;", "TRYNEXT;", "RAISE;", "RETURN;", "EXIT;", ""};
    return text + kEnds[below(random_, std::size(kEnds))] + "\n";
}

std::optional<Edit> TreeMutator::addHandler() {
    const Scope* scope = oneOf(routines_);
    if (!scope) return {};
    const RoutineDecl& routine = *scope->routine->routineDecl;
    const uint32_t end = tree(*scope).range(routine.last).begin;
    if (routine.errors.empty()) return inserted(end, *scope, "ERROR\n" + handlerBody(*scope, end));
    const ErrorClause& clause = *routine.errors[below(random_, routine.errors.size())];
    if (clause.body.empty()) return {};
    if (!routine.hasUndo && chance(30) && routine.errors.back()->last + 1 == routine.last)
        return inserted(end, *scope, "UNDO\n" + madeStatement(*scope, end) + "\n");
    return replaced(*clause.body.back(), *scope, handlerBody(*scope, end));
}

} // namespace rapid::fuzz

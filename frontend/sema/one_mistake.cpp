// Walks through the uses of all data and functions of a file that has errors, and finds the declarations that none of
// their uses fits. A single use that fits the declaration, or two that need different types, or only few uses, and
// nothing is merged: then the uses are wrong, each for itself.

#include "frontend/sema/one_mistake.h"

#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <map>
#include <tuple>
#include <unordered_map>

namespace rapid::sema {

using namespace syntax;
using diag::Code;
using diag::Diagnostic;

namespace {

/// So many uses are hardly wrong each for itself. Fewer are reported one by one: a programmer who takes a bool for a number
/// twice has declared it well.
constexpr size_t kEnoughUses = 5;
constexpr size_t kEnoughOfOneKind = 3;

using Said = std::vector<const Diagnostic*>;

/// What the place of a use says about its type.
struct Claim {
    Said said;              ///< what is wrong there; empty: it fits
    DataType needed;        ///< null type: see `shape`
    const char* shape = ""; ///< "an array"
    bool nothing = false;   ///< any type would do there
};

/// All uses of a thing that is declared with a type.
struct Uses {
    Said said;
    DataType needed;
    const char* shape = "";
    bool contradicted = true; ///< no use fits, and all need the same
    bool number = false;      ///< a number of open type fits it
};

/// A number whose type the context decides.
bool isOpenNumber(const Expr& e) {
    const Expr* inner = &bare(e);
    while (inner->kind == NodeKind::Unary)
        inner = &bare(*as<UnaryExpr>(*inner).operand);
    return inner->kind == NodeKind::NumLiteral;
}

bool sameType(const DataType& a, const DataType& b) {
    return a.type->base() == b.type->base() && a.rank == b.rank;
}

/// What the uses of a wrong declaration cause.
bool isOfUse(Code code) {
    constexpr Code kAll[] = {
        Code::ComponentOfNonRecord, Code::UnaryOperatorType, Code::IndexNotArray,      Code::IndexType,
        Code::OperatorTypes,        Code::NumDnumMixed,      Code::CompareTypes,       Code::ArgumentType,
        Code::ArgumentNotVariable,  Code::InitialValueType,  Code::AggregateForAtomic, Code::AggregateMember,
        Code::ForBoundType,         Code::ConditionNotBool,  Code::AssignConstant,     Code::AssignType,
        Code::NumDnumAssign,        Code::TestValueType,     Code::ReturnType};
    return std::find(std::begin(kAll), std::end(kAll), code) != std::end(kAll);
}

class UseWalk {
  public:
    UseWalk(const CheckedProgram& program, const Said& said) : program_(program) {
        for (const Diagnostic* d : said)
            if (isOfUse(d->code)) said_.emplace(std::tuple(d->range.begin, d->range.end, d->code), d);
    }

    /// Whether there is anything to merge.
    bool isWorthIt() const { return said_.size() > 1; }

    void walk(const Module& module) {
        module_ = &module;
        for (const DataSymbol* data : module.data)
            initial(*data);
        for (const RoutineSymbol* routine : module.routines) {
            routine_ = routine;
            for (const DataSymbol* data : routine->data)
                if (data->storage == Storage::RoutineData) initial(*data);
            const RoutineDecl& decl = *routine->routineDecl;
            list(decl.body);
            list(decl.backward);
            for (const ErrorClause* clause : decl.errors)
                visit(*clause);
            list(decl.undo);
        }
        routine_ = nullptr;
    }

    std::vector<Repeat> repeats() const {
        std::vector<Repeat> out;
        for (const auto& [symbol, uses] : uses_)
            if (isWrong(uses)) addDeclared(out, *symbol, uses);
        for (const auto& [key, said] : kinds_)
            if (said.size() >= kEnoughOfOneKind)
                out.push_back({members(said), {}, guardOf(*std::get<0>(key))});
        return out;
    }

  private:
    // ---- what was said

    const Diagnostic* find(SourceRange where, Code code) const {
        const auto found = said_.find(std::tuple(where.begin, where.end, code));
        return found == said_.end() ? nullptr : found->second;
    }
    SourceRange range(const Node& node) const { return module_->tree->range(node); }
    SourceRange range(TokenIndex token) const { return module_->tree->range(token); }
    const ExprInfo& info(const Expr& e) const { return program_.info(*module_, e); }
    bool isUnknown(const DataType& type) const { return !type.type || type.type->kind == TypeKind::Error; }

    /// The claim of a place where `needed` stands beside it: `code` at `where` tells that they do not fit.
    Claim claim(SourceRange where, std::initializer_list<Code> codes, const DataType& needed) const {
        Claim out;
        for (const Code code : codes)
            if (const Diagnostic* d = find(where, code)) out.said.push_back(d);
        out.needed = needed;
        out.nothing = isUnknown(needed);
        return out;
    }
    Claim claim(const Expr& e, std::initializer_list<Code> codes, const Type* needed) const {
        return claim(range(e), codes, {needed, 0, {}});
    }
    static Claim anything() {
        Claim out;
        out.nothing = true;
        return out;
    }

    // ---- uses

    void use(const Symbol* symbol, const DataType& declared, Claim given, const Expr* other = nullptr) {
        if (!symbol || symbol->predefined || !symbol->decl || symbol->module != module_ || given.nothing)
            return;
        Uses& uses = uses_[symbol];
        if (given.said.empty()) {
            const bool open = other && isOpenNumber(*other) && declared.type->isNumeric();
            (open ? uses.number : uses.contradicted) = open;
            return;
        }
        uses.said.insert(uses.said.end(), given.said.begin(), given.said.end());
        if (*given.shape) {
            uses.shape = given.shape;
        } else if (!uses.needed.type) {
            uses.needed = given.needed;
        } else if (given.needed.type && !sameType(uses.needed, given.needed)) {
            uses.contradicted = false;
        }
    }

    /// `other`: what stands against it, when that is an expression.
    void expression(const Expr* e, Claim given = {}, const Expr* other = nullptr) {
        if (!e) return;
        switch (e->kind) {
        case NodeKind::Name: {
            const Symbol* symbol = info(*e).symbol;
            if (symbol && symbol->kind == SymbolKind::Data)
                use(symbol, static_cast<const DataSymbol*>(symbol)->type, std::move(given), other);
            break;
        }
        case NodeKind::Paren: expression(as<ParenExpr>(*e).inner, std::move(given), other); break;
        case NodeKind::Index: element(as<IndexExpr>(*e), std::move(given), other); break;
        case NodeKind::Component: {
            const auto& part = as<ComponentExpr>(*e);
            Claim whole;
            if (const Diagnostic* d =
                    part.name == kNoToken ? nullptr : find(range(part.name), Code::ComponentOfNonRecord)) {
                whole.said = {d};
                whole.shape = "a record";
            }
            expression(part.base, std::move(whole));
            break;
        }
        case NodeKind::Unary: {
            const auto& unary = as<UnaryExpr>(*e);
            const SourceRange sign = range(unary.first);
            expression(unary.operand,
                       claim(sign, {Code::UnaryOperatorType},
                             {unary.op == UnaryOp::Not ? program_.boolean : program_.num, 0, {}}));
            break;
        }
        case NodeKind::Binary: binary(as<BinaryExpr>(*e)); break;
        case NodeKind::Call: {
            const auto& call = as<CallExpr>(*e);
            const auto found = module_->facts->calls.find(e);
            if (found != module_->facts->calls.end() && found->second.routine)
                use(found->second.routine, found->second.routine->returnType, std::move(given), other);
            arguments(*e, call.args);
            break;
        }
        default: forEachChild(*e, [this](const Node& child) { visit(child); }); break;
        }
    }

    void element(const IndexExpr& e, Claim given, const Expr* other) {
        if (const Diagnostic* d = find(range(e), Code::IndexNotArray)) {
            given = {};
            given.said = {d};
            given.shape = "an array";
        }
        given.needed.rank = static_cast<uint8_t>(given.needed.rank + e.indices.size());
        expression(e.base, std::move(given), other);
        for (const Expr* index : e.indices)
            expression(index, claim(*index, {Code::IndexType}, program_.num));
    }

    void binary(const BinaryExpr& top) {
        const BinaryExpr* e = &top;
        while (true) {
            const SourceRange sign = range(e->opToken);
            const bool logic = e->op >= BinaryOp::And;
            const DataType boolean = {program_.boolean, 0, {}};
            const std::initializer_list<Code> codes = {Code::OperatorTypes, Code::NumDnumMixed,
                                                       Code::CompareTypes};
            expression(e->right, side(sign, codes, logic ? boolean : info(*e->left).type, *e->right, logic),
                       e->left);
            Claim left = side(sign, codes, logic ? boolean : info(*e->right).type, *e->left, logic);
            if (e->left->kind != NodeKind::Binary) return expression(e->left, std::move(left), e->right);
            e = &as<BinaryExpr>(*e->left);
        }
    }

    /// What an operand should be when the other one is right.
    Claim side(SourceRange sign, std::initializer_list<Code> codes, const DataType& needed, const Expr& e,
               bool logic) const {
        Claim out = claim(sign, codes, needed);
        if (out.nothing || out.said.empty() || isUnknown(info(e).type) || !sameType(info(e).type, needed))
            return out;
        if (logic)
            out.said.clear(); // it is right
        else
            out.needed = {}; // both are wrong
        return out;
    }

    void arguments(const Node& node, std::span<Argument* const> args) {
        const auto found = module_->facts->calls.find(&node);
        if (found == module_->facts->calls.end() || !found->second.routine) {
            for (const Argument* a : args)
                expression(a->value);
            return;
        }
        for (const BoundArg& bound : found->second.args)
            if (bound.argument && bound.value && bound.param) argument(bound);
    }

    void argument(const BoundArg& bound) {
        const Expr& value = *bound.value;
        const DataSymbol& param = *bound.param;
        if (param.type.type->kind == TypeKind::AnyType) return expression(&value, anything());
        const auto codes = {Code::ArgumentType, Code::ArgumentNotVariable};
        const Claim wrong = claim(range(value), codes, {});
        const bool typed = find(range(value), Code::ArgumentType) != nullptr;
        if (!wrong.said.empty() && !typed) { // of the right type, but of another kind
            if (const Symbol* root = rootOf(value))
                kinds_[{root, Code::ArgumentNotVariable, param.mode}].push_back(wrong.said.front());
            return expression(&value);
        }
        const DataType& given = info(value).type;
        use(&param, param.type, claim(range(value), {Code::ArgumentType}, given), &value);
        expression(&value, claim(range(value), {Code::ArgumentType}, param.type));
    }

    const Symbol* rootOf(const Expr& e) const {
        const Expr* root = &e;
        while (root->kind == NodeKind::Index || root->kind == NodeKind::Component)
            root = root->kind == NodeKind::Index ? as<IndexExpr>(*root).base : as<ComponentExpr>(*root).base;
        const Symbol* symbol = root->kind == NodeKind::Name ? info(*root).symbol : nullptr;
        return symbol && symbol->kind == SymbolKind::Data && !symbol->predefined && symbol->decl &&
                       symbol->module == module_
                   ? symbol
                   : nullptr;
    }

    // ---- declarations and instructions

    void initial(const DataSymbol& data) {
        const auto& decl = as<DataDecl>(*data.decl);
        for (const Expr* dimension : decl.dims)
            expression(dimension);
        if (!data.init && !decl.init) return;
        const Expr& init = *decl.init;
        Claim own = claim(range(init), {Code::InitialValueType}, info(init).type);
        if (init.kind == NodeKind::Aggregate) own = members(as<AggregateExpr>(init), data.type);
        use(&data, data.type, std::move(own), &init);
        expression(&init);
    }

    /// The members of an initial value: wrong as a whole when all are wrong in the same way.
    Claim members(const AggregateExpr& e, const DataType& declared) const {
        Claim out;
        if (const Diagnostic* d = find(range(e), Code::AggregateForAtomic)) {
            out.said = {d};
            out.shape = "an array or a record";
            return out;
        }
        const auto wrong = said_.lower_bound(std::tuple(range(e).begin, 0U, Code{}));
        const bool fits = wrong == said_.end() || std::get<0>(wrong->first) >= range(e).end;
        return fits || declared.rank != 1 ? out : elements(e, declared.rank);
    }
    Claim elements(const AggregateExpr& e, uint8_t rank) const {
        Claim out;
        for (const Expr* member : e.elements()) {
            const Diagnostic* d = find(range(*member), Code::AggregateMember);
            const DataType found = {info(*member).type.type, rank, {}};
            if (!d || isUnknown(found) || (out.needed.type && !sameType(out.needed, found))) return {};
            out.needed = found;
            out.said.push_back(d);
        }
        return out;
    }

    void list(StmtList statements) {
        for (const Stmt* s : statements)
            visit(*s);
    }

    void visit(const Node& node) {
        switch (node.kind) {
        case NodeKind::Assign: return assign(as<AssignStmt>(node));
        case NodeKind::CallStmt:
            expression(as<CallStmt>(node).lateName);
            return arguments(node, as<CallStmt>(node).args);
        case NodeKind::IfBranch:
            condition(as<IfBranch>(node).condition);
            return list(as<IfBranch>(node).body);
        case NodeKind::CompactIf:
            condition(as<CompactIfStmt>(node).condition);
            if (as<CompactIfStmt>(node).body) visit(*as<CompactIfStmt>(node).body);
            return;
        case NodeKind::While: condition(as<WhileStmt>(node).condition); return list(as<WhileStmt>(node).body);
        case NodeKind::For: {
            const auto& loop = as<ForStmt>(node);
            for (const Expr* bound : {loop.from, loop.to, loop.step})
                if (bound) expression(bound, claim(*bound, {Code::ForBoundType}, program_.num));
            return list(loop.body);
        }
        case NodeKind::Test: return test(as<TestStmt>(node));
        case NodeKind::Return: return giveBack(as<ReturnStmt>(node));
        default: break;
        }
        if (isExpr(node.kind)) return expression(&static_cast<const Expr&>(node));
        forEachChild(node, [this](const Node& child) { visit(child); });
    }

    void condition(const Expr* e) {
        if (e) expression(e, claim(*e, {Code::ConditionNotBool}, program_.boolean));
    }

    void assign(const AssignStmt& s) {
        if (!s.target || !s.value) return;
        if (const Diagnostic* d = find(range(*s.target), Code::AssignConstant)) {
            if (const Symbol* root = rootOf(*s.target))
                kinds_[{root, Code::AssignConstant, ParamMode::In}].push_back(d);
            expression(s.target, anything());
            return expression(s.value);
        }
        const auto codes = {Code::AssignType, Code::NumDnumAssign};
        expression(s.target, claim(range(*s.value), codes, info(*s.value).type), s.value);
        expression(s.value, claim(range(*s.value), codes, info(*s.target).type));
    }

    void test(const TestStmt& s) {
        if (s.subject && s.cases.empty()) expression(s.subject, anything());
        for (const TestCase* c : s.cases) {
            for (const Expr* value : c->values) {
                const DataType subject = s.subject ? info(*s.subject).type : DataType();
                expression(s.subject, claim(range(*value), {Code::TestValueType}, info(*value).type), value);
                expression(value, claim(range(*value), {Code::TestValueType}, subject));
            }
            list(c->body);
        }
        list(s.defaultBody);
    }

    void giveBack(const ReturnStmt& s) {
        if (!s.value) return;
        if (!routine_ || routine_->routineKind != RoutineKind::Func) return expression(s.value);
        const SourceRange where = range(*s.value);
        use(routine_, routine_->returnType, claim(where, {Code::ReturnType}, info(*s.value).type), s.value);
        expression(s.value, claim(where, {Code::ReturnType}, routine_->returnType));
    }

    // ---- the outcome

    static std::vector<Diagnostic> members(Said said) {
        std::sort(said.begin(), said.end(), [](const Diagnostic* a, const Diagnostic* b) {
            return std::pair(a->range.begin, a) < std::pair(b->range.begin, b);
        });
        said.erase(std::unique(said.begin(), said.end()), said.end());
        std::vector<Diagnostic> out;
        for (const Diagnostic* d : said)
            out.push_back(*d);
        return out;
    }

    /// What other files may use of what has this symbol.
    static const Symbol* guardOf(const Symbol& symbol) {
        const Symbol* seen = &symbol;
        if (symbol.kind == SymbolKind::Data) {
            const auto& data = static_cast<const DataSymbol&>(symbol);
            if (data.storage == Storage::RoutineData) return nullptr;
            if (data.storage == Storage::Parameter) seen = data.routine;
        }
        return seen->isLocal ? nullptr : seen;
    }

    static TokenIndex typeToken(const Symbol& symbol) {
        switch (symbol.decl->kind) {
        case NodeKind::Data: return as<DataDecl>(*symbol.decl).type;
        case NodeKind::Param: return as<ParamDecl>(*symbol.decl).type;
        case NodeKind::Routine: return as<RoutineDecl>(*symbol.decl).returnType;
        default: return kNoToken;
        }
    }

    static bool isWrong(const Uses& uses) {
        if (!uses.contradicted || uses.said.size() < kEnoughUses) return false;
        if (!uses.needed.type) return *uses.shape && !uses.number;
        return !uses.number || uses.needed.type->isNumeric();
    }

    static void addDeclared(std::vector<Repeat>& out, const Symbol& symbol, const Uses& uses) {
        const TokenIndex token = typeToken(symbol);
        Repeat repeat = {members(uses.said), {}, guardOf(symbol)};
        if (token == kNoToken || repeat.members.size() < kEnoughUses) return;
        const DataType declared = symbol.kind == SymbolKind::Routine
                                      ? static_cast<const RoutineSymbol&>(symbol).returnType
                                      : static_cast<const DataSymbol&>(symbol).type;
        const SyntaxTree& tree = *symbol.module->tree;
        Repeat::Declared what;
        what.type = tree.range(token);
        what.name = symbol.name;
        what.found = std::string(tree.text(token));
        const bool sameRank = uses.needed.type && uses.needed.rank == declared.rank;
        if (!uses.needed.type)
            what.needed = uses.shape;
        else if (sameRank)
            what.needed = "'" + (what.replacement = uses.needed.type->name) + "'";
        else
            what.needed = uses.needed.rank > declared.rank ? "an array" : "'" + uses.needed.type->name + "'";
        repeat.declared.push_back(std::move(what));
        out.push_back(std::move(repeat));
    }

    const CheckedProgram& program_;
    const Module* module_ = nullptr;
    const RoutineSymbol* routine_ = nullptr;
    std::map<std::tuple<uint32_t, uint32_t, Code>, const Diagnostic*> said_;
    std::unordered_map<const Symbol*, Uses> uses_;
    std::map<std::tuple<const Symbol*, Code, ParamMode>, Said> kinds_;
};

} // namespace

std::vector<Repeat> findRepeats(const CheckedProgram& program, std::span<Module* const> modules,
                                const Said& said) {
    UseWalk walk(program, said);
    if (!walk.isWorthIt()) return {};
    for (const Module* module : modules)
        walk.walk(*module);
    return walk.repeats();
}

} // namespace rapid::sema

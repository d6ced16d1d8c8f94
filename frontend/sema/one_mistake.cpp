// Walks through the uses of all data and functions of a file that has errors, and finds the declarations that none of
// their uses fits. A single use that fits the declaration, or two that need different types, or only few uses, and
// nothing is merged: then the uses are wrong, each for itself.

#include "frontend/sema/one_mistake.h"

#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <map>
#include <optional>
#include <unordered_map>

namespace rapid::sema {

using namespace syntax;
using diag::Diagnostic;

namespace {

/// So many uses are hardly wrong each for itself. Fewer are reported one by one: a programmer who takes a bool for a number
/// twice has declared it well.
constexpr size_t kEnoughUses = 5;
constexpr size_t kEnoughOfOneKind = 3;

using Said = std::vector<const Diagnostic*>;

/// The type that the place of a use needs.
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

class UseWalk {
  public:
    UseWalk(const CheckedProgram& program, const Said& said, std::span<const ReportedMisfit> misfits)
        : program_(program) {
        std::unordered_map<diag::CauseId, const Diagnostic*> byCause;
        for (const Diagnostic* d : said)
            byCause.emplace(d->cause, d);
        for (const ReportedMisfit& m : misfits) // a report that was taken back is not among `said`
            if (const auto found = byCause.find(m.cause); found != byCause.end())
                said_.emplace(std::pair(m.node, m.misfit), found->second);
    }

    /// Whether there is anything to merge.
    bool hasSeveral() const { return said_.size() > 1; }

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
            if (said.size() >= kEnoughOfOneKind) out.push_back({members(said), {}, guardOf(*key.first)});
        return out;
    }

  private:
    // ---- what was said

    const Diagnostic* find(const Node& node, Misfit misfit) const {
        const auto found = said_.find(std::pair(&node, misfit));
        return found == said_.end() ? nullptr : found->second;
    }
    const ExprInfo& info(const Expr& e) const { return program_.info(*module_, e); }
    bool isUnknown(const DataType& type) const { return !type.type || type.type->kind == TypeKind::Error; }

    /// The claim of a place that needs the type `needed`, with the report that `node` does not fit, if there is one.
    Claim claim(const Node& node, Misfit misfit, const DataType& needed) const {
        Claim out;
        if (const Diagnostic* d = find(node, misfit)) out.said.push_back(d);
        out.needed = needed;
        out.nothing = isUnknown(needed);
        return out;
    }
    Claim claim(const Expr& e, const DataType& needed) const { return claim(e, Misfit::Type, needed); }
    Claim claim(const Expr& e, const Type* needed) const { return claim(e, {needed, 0, {}}); }
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

    /// `other`: the other operand or value, when that is an expression.
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
            if (const Diagnostic* d = find(*e, Misfit::NotRecord)) {
                whole.said = {d};
                whole.shape = "a record";
            }
            expression(part.base, std::move(whole));
            break;
        }
        case NodeKind::Unary: {
            const auto& unary = as<UnaryExpr>(*e);
            expression(unary.operand,
                       claim(unary, Misfit::Operator,
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
        if (const Diagnostic* d = find(e, Misfit::NotArray)) {
            given = {};
            given.said = {d};
            given.shape = "an array";
        }
        given.needed.rank = static_cast<uint8_t>(given.needed.rank + e.indices.size());
        expression(e.base, std::move(given), other);
        for (const Expr* index : e.indices)
            expression(index, claim(*index, program_.num));
    }

    void binary(const BinaryExpr& top) {
        const BinaryExpr* e = &top;
        while (true) {
            const bool logic = e->op >= BinaryOp::And;
            const DataType boolean = {program_.boolean, 0, {}};
            expression(e->right, side(*e, logic ? boolean : info(*e->left).type(), *e->right, logic),
                       e->left);
            Claim left = side(*e, logic ? boolean : info(*e->right).type(), *e->left, logic);
            if (e->left->kind != NodeKind::Binary) return expression(e->left, std::move(left), e->right);
            e = &as<BinaryExpr>(*e->left);
        }
    }

    /// The claim about operand `e` when the other one is right.
    Claim side(const BinaryExpr& whole, const DataType& needed, const Expr& e, bool logic) const {
        Claim out = claim(whole, Misfit::Operator, needed);
        if (out.nothing || out.said.empty() || isUnknown(info(e).type()) || !sameType(info(e).type(), needed))
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
        const bool typed = find(value, Misfit::Type) != nullptr;
        const Diagnostic* access = find(value, Misfit::Access);
        if (access && !typed) { // of the right type, but of a different kind
            if (const Symbol* root = rootOf(value)) kinds_[{root, param.mode}].push_back(access);
            return expression(&value);
        }
        use(&param, param.type, claim(value, info(value).type()), &value);
        expression(&value, claim(value, param.type));
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
        Claim own = claim(init, info(init).type());
        if (init.kind == NodeKind::Aggregate) own = members(as<AggregateExpr>(init), data.type);
        use(&data, data.type, std::move(own), &init);
        expression(&init);
    }

    /// The members of an initial value: wrong as a whole when all are wrong in the same way.
    Claim members(const AggregateExpr& e, const DataType& declared) const {
        Claim out;
        if (const Diagnostic* d = find(e, Misfit::Aggregate)) {
            out.said = {d};
            out.shape = "an array or a record";
            return out;
        }
        return declared.rank != 1 ? out : elements(e, declared.rank);
    }
    Claim elements(const AggregateExpr& e, uint8_t rank) const {
        Claim out;
        for (const Expr* member : e.elements()) {
            const Diagnostic* d = find(*member, Misfit::Type);
            const DataType found = {info(*member).type().type, rank, {}};
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
                if (bound) expression(bound, claim(*bound, program_.num));
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
        if (e) expression(e, claim(*e, program_.boolean));
    }

    void assign(const AssignStmt& s) {
        if (!s.target || !s.value) return;
        if (const Diagnostic* d = find(*s.target, Misfit::Access)) {
            if (const Symbol* root = rootOf(*s.target)) kinds_[{root, std::nullopt}].push_back(d);
            expression(s.target, anything());
            return expression(s.value);
        }
        expression(s.target, claim(*s.value, info(*s.value).type()), s.value);
        expression(s.value, claim(*s.value, info(*s.target).type()));
    }

    void test(const TestStmt& s) {
        if (s.subject && s.cases.empty()) expression(s.subject, anything());
        for (const TestCase* c : s.cases) {
            for (const Expr* value : c->values) {
                const DataType subject = s.subject ? info(*s.subject).type() : DataType();
                expression(s.subject, claim(*value, info(*value).type()), value);
                expression(value, claim(*value, subject));
            }
            list(c->body);
        }
        list(s.defaultBody);
    }

    void giveBack(const ReturnStmt& s) {
        if (!s.value) return;
        if (!routine_ || routine_->routineKind != RoutineKind::Func) return expression(s.value);
        use(routine_, routine_->returnType, claim(*s.value, info(*s.value).type()), s.value);
        expression(s.value, claim(*s.value, routine_->returnType));
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

    /// The symbol that other files may use; null: none.
    static const Symbol* guardOf(const Symbol& symbol) {
        const Symbol* seen = &symbol;
        if (symbol.kind == SymbolKind::Data) {
            const auto& data = static_cast<const DataSymbol&>(symbol);
            if (data.storage == Storage::RoutineData) return nullptr;
            if (data.storage == Storage::Parameter) seen = data.routine;
        }
        return seen->isLocal ? nullptr : seen;
    }

    static bool isWrong(const Uses& uses) {
        if (!uses.contradicted || uses.said.size() < kEnoughUses) return false;
        if (!uses.needed.type) return *uses.shape && !uses.number;
        return !uses.number || uses.needed.type->isNumeric();
    }

    static void addDeclared(std::vector<Repeat>& out, const Symbol& symbol, const Uses& uses) {
        const TokenIndex token = typeTokenOf(*symbol.decl);
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
    std::map<std::pair<const Node*, Misfit>, const Diagnostic*> said_;
    std::unordered_map<const Symbol*, Uses> uses_;
    /// Of data: the parameters of one mode that do not take it, or the assignments to it.
    std::map<std::pair<const Symbol*, std::optional<ParamMode>>, Said> kinds_;
};

} // namespace

std::vector<Repeat> findRepeats(const CheckedProgram& program, std::span<Module* const> modules,
                                const Said& said, std::span<const ReportedMisfit> misfits) {
    UseWalk walk(program, said, misfits);
    if (!walk.hasSeveral()) return {};
    for (const Module* module : modules)
        walk.walk(*module);
    return walk.repeats();
}

} // namespace rapid::sema

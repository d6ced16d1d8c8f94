// Undeclared signals: the names that the program of the task uses as signals. Strong evidence is an argument for a
// parameter of a signal type; without any configuration a comparison with a number will do, unless the name is also
// assigned or calculated with.

#include "frontend/sema/signal_uses.h"
#include "config/letter_case.h"
#include "frontend/sema/add_ins.h"
#include "frontend/sema/parameters.h"
#include "frontend/sema/resolve_data.h"
#include "frontend/sema/resolve_types.h"
#include "frontend/sema/scopes.h"
#include "frontend/sema/suggestions.h"
#include "frontend/syntax/tree_walk.h"

#include <cctype>
#include <cmath>

namespace rapid::sema {

using namespace syntax;

namespace {

/// The part of a name that gives the kind of a signal: all of diStart, what follows in PLC_di_Start and sdoStart, the end
/// of Part_Gi.
std::string_view kindOnwards(std::string_view name) {
    static constexpr std::string_view kKinds[] = {"di", "do", "gi", "go", "ai", "ao"};
    const std::string folded = foldName(name);
    const std::string_view text = folded;
    for (const std::string_view kind : kKinds) {
        if (name.size() > 3 && name[0] == 's' && name.substr(1).starts_with(kind)) return name.substr(1);
        const std::string part = "_" + std::string(kind) + "_";
        if (const size_t at = text.find(part); at != std::string_view::npos && at > 0)
            return name.substr(at + 1);
        const bool isWord = name.ends_with("_do") || name.ends_with("_go"); // to_do, let_go
        if (text.size() > 3 && text.ends_with(part.substr(0, 3)) && !isWord)
            return name.substr(name.size() - 2);
    }
    return name;
}

/// The type of a signal by the habit of naming them: diStart, DO_Clamp, gi1, PLC_do_Ready, sdoArcOn. None: the name has
/// another form.
KnownType typeByName(std::string_view name) {
    const std::string_view whole = name;
    name = kindOnwards(whole);
    const bool isEnd = name.size() == 2 && whole.size() > 3;
    if (name.size() < 3 && !isEnd) return KnownType::None;
    const auto isUpper = [](char c) { return c >= 'A' && c <= 'Z'; };
    const auto isDigit = [](char c) { return c >= '0' && c <= '9'; };
    const bool marked =
        isEnd || name[2] == '_' || isDigit(name[2]) || (isUpper(name[2]) && !isUpper(name[1]));
    if (!marked) return KnownType::None;
    struct Letters {
        char kind, direction;
        KnownType type;
    };
    static constexpr Letters kLetters[] = {
        {'d', 'i', KnownType::DigitalInput}, {'d', 'o', KnownType::DigitalOutput},
        {'g', 'i', KnownType::GroupInput},   {'g', 'o', KnownType::GroupOutput},
        {'a', 'i', KnownType::AnalogInput},  {'a', 'o', KnownType::AnalogOutput}};
    for (const Letters& letters : kLetters)
        if (config::lowerLetter(name[0]) == letters.kind && config::lowerLetter(name[1]) == letters.direction)
            return letters.type;
    return KnownType::None;
}

/// soTouch: an output by the habit of some plants.
bool isOutput(std::string_view name) {
    return name.size() > 2 && config::lowerLetter(name[0]) == 's' && config::lowerLetter(name[1]) == 'o' &&
           (name[2] < 'a' || name[2] > 'z');
}

/// The data types that a signal is compared with. Other names of num (errnum, stoppointdata) count other things than signals.
bool isPlainNumber(const Type& type) {
    return type.kind == TypeKind::SemiValue ||
           (type.isNumeric() && (!type.aliasOf || type.known == KnownType::SignalValue));
}

/// One letter more, less or another; other digits make another name.
bool isMisspelt(std::string_view written, std::string_view declared) {
    constexpr size_t kShort = 4;
    if (written.size() < kShort || editDistance(written, declared, 1) > 1) return false;
    size_t same = 0;
    while (same < written.size() && same < declared.size() && written[same] == declared[same])
        ++same;
    const auto isDigit = [same](std::string_view text) {
        return same < text.size() && std::isdigit(static_cast<unsigned char>(text[same])) != 0;
    };
    return !isDigit(written) && !isDigit(declared);
}

} // namespace

SignalFinder::SignalFinder(State& state, const Parts& parts)
    : CheckerPart(state), data_(parts.data), scopes_(parts.scopes), suggestions_(parts.suggestions),
      types_(parts.types) {}

const Type* SignalFinder::signalTypeByName(const std::string& name) {
    return program_.typeOf(typeByName(name));
}

const Type* SignalFinder::signalTypeByUse(NameId name) {
    gather();
    return task_.signalUses.arguments.find(name);
}

// The type of a name that is known by comparisons with numbers only; null when its use shows that it is not a signal.
const Type* SignalFinder::signalTypeByComparison(const std::string& written, NameId name) {
    gather();
    const auto found = task_.signalUses.compared.find(name);
    if (found == task_.signalUses.compared.end()) return nullptr;
    for (const auto& file : task_.signalUses.files)
        if (file->others.contains(name)) return nullptr;
    const std::string_view folded = names_.folded(name);
    if (task_.moduleNames.find(name) || !addInOf(folded, false, false).empty()) return nullptr;
    for (const Module* module : task_.task->modules)
        if (module != context_.module && state_.scopes[module->id]->names.find(name))
            return nullptr; // LOCAL there
    if (isMisspeltNumber(name)) return nullptr;
    const ComparedName& use = found->second;
    if (use.fraction) return program_.typeOf(KnownType::AnalogInput);
    if (use.most > 1 || use.least < 0 || use.unknown) return program_.typeOf(KnownType::GroupInput);
    return program_.typeOf(isOutput(written) ? KnownType::DigitalOutput : KnownType::DigitalInput);
}

bool SignalFinder::isMisspeltNumber(NameId name) {
    const Suggestion best = suggestions_.suggestion(name, Wanted::Data);
    if (!best.symbol || best.symbol->predefined || best.symbol->kind != SymbolKind::Data) return false;
    const auto& data = static_cast<const DataSymbol&>(*best.symbol);
    const bool number = data.type.type && data.type.type->isNumeric();
    return number && isMisspelt(names_.folded(name), names_.folded(data.nameId));
}

/// Files whose facts are still those of the last check are not read again: after an edit that is all but one.
void SignalFinder::gatherOfTask() {
    task_.signalUses.known = true;
    const Context saved = context_;
    const FileFacts* current = nullptr; // the modules of a file follow each other
    bool isRead = false;
    for (Module* module : task_.task->modules) {
        FileFacts& facts = *module->facts;
        if (&facts != current) {
            current = &facts;
            isRead = facts.signalUses == nullptr;
            if (isRead) {
                auto uses = std::make_shared<FileSignalUses>();
                file_ = uses.get();
                facts.signalUses = std::move(uses);
            }
            task_.signalUses.files.push_back(facts.signalUses);
        }
        if (isRead) gatherOfModule(*module);
    }
    context_ = saved;
    mergeFiles();
}

void SignalFinder::mergeFiles() {
    SignalUses& uses = task_.signalUses;
    for (const auto& file : uses.files)
        for (const auto& [name, type] : file->arguments)
            if (!uses.arguments.find(name)) uses.arguments.set(name, type);
    for (const auto& file : uses.files) {
        for (const auto& [name, compared] : file->compared)
            uses.compared[name].add(compared);
        for (const auto& [name, partner] : file->comparedWith)
            if (uses.arguments.find(partner)) uses.compared[name].unknown = true;
    }
}

void SignalFinder::gatherOfModule(Module& module) {
    state_.enterModule(&module);
    for (const RoutineSymbol* routine : module.routines) {
        const RoutineDecl& decl = *routine->routineDecl;
        own_.clear();
        for (const ParamDecl* param : decl.params)
            declareOwn(param->name, param->type);
        for (const DataDecl* data : decl.data)
            declareOwn(data->name, data->type);
        gatherSignalUses(decl);
    }
}

/// Outside the routine. A signal that is known by its use only is not declared: the use may be gone at the next check.
Symbol* SignalFinder::declared(NameId name) {
    Symbol* symbol = scopes_.lookupOutside(name);
    const DataSymbol* data = asData(symbol);
    return data && data->assumed ? nullptr : symbol;
}

bool SignalFinder::isUndeclared(NameId name) {
    return !own_.contains(name) && !declared(name);
}

// A name of the routine itself is not a signal in any other routine either: there its declaration is missing.
void SignalFinder::declareOwn(TokenIndex name, TokenIndex type) {
    if (!isName(name)) return;
    own_[idOf(name)] = type;
    file_->others.insert(idOf(name));
}

void SignalFinder::gatherSignalUses(const Node& node) {
    switch (node.kind) {
    case NodeKind::Aggregate:
        if (as<AggregateExpr>(node).isPlain()) return;
        break;
    case NodeKind::Binary: // long chains lean to the left
        for (const Node* e = &node;; e = as<BinaryExpr>(*e).left) {
            if (e->kind != NodeKind::Binary) return gatherSignalUses(*e);
            operands(as<BinaryExpr>(*e));
            gatherSignalUses(*as<BinaryExpr>(*e).right);
        }
    case NodeKind::Unary:
        if (as<UnaryExpr>(node).op != UnaryOp::Not) usedOtherwise(*as<UnaryExpr>(node).operand);
        break;
    case NodeKind::Assign:
        if (as<AssignStmt>(node).target) usedOtherwise(*as<AssignStmt>(node).target);
        break;
    case NodeKind::For:
        if (isName(as<ForStmt>(node).variable)) declareOwn(as<ForStmt>(node).variable, kNoToken);
        break;
    case NodeKind::Test: {
        const auto& test = as<TestStmt>(node);
        for (const TestCase* c : test.cases)
            for (const Expr* value : c->values)
                if (test.subject) compared(*test.subject, *value);
        break;
    }
    case NodeKind::CallStmt: {
        const auto& call = as<CallStmt>(node);
        const RoutineSymbol* routine =
            call.lateName ? nullptr : asRoutine(scopes_.lookupOutside(idOf(call.name)));
        if (routine) gatherSignalUses(*routine, call.args);
        break;
    }
    case NodeKind::Call:
        if (const RoutineSymbol* routine = asRoutine(scopes_.lookupOutside(idOf(as<CallExpr>(node).name))))
            gatherSignalUses(*routine, as<CallExpr>(node).args);
        break;
    default: break;
    }
    forEachChild(node, [this](const Node& child) { gatherSignalUses(child); });
}

void SignalFinder::operands(const BinaryExpr& e) {
    if (e.op < BinaryOp::Lt) {
        usedOtherwise(*e.left);
        usedOtherwise(*e.right);
    } else if (e.op <= BinaryOp::Ge) {
        compared(*e.left, *e.right);
        compared(*e.right, *e.left);
    }
}

// Assigned, calculated with, or of a type that signals do not have.
void SignalFinder::usedOtherwise(const Expr& place) {
    const Expr* e = &bare(place);
    while (e->kind == NodeKind::Index || e->kind == NodeKind::Component)
        e = e->kind == NodeKind::Index ? as<IndexExpr>(*e).base : as<ComponentExpr>(*e).base;
    if (e->kind == NodeKind::Name && isName(as<NameExpr>(*e).name))
        file_->others.insert(idOf(as<NameExpr>(*e).name));
}

void SignalFinder::compared(const Expr& side, const Expr& number) {
    const Expr& e = bare(side);
    if (e.kind != NodeKind::Name || !isName(as<NameExpr>(e).name)) return;
    const NameId name = idOf(as<NameExpr>(e).name);
    if (!isUndeclared(name)) return;
    partner_.reset();
    const Type* type = looseType(number);
    if (!type && partner_) file_->comparedWith.emplace_back(name, *partner_);
    if (!type || !isPlainNumber(*type)) return;
    ComparedName& use = file_->compared[name];
    double value = 0;
    if (!looseNumber(number, value)) {
        use.unknown = true;
        return;
    }
    use.fraction |= value != std::floor(value);
    use.most = std::max(use.most, value);
    use.least = std::min(use.least, value);
}

// The type of an expression as far as it is known before anything is checked; null: not known, or that of partner_.
const Type* SignalFinder::looseType(const Expr& expr) {
    const Expr& e = bare(expr);
    switch (e.kind) {
    case NodeKind::NumLiteral: return program_.num;
    case NodeKind::Unary: return looseType(*as<UnaryExpr>(e).operand);
    case NodeKind::Binary: {
        const auto& binary = as<BinaryExpr>(e);
        if (binary.op >= BinaryOp::Lt) return nullptr;
        const Type* type = looseType(*binary.right);
        partner_.reset(); // nothing is calculated with signals
        return type && type->isNumeric() ? type->base() : nullptr;
    }
    case NodeKind::Call: {
        const RoutineSymbol* routine = asRoutine(scopes_.lookupOutside(idOf(as<CallExpr>(e).name)));
        return routine ? routine->returnType.type : nullptr;
    }
    case NodeKind::Index: return looseType(*as<IndexExpr>(e).base);
    case NodeKind::Component: {
        const auto& part = as<ComponentExpr>(e);
        const Type* record = part.name == kNoToken ? nullptr : looseType(*part.base);
        partner_.reset(); // signals have no components
        const int index = record ? record->findComponent(context_.tree->text(part.name)) : -1;
        return index < 0 ? nullptr : record->base()->components[static_cast<size_t>(index)].type;
    }
    case NodeKind::Name: break;
    default: return nullptr;
    }
    if (!isName(as<NameExpr>(e).name)) return nullptr;
    const NameId name = idOf(as<NameExpr>(e).name);
    if (const auto own = own_.find(name); own != own_.end()) {
        if (own->second == kNoToken) return program_.num; // of a FOR
        TypeSymbol* type = scopes_.findType(idOf(own->second));
        return type ? types_.ensureType(*type) : nullptr;
    }
    if (DataSymbol* data = asData(declared(name))) {
        data_.ensureData(*data);
        return data->type.type;
    }
    partner_ = name;
    return nullptr;
}

// The value of a literal or a constant.
bool SignalFinder::looseNumber(const Expr& expr, double& value) {
    const Expr& e = bare(expr);
    if (e.kind == NodeKind::NumLiteral) {
        value = as<NumLiteralExpr>(e).value;
        return true;
    }
    if (e.kind == NodeKind::Unary && as<UnaryExpr>(e).op == UnaryOp::Minus) {
        const bool known = looseNumber(*as<UnaryExpr>(e).operand, value);
        value = -value;
        return known;
    }
    if (e.kind != NodeKind::Name || !isName(as<NameExpr>(e).name)) return false;
    const NameId name = idOf(as<NameExpr>(e).name);
    DataSymbol* data = own_.contains(name) ? nullptr : asData(scopes_.lookupOutside(name));
    if (!data || data->dataKind != DataKind::Const || data->storage != Storage::ModuleData) return false;
    data_.ensureValue(*data);
    value = data->value().kind == ConstValue::Kind::Number ? data->value().number : 0;
    return data->value().kind == ConstValue::Kind::Number;
}

void SignalFinder::gatherSignalUses(const RoutineSymbol& routine, std::span<Argument* const> args) {
    size_t next = nextRequired(routine, 0);
    const Type* partner = nullptr; // AliasIO(name, signal): a signal of that type
    for (const Argument* a : args) {
        if (!a->value || !routine.predefined) continue;
        const Expr* place = a->value; // a variable, or one of an array
        while (place->kind == NodeKind::Index)
            place = as<IndexExpr>(*place).base;
        if (place->kind != NodeKind::Name || !isName(as<NameExpr>(*place).name)) continue;
        const NameId name = idOf(as<NameExpr>(*place).name);
        const DataSymbol* data = asData(scopes_.lookupOutside(name));
        if (!own_.contains(name) && (!data || data->storage != Storage::ModuleData)) continue;
        const Type* type = looseType(*a->value);
        if (type && type->kind == TypeKind::SemiValue) partner = type;
    }
    for (const Argument* a : args) {
        const DataSymbol* param = nullptr;
        if (a->argKind == ArgKind::Required) {
            if (next < routine.params.size()) param = routine.params[next];
            next = nextRequired(routine, alternativesEnd(routine, next));
        } else if (a->name != kNoToken) {
            const NameId name = idOf(a->name);
            for (const DataSymbol* p : routine.params)
                if (p->nameId == name) param = p;
        }
        if (!param || !a->value || a->value->kind != NodeKind::Name) continue;
        const NameId name = idOf(as<NameExpr>(*a->value).name);
        const bool either =
            param->accepts == ParamClass::SignalOrString || param->accepts == ParamClass::Signal;
        const Type* type = either ? partner : param->type.type;
        if (!type || !isUndeclared(name)) continue;
        if (type->kind != TypeKind::SemiValue) {
            if (!either && param->mode != ParamMode::In) usedOtherwise(*a->value);
        } else {
            file_->arguments.try_emplace(name, type->base()); // a type of its own may go with its file
        }
    }
}

} // namespace rapid::sema

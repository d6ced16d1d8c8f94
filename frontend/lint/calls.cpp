// Calls: arguments, interrupts, movements and the waits after them.

#include "config/letter_case.h"
#include "frontend/diag/messages/warnings.h"
#include "frontend/lint/walker.h"

#include <fmt/format.h>

namespace rapid::lint {

using namespace syntax;
using sema::BoundArg;
using sema::BoundCall;
using sema::DataSymbol;
using sema::Effects;
using sema::RoutineSymbol;
using sema::TypeKind;

namespace {

bool isPlace(const Expr& e) {
    return e.kind == NodeKind::Name || e.kind == NodeKind::Index || e.kind == NodeKind::Component;
}

bool named(const DataSymbol& param, std::string_view name) {
    return config::sameName(param.name, name);
}

bool handlesSignal(const RoutineSymbol& routine) {
    for (const DataSymbol* param : routine.params)
        if (!param->optional && param->type.type->kind == TypeKind::SemiValue) return true;
    return false;
}

const BoundArg* given(const BoundCall& call, int param) {
    if (param < 0 || static_cast<size_t>(param) >= call.args.size()) return nullptr;
    const BoundArg& arg = call.args[static_cast<size_t>(param)];
    return arg.argument ? &arg : nullptr;
}

} // namespace

const BoundCall* Walker::find(const Node& node) const {
    const auto found = module_->facts->calls.find(&node);
    return found == module_->facts->calls.end() ? nullptr : &found->second;
}

/// A call by name; whether the instruction after it can be reached.
bool Walker::call(const Node& node, std::span<Argument* const> args) {
    const BoundCall* bound = find(node);
    if (!bound || !bound->routine) {
        for (const Argument* arg : args)
            if (arg->value) isPlace(*arg->value) ? write(*arg->value, kRead) : expr(*arg->value);
        flyBy_ = nullptr;
        ++waits_; // a routine of a module that is encrypted or missing may do anything
        ++ends_;
        return true;
    }
    for (const BoundArg& arg : bound->args)
        if (arg.value) argument(*bound, arg);
    for (const BoundArg& arg : bound->args)
        if (arg.value) reference(*bound, arg);
    if (node.kind == NodeKind::CallStmt) {
        if (bound->routine->effects == Effects::Motion)
            movement(*bound);
        else if (bound->routine->traits.has(sema::Trait::StopPoint))
            wait(node, *bound);
        else if (!bound->routine->native || bound->routine->effects == Effects::Waits)
            flyBy_ = nullptr;
    }
    return conduct(*bound);
}

/// First all that is read ...
void Walker::argument(const BoundCall& call, const BoundArg& arg) {
    const DataSymbol* param = arg.param;
    if (arg.kind == BoundArg::Kind::Conditional || call.routine->traits.has(sema::Trait::Inspects) ||
        (param && param->mode == ParamMode::Ref)) {
        if (isPlace(*arg.value))
            mention(*arg.value);
        else
            expr(*arg.value);
        return;
    }
    if (param && !call.routine->native && param->mode == ParamMode::In) setFrom(*param, *arg.value);
    if (param && param->mode == ParamMode::In) byteValue(param->type, *arg.value);
    const bool byReference =
        param && (param->mode != ParamMode::In || param->type.type->kind == TypeKind::SemiValue);
    if (byReference && isPlace(*arg.value))
        subscripts(*arg.value);
    else
        expr(*arg.value);
}

/// ... then what the routine may write.
void Walker::reference(const BoundCall& call, const BoundArg& arg) {
    const DataSymbol* param = arg.param;
    if (!param || param->mode == ParamMode::In || param->mode == ParamMode::Ref || !isPlace(*arg.value))
        return;
    if (arg.kind == BoundArg::Kind::Conditional || param->type.type->kind == TypeKind::SemiValue) {
        const DataSymbol* data = rootOf(*arg.value);
        if (data && isOwn(*data)) access_[data->index] |= kRead;
        return;
    }
    const DataSymbol* own = rootOf(*arg.value);
    const bool counted = own && isOwn(*own) && own->storage == sema::Storage::Parameter &&
                         own->mode == ParamMode::In && call.routine->traits.has(sema::Trait::Calculates);
    if (counted)
        write(*arg.value, kAssigned, true); // "Incr n;"
    else
        write(*arg.value, kRead);
    if (param->type.type->known == sema::KnownType::Interrupt) interrupt(call, arg);
}

void Walker::interrupt(const BoundCall& call, const BoundArg& arg) {
    const DataSymbol* root = rootOf(*arg.value);
    if (!root) return;
    if (!call.routine->native)
        facts_.connected.insert(root); // perhaps there
    else if (!call.routine->traits.has(sema::Trait::Unconnected))
        facts_.interrupts.push_back({root, call.routine, tree_, range(*arg.value)});
}

void Walker::connect(const ConnectStmt& s) {
    if (!s.target || !isPlace(*s.target)) return;
    subscripts(*s.target);
    write(*s.target, kRead);
    if (const DataSymbol* root = rootOf(*s.target)) facts_.connected.insert(root);
}

/// GetDataVal, SetDataVal: any of the data may be read and written here.
void Walker::usesNames() {
    facts_.dataByName = true;
    for (uint8_t& access : access_)
        access |= kMentioned;
    assigned_.set();
    written_.set();
}

/// The effect of the call on the flow of control; whether the instruction after it can be reached.
bool Walker::conduct(const BoundCall& call) {
    const RoutineSymbol& routine = *call.routine;
    if (routine.traits.has(sema::Trait::CallsByName)) facts_.callsByName = true;
    if (routine.traits.has(sema::Trait::DataNames)) usesNames();
    if (!routine.native) {
        facts_.calls.push_back(&routine);
        return true;
    }
    if (routine.effects == Effects::Waits || routine.effects == Effects::Motion) ++waits_;
    // An error may be the way out of a loop; one of a signal or a calculation is not, unless somebody waits for it.
    const bool acts = routine.effects != Effects::Const && routine.effects != Effects::Pure &&
                      routine.effects != Effects::Reads;
    const bool unlikely = handlesSignal(routine) || routine.traits.has(sema::Trait::Calculates);
    if (acts && routine.raises && (!routine_->routineDecl->errors.empty() || !unlikely)) ++errors_;
    switch (routine.flow) {
    case sema::Flow::Continues: return true;
    case sema::Flow::Stops: ++ends_; return true;
    case sema::Flow::Raises: return raises();
    case sema::Flow::Leaves:
    case sema::Flow::Retries: ++ends_; return false;
    }
    return true;
}

void Walker::lateCall(const CallStmt& s) {
    facts_.callsByName = true;
    flyBy_ = nullptr;
    ++waits_;
    ++ends_;
    expr(*s.lateName);
    for (const Argument* arg : s.args) {
        if (!arg->value) continue;
        if (!isPlace(*arg->value)) {
            expr(*arg->value);
            continue;
        }
        subscripts(*arg->value);
        write(*arg->value, kRead);
    }
}

const MoveParams& Walker::moveParams(const RoutineSymbol& routine) {
    const auto [place, isNew] = moves_.try_emplace(&routine);
    if (!isNew) return place->second;
    MoveParams& out = place->second;
    for (size_t i = 0; i < routine.params.size(); ++i) {
        const DataSymbol& param = *routine.params[i];
        const int index = static_cast<int>(i);
        if (param.type.type->known == sema::KnownType::Zone) out.zone = index;
        if (param.type.type->known == sema::KnownType::Speed && out.speed < 0) out.speed = index;
        if (!param.optional) continue;
        if (named(param, "Z")) out.zoneSize = index;
        if (named(param, "V")) out.speedValue = index;
        if (named(param, "T")) out.time = index;
        if (named(param, "Inpos")) out.inPos = index;
        if (named(param, "Conc")) out.concurrent = index;
    }
    return out;
}

// Manual 2.3 (logic after a fly-by point) and 5 (no zone 0 above 70 mm/s). Speeds and zones that the program changes
// are not known here.
void Walker::movement(const BoundCall& call) {
    constexpr double kSmallestZone = 0.5; // mm: z0 has 0.3, z1 has 1
    constexpr double kFastest = 70;       // mm/s
    flyBy_ = nullptr;
    const MoveParams& params = moveParams(*call.routine);
    const BoundArg* zone = given(call, params.zone);
    if (!zone || !zone->value || given(call, params.inPos)) return;
    const sema::ConstValue* value = constant(*zone->value);
    if (!value || value->members().size() < 2 || value->members()[0].boolean) return;
    if (!given(call, params.concurrent)) flyBy_ = zone->value;

    double size = value->members()[1].number;
    if (const BoundArg* ownSize = given(call, params.zoneSize)) {
        const double* own = ownSize->value ? number(*ownSize->value) : nullptr;
        if (!own) return;
        size = *own;
    }
    if (size > kSmallestZone || given(call, params.time)) return;
    const BoundArg* speed = given(call, params.speed);
    const BoundArg* ownSpeed = given(call, params.speedValue);
    const sema::ConstValue* speedData = speed && speed->value ? constant(*speed->value) : nullptr;
    const double* tcp = nullptr;
    if (ownSpeed)
        tcp = ownSpeed->value ? number(*ownSpeed->value) : nullptr;
    else if (speedData && !speedData->members().empty())
        tcp = &speedData->members()[0].number;
    if (tcp && *tcp > kFastest)
        report(say::ZoneTooSmall, range(*zone->value), {text(*zone->value), fmt::format("{:g}", *tcp)});
}

void Walker::wait(const Node& node, const BoundCall& call) {
    const Node* move = std::exchange(flyBy_, nullptr);
    if (!move) return;
    for (const BoundArg& arg : call.args)
        if (arg.argument && named(*arg.param, "InPos")) return;
    if (diag::Diagnostic* d =
            report(say::WaitAfterFlyBy, tree_->range(node.first), {std::string(tree_->text(node.first))}))
        d->notes.push_back({tree_->source, range(*move), "the movement before it does not stop here"});
}

} // namespace rapid::lint

#include "ir/verify/verify.h"

#include <fmt/format.h>

#include <unordered_set>

#include "ir/core/op_info.h"
#include "ir/verify/routine_verifier.h"

namespace ir {
namespace {

using Findings = std::vector<std::string>;

constexpr uint64_t kLargestType = 1u << 30;

/// Checks one type, given the sizes of the types before it; returns its size.
uint64_t checkType(const Module& module, TypeId id, const std::vector<uint64_t>& sizes, Findings& out) {
    const Type& t = module.types[id];
    auto part = [&](TypeId element) -> uint64_t {
        if (element == kVoid || element >= id) {
            out.push_back(
                fmt::format("type {}: made of type {}, which does not come before it", id, element));
            return 0;
        }
        return sizes[element];
    };
    uint64_t size = 0;
    if (t.kind == TypeKind::Array) {
        size = part(t.element);
        if (t.dims.empty() || t.dims.size() > 3)
            out.push_back(fmt::format("type {}: rank {}", id, t.dims.size()));
        for (int32_t dim : t.dims) {
            if (dim <= 0) out.push_back(fmt::format("type {}: dimension {}", id, dim));
            size = std::min(kLargestType + 1, size * static_cast<uint64_t>(std::max(dim, 1)));
        }
    } else if (t.kind == TypeKind::Record) {
        for (const Field& field : t.fields)
            size += part(field.type) + 8;
    } else if (t.kind == TypeKind::Str) {
        size = t.capacity;
        if (t.capacity == 0) out.push_back(fmt::format("type {}: a string that holds nothing", id));
    } else {
        out.push_back(fmt::format("type {}: a scalar type outside the fixed ids", id));
    }
    if (size > kLargestType) out.push_back(fmt::format("type {}: larger than {} bytes", id, kLargestType));
    return size;
}

bool checkTypes(const Module& module, Findings& out) {
    std::vector<uint64_t> sizes;
    for (TypeId id = 0; id < kScalarTypes; ++id)
        sizes.push_back(module.size(id));
    for (TypeId id = kScalarTypes; id < module.types.size(); ++id)
        sizes.push_back(checkType(module, id, sizes, out));
    return out.empty();
}

/// Walks the scalars of `type` in memory order along `data`; false when they do not fit.
bool matches(const Module& module, TypeId type, const ConstData& data, size_t& at) {
    const Type& t = module.types[type];
    if (t.kind == TypeKind::Record) {
        for (const Field& field : t.fields)
            if (!matches(module, field.type, data, at)) return false;
        return true;
    }
    if (t.kind == TypeKind::Array) {
        uint64_t count = 1;
        for (int32_t dim : t.dims)
            count *= static_cast<uint64_t>(dim);
        for (uint64_t i = 0; i < count; ++i)
            if (!matches(module, t.element, data, at)) return false;
        return true;
    }
    if (at >= data.size()) return false;
    const ConstScalar& scalar = data[at++];
    return scalar.kind == t.kind && (t.kind != TypeKind::Str || scalar.text.size() <= t.capacity);
}

void checkDescs(const Module& module, Findings& out) {
    for (size_t i = 0; i < module.typeDescs.size(); ++i) {
        const TypeDesc& desc = module.typeDescs[i];
        if (desc.type >= module.types.size()) {
            out.push_back(fmt::format("desc {}: type {} does not exist", i, desc.type));
            continue;
        }
        const Type& t = module.types[desc.type];
        for (uint32_t part : desc.fieldDescs)
            if (part >= module.typeDescs.size())
                out.push_back(fmt::format("desc {}: desc {} does not exist", i, part));
        bool record = desc.kind == DescKind::Record, array = desc.kind == DescKind::Array;
        if (record && (t.kind != TypeKind::Record || desc.fieldDescs.size() != t.fields.size() ||
                       desc.fieldNames.size() != t.fields.size()))
            out.push_back(fmt::format("desc {}: does not describe the fields of its record type", i));
        if (array && (t.kind != TypeKind::Array || desc.fieldDescs.size() != 1))
            out.push_back(fmt::format("desc {}: does not describe its array type", i));
        if (!record && !array && !desc.fieldDescs.empty())
            out.push_back(fmt::format("desc {}: parts of something that has none", i));
    }
}

void checkGlobals(const Module& module, Findings& out) {
    std::unordered_set<std::string_view> names;
    for (const Global& global : module.globals) {
        auto add = [&](const std::string& text) {
            out.push_back(fmt::format("global {}: {}", global.name, text));
        };
        if (global.name.empty()) add("has no name");
        if (!names.insert(global.name).second) add("name used twice");
        if (global.type == kVoid || global.type >= module.types.size()) {
            add("type does not exist");
            continue;
        }
        if (global.typeDesc != kNone && global.typeDesc >= module.typeDescs.size())
            add("desc does not exist");
        const bool ofUnit = module.unitTask >= 0 && global.task == static_cast<uint32_t>(module.unitTask);
        if (global.task != kNone && global.task >= module.tasks.size() && !ofUnit) add("task does not exist");
        if (global.file != kNone && global.file >= module.files.size()) add("file does not exist");
        if (global.init.empty()) continue;
        size_t at = 0;
        if (global.kind == GlobalKind::External) add("external with an initial value");
        if (!matches(module, global.type, global.init, at) || at != global.init.size())
            add("initial value does not match the type");
    }
}

/// The C calling convention would have to know their sign.
bool isNarrow(TypeId type) {
    return isInteger(type) && bitsOf(type) < 32;
}

void checkNatives(const Module& module, Findings& out) {
    std::unordered_set<std::string_view> names;
    for (const Native& native : module.natives) {
        auto add = [&](const std::string& text) {
            out.push_back(fmt::format("native {}: {}", native.symbol, text));
        };
        if (!names.insert(native.symbol).second) add("symbol used twice");
        for (TypeId param : native.params)
            if (param == kVoid || param >= module.types.size() || !module.isScalar(param))
                add("parameter is neither scalar nor ptr");
            else if (isNarrow(param))
                add("integers below 32 bits are passed in memory only");
        if (isNarrow(native.result)) add("integers below 32 bits are passed in memory only");
        if (native.result >= module.types.size())
            add("result type does not exist");
        else if (native.nativeClass == NativeClass::Const &&
                 (native.result == kVoid || !module.isScalar(native.result)))
            add("class const needs a scalar result");
    }
}

void checkTables(const Module& module, Findings& out) {
    for (const ExternalRef& external : module.externals) {
        bool slot = external.global < module.globals.size() && module.globals[external.global].type == kI64;
        if (!slot) out.push_back(fmt::format("external {}: has no i64 global as its slot", external.name));
        if (external.file != kNone && external.file >= module.files.size())
            out.push_back(fmt::format("external {}: file does not exist", external.name));
    }
    for (const GlobalAlias& alias : module.aliases) {
        if (alias.global >= module.globals.size() || alias.task >= module.tasks.size())
            out.push_back(fmt::format("alias {}: global or task does not exist", alias.displayName));
        if (alias.file != kNone && alias.file >= module.files.size())
            out.push_back(fmt::format("alias {}: file does not exist", alias.displayName));
    }
    for (const TaskEntry& task : module.tasks) {
        for (uint32_t index : {task.entry, task.reset}) {
            if (index == kNone) continue;
            if (index >= module.routines.size()) {
                out.push_back(fmt::format("task {}: routine does not exist", task.name));
                continue;
            }
            const Routine& routine = module.routines[index];
            // An entry routine may have optional parameters: it is started without arguments.
            const bool takesArguments = index == task.reset && !routine.params.empty();
            if (takesArguments || routine.result != kVoid || !routine.exported)
                out.push_back(fmt::format("task {}: {} must be exported, without parameters and result",
                                          task.name, routine.name));
        }
        if (task.entry == kNone) out.push_back(fmt::format("task {}: has no entry", task.name));
    }
    if (module.configNames.size() != module.configTexts.size())
        out.push_back("config: as many names as texts");
}

/// The parameters of a routine as the source language sees them cover its parameters exactly.
bool covers(const Routine& routine, const std::vector<ParamEntry>& params) {
    size_t next = 0;
    auto take = [&](TypeId type) {
        if (next >= routine.params.size()) return false;
        return routine.params[next++].type == type;
    };
    for (const ParamEntry& param : params) {
        if (next >= routine.params.size()) return false;
        const TypeId type = routine.params[next++].type;
        bool fits = param.typeDesc != kNone ? type == kPtr || param.rank == 0 : type == kBool;
        for (uint8_t k = 0; k < param.rank; ++k)
            fits = fits && take(kI32);
        if (!fits || (param.passesName && !take(kPtr))) return false;
    }
    return next == routine.params.size();
}

void checkNamed(const Module& module, Findings& out) {
    for (const NamedRoutine& named : module.namedRoutines) {
        if (named.routine >= module.routines.size()) {
            out.push_back("named routine: does not exist");
            continue;
        }
        const Routine& routine = module.routines[named.routine];
        if (!routine.exported) out.push_back(fmt::format("named routine {}: is not exported", routine.name));
        const bool ofUnit = module.unitTask >= 0 && named.task == static_cast<uint32_t>(module.unitTask);
        if (named.task != kNone && named.task >= module.tasks.size() && !ofUnit)
            out.push_back(fmt::format("named routine {}: task does not exist", routine.name));
        if (!covers(routine, named.params))
            out.push_back(fmt::format("named routine {}: parameters do not fit", routine.name));
        for (const ParamEntry& param : named.params)
            if (param.typeDesc != kNone && param.typeDesc >= module.typeDescs.size())
                out.push_back(fmt::format("named routine {}: desc of parameter {} does not exist",
                                          routine.name, param.name));
    }
    for (uint32_t desc : module.searchTypes)
        if (desc >= module.typeDescs.size()) out.push_back("search: desc does not exist");
    for (const RoutineData& data : module.routineData)
        if (data.typeDesc >= module.typeDescs.size())
            out.push_back(fmt::format("within {}: desc of {} does not exist", data.routine, data.name));
    for (const ModuleEntry& entry : module.modules) {
        if (entry.file != kNone && entry.file >= module.files.size())
            out.push_back(fmt::format("source {}: file does not exist", entry.name));
        if (entry.gone != kNone &&
            (entry.gone >= module.globals.size() || module.globals[entry.gone].type != kI32))
            out.push_back(fmt::format("source {}: gone is not an i32", entry.name));
    }
}

} // namespace

namespace {
/// False when nothing else can be checked.
bool checkOutside(const Module& module, Findings& out) {
    if (!checkTypes(module, out)) return false; // everything else asks for sizes
    checkDescs(module, out);
    checkGlobals(module, out);
    checkNatives(module, out);
    checkTables(module, out);
    checkNamed(module, out);
    std::unordered_set<std::string_view> names;
    for (const Routine& routine : module.routines)
        if (!names.insert(routine.name).second)
            out.push_back(fmt::format("routine {}: name used twice", routine.name));
    return true;
}
} // namespace

std::vector<std::string> verifyTables(const Module& module) {
    Findings out;
    checkOutside(module, out);
    return out;
}

std::vector<std::string> verifyRoutine(const Module& module, uint32_t routine) {
    Findings out;
    RoutineVerifier(module, module.routines[routine], out).run();
    return out;
}

std::vector<std::string> verify(const Module& module) {
    Findings out;
    if (!checkOutside(module, out)) return out;
    for (const Routine& routine : module.routines)
        RoutineVerifier(module, routine, out).run();
    return out;
}

} // namespace ir

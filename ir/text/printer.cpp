#include <fmt/format.h>

#include <cmath>
#include <utility>

#include "ir/core/op_info.h"
#include "ir/text/names.h"
#include "ir/text/text.h"

namespace ir {
namespace {

using Out = fmt::memory_buffer;

template <class... Args> void put(Out& out, fmt::format_string<Args...> format, Args&&... args) {
    fmt::format_to(std::back_inserter(out), format, std::forward<Args>(args)...);
}

std::string quotedText(std::string_view text) {
    std::string result = "\"";
    for (char c : text) {
        auto byte = static_cast<unsigned char>(c);
        if (c == '"' || c == '\\' || byte < 0x20 || byte == 0x7f)
            result += fmt::format("\\{:02x}", byte);
        else
            result += c;
    }
    return result + '"';
}

std::string number(TypeId type, double value, int64_t integer) {
    if (!isFloat(type)) return std::to_string(integer);
    if (std::isnan(value)) return "nan";
    if (std::isinf(value)) return value < 0 ? "-inf" : "inf";
    return fmt::format("{}", value);
}

void printType(Out& out, const Module& module, TypeId id) {
    const Type& t = module.types[id];
    if (t.kind == TypeKind::Array) {
        put(out, "type {} array {} [{}]\n", id, typeName(t.element), fmt::join(t.dims, ", "));
        return;
    }
    if (t.kind == TypeKind::Str) {
        put(out, "type {} string {}\n", id, t.capacity);
        return;
    }
    put(out, "type {} record {} {{", id, quotedText(t.name));
    for (size_t i = 0; i < t.fields.size(); ++i)
        put(out, "{} {} {}", i ? "," : "", typeName(t.fields[i].type), quotedText(t.fields[i].name));
    put(out, " }}\n");
}

void printDesc(Out& out, const TypeDesc& desc, size_t index) {
    put(out, "desc {} {} base {} {} {}", index, quotedText(desc.name), quotedText(desc.baseName),
        kDescKindNames[static_cast<size_t>(desc.kind)], typeName(desc.type));
    if (desc.kind == DescKind::Array) {
        put(out, " of {}", desc.fieldDescs.empty() ? 0 : desc.fieldDescs[0]);
    } else if (!desc.fieldDescs.empty()) {
        put(out, " {{");
        for (size_t i = 0; i < desc.fieldDescs.size(); ++i)
            put(out, "{} {}: {}", i ? "," : "", quotedText(desc.fieldNames[i]), desc.fieldDescs[i]);
        put(out, " }}");
    }
    put(out, "\n");
}

bool isZero(const ConstScalar& scalar) {
    if (scalar.kind == TypeKind::Str) return scalar.text.empty();
    return scalar.integer == 0 && scalar.number == 0 && !std::signbit(scalar.number);
}

void printData(Out& out, const ConstData& data) {
    put(out, " = {{");
    for (size_t i = 0; i < data.size();) {
        const ConstScalar& s = data[i];
        put(out, "{}", i ? ", " : " ");
        size_t run = i;
        while (run < data.size() && isZero(data[run]) && data[run].kind == s.kind)
            ++run;
        const auto type = static_cast<TypeId>(s.kind);
        const std::string kind = s.kind == TypeKind::Str ? "str" : typeName(type);
        if (run - i > 1) {
            put(out, "zero {} {}", run - i, kind);
            i = run;
            continue;
        }
        if (s.kind == TypeKind::Str)
            put(out, "str {}", quotedText(s.text));
        else
            put(out, "{} {}", kind, number(type, s.number, s.integer));
        ++i;
    }
    put(out, " }}");
}

void printPlace(Out& out, uint32_t file, uint32_t line) {
    if (file != kNone) put(out, " at {}:{}", file, line);
}

void printGlobal(Out& out, const Global& global) {
    put(out, "global @{} {} in {} {} {}", quotedText(global.name), quotedText(global.displayName),
        quotedText(global.moduleName), typeName(global.type),
        kGlobalKindNames[static_cast<size_t>(global.kind)]);
    if (global.typeDesc != kNone) put(out, " desc {}", global.typeDesc);
    if (global.task != kNone) put(out, " task {}", global.task);
    printPlace(out, global.file, global.line);
    if (global.flags != 0) put(out, " flags {}", global.flags);
    if (!global.init.empty()) printData(out, global.init);
    put(out, "\n");
}

void printNative(Out& out, const Native& native) {
    put(out, "native @{} {} {} (", quotedText(native.symbol),
        native.nativeClass == NativeClass::Const ? "const" : "plain", typeName(native.result));
    for (size_t i = 0; i < native.params.size(); ++i)
        put(out, "{}{}", i ? ", " : "", typeName(native.params[i]));
    put(out, "){}{}{}{}\n", native.watches ? " watches" : "", native.finite ? " finite" : "",
        native.bounded ? " bounded" : "", native.whole ? " whole" : "");
}

class RoutinePrinter {
  public:
    RoutinePrinter(Out& out, const Module& module, const Routine& routine)
        : out_(out), module_(module), routine_(routine), numbers_(routine.insts.size(), kNone) {}

    void print() {
        header();
        tables();
        numberValues();
        for (BlockId b = 0; b < routine_.blocks.size(); ++b)
            block(b);
        put(out_, "}}\n");
    }

  private:
    void header() {
        put(out_, "routine @{} {} in {}", quotedText(routine_.name), quotedText(routine_.displayName),
            quotedText(routine_.moduleName));
        printPlace(out_, routine_.file, routine_.line);
        if (routine_.exported) put(out_, " exported");
        if (routine_.noStepIn) put(out_, " nostepin");
        if (routine_.isBuiltin) put(out_, " builtin");
        if (routine_.stepping) put(out_, " stepping");
        if (routine_.hasBackward) put(out_, " backward");
        if (routine_.callable) put(out_, " callable");
        if (routine_.isDetachedHandler) put(out_, " detached");
        if (routine_.textHash != 0) put(out_, " hash {}", routine_.textHash);
        put(out_, " {} (", typeName(routine_.result));
        for (size_t i = 0; i < routine_.params.size(); ++i)
            put(out_, "{}{} {}", i ? ", " : "", typeName(routine_.params[i].type),
                quotedText(routine_.params[i].name));
        put(out_, ") {{\n");
    }

    void tables() {
        for (size_t i = 0; i < routine_.locals.size(); ++i) {
            const Local& local = routine_.locals[i];
            put(out_, "  local {} {} {}{}", i, typeName(local.type), quotedText(local.name),
                local.isParam ? " param" : "");
            if (local.typeDesc != kNone) put(out_, " desc {}", local.typeDesc);
            if (local.reference) put(out_, " ref");
            if (local.rank > 0) put(out_, " dims {} {}", local.rank, local.dims);
            put(out_, "\n");
        }
        for (size_t i = 0; i < routine_.statements.size(); ++i) {
            const Statement& s = routine_.statements[i];
            put(out_, "  stmt {} {} {}:{} {}:{}{}", i, kStmtKindNames[static_cast<size_t>(s.kind)], s.line,
                s.column, s.endLine, s.endColumn, s.handled ? " handled" : "");
            if (s.start != kNone) put(out_, " start b{}", s.start);
            if (s.next != kNone) put(out_, " next b{}", s.next);
            if (s.previous != kNone) put(out_, " after {}", s.previous);
            if (s.flags != 0) put(out_, " flags {}", s.flags);
            put(out_, "\n");
        }
        if (routine_.errorHandler != kNone) {
            put(out_, "  errorhandler b{}", routine_.errorHandler);
            std::vector<std::string> filter;
            for (int32_t number : routine_.errorFilter)
                filter.push_back(number == kEveryError  ? "all"
                                 : number == kOwnErrors ? "own"
                                                        : std::to_string(number));
            for (uint32_t global : routine_.errorFilterGlobals)
                filter.push_back("@" + nameIn(module_.globals, global));
            if (!filter.empty()) put(out_, " [{}]", fmt::join(filter, ", "));
            put(out_, "\n");
        }
        if (routine_.detachedHandler != kNone)
            put(out_, "  detachedhandler @{} [{}]\n", nameIn(module_.routines, routine_.detachedHandler),
                fmt::join(routine_.sharedLocals, ", "));
        if (routine_.undoHandler != kNone) put(out_, "  undohandler b{}\n", routine_.undoHandler);
    }

    void numberValues() {
        uint32_t next = 0;
        for (const Block& b : routine_.blocks)
            for (ValueId id : b.insts)
                if (valueType(routine_.insts[id]) != kVoid) numbers_[id] = next++;
    }

    void block(BlockId b) {
        put(out_, "  b{} {}:\n", b, quotedText(routine_.blockNames[routine_.blocks[b].name]));
        StmtId current = kNone;
        for (ValueId id : routine_.blocks[b].insts) {
            const Inst& inst = routine_.insts[id];
            put(out_, "    ");
            if (numbers_[id] != kNone) put(out_, "%{} = ", numbers_[id]);
            instruction(inst);
            StmtId implied = inst.op == Op::Stmt || inst.op == Op::Step ? inst.index : current;
            if (inst.stmt != implied) {
                if (inst.stmt == kNone)
                    put(out_, " !none");
                else
                    put(out_, " !{}", inst.stmt);
            }
            current = inst.stmt;
            put(out_, "\n");
        }
    }

    std::string value(ValueId id) const {
        bool known = id < numbers_.size() && numbers_[id] != kNone;
        return known ? fmt::format("%{}", numbers_[id]) : std::string("%?");
    }

    void operands(const Inst& inst) {
        for (size_t i = 0; i < inst.operands.size(); ++i)
            put(out_, "{}{}", i ? ", " : " ", value(inst.operands[i]));
    }

    template <class Table> std::string nameIn(const Table& table, uint32_t index) const {
        return index < table.size() ? quotedText(nameOf(table[index])) : "\"?\"";
    }

    void instruction(const Inst& inst) {
        put(out_, "{}", opInfo(inst.op).text);
        if ((inst.op == Op::IAdd || inst.op == Op::IMul) && inst.extra == 1) put(out_, " nsw");
        if (inst.op == Op::FAdd && inst.extra == 1) put(out_, " loose");
        if (opInfo(inst.op).showsType) put(out_, " {}", typeName(inst.type));
        switch (opInfo(inst.op).form) {
        case Form::Plain: operands(inst); return;
        case Form::Number: put(out_, " {}", number(inst.type, inst.number(), inst.integer())); return;
        case Form::Param:
        case Form::Local:
        case Form::TypeDesc:
        case Form::Statement: put(out_, " {}", inst.index); return;
        case Form::Global: put(out_, " @{}", nameIn(module_.globals, inst.index)); return;
        case Form::Routine: put(out_, " @{}", nameIn(module_.routines, inst.index)); return;
        case Form::Sysvar: put(out_, " {}", kSysvarNames[static_cast<size_t>(inst.extra)]); return;
        case Form::Field:
            operands(inst);
            put(out_, ", {}", inst.index);
            return;
        case Form::Error:
            operands(inst);
            put(out_, ", {}", inst.extra);
            return;
        case Form::CallRoutine: call(inst, nameIn(module_.routines, inst.index)); return;
        case Form::CallNative: call(inst, nameIn(module_.natives, inst.index)); return;
        case Form::Cost:
            put(out_, " {}", inst.extra);
            operands(inst);
            return;
        case Form::Jump: put(out_, " b{}", inst.target(0)); return;
        case Form::Branch:
            operands(inst);
            put(out_, ", b{}, b{}", inst.target(0), inst.target(1));
            return;
        case Form::Switch: switchOn(inst); return;
        }
    }

    void call(const Inst& inst, const std::string& callee) {
        put(out_, " @{} (", callee);
        for (size_t i = 0; i < inst.operands.size(); ++i)
            put(out_, "{}{}", i ? ", " : "", value(inst.operands[i]));
        put(out_, ")");
    }

    void switchOn(const Inst& inst) {
        operands(inst);
        put(out_, ", b{} [", inst.target(0));
        const char* separator = "";
        for (const SwitchCase& entry : routine_.caseLists[inst.index])
            put(out_, "{}{}: b{}", std::exchange(separator, ", "), entry.value, entry.target);
        put(out_, "]");
    }

    Out& out_;
    const Module& module_;
    const Routine& routine_;
    std::vector<uint32_t> numbers_;
};

void printNamed(Out& out, const Module& module, const NamedRoutine& named) {
    put(out, "named @{} {}", quotedText(module.routines[named.routine].name),
        kRoutineKindNames[static_cast<size_t>(named.kind)]);
    if (named.isLocal) put(out, " local");
    if (named.late) put(out, " late");
    if (named.task != kNone) put(out, " task {}", named.task);
    put(out, " (");
    for (size_t i = 0; i < named.params.size(); ++i) {
        const ParamEntry& p = named.params[i];
        put(out, "{}{} {}", i ? ", " : "", quotedText(p.name), kParamModeNames[static_cast<size_t>(p.mode)]);
        if (p.typeDesc != kNone) put(out, " desc {}", p.typeDesc);
        if (p.rank > 0) put(out, " rank {}", p.rank);
        if (p.optional) put(out, " optional");
        if (p.group > 0) put(out, " group {}", p.group);
        if (p.passesName) put(out, " name");
    }
    put(out, ")\n");
}

std::string globalName(const Module& module, uint32_t index) {
    return index < module.globals.size() ? quotedText(module.globals[index].name) : "\"?\"";
}

void printSearchTables(Out& out, const Module& module) {
    for (const ModuleEntry& entry : module.modules) {
        put(out, "source {}", quotedText(entry.name));
        if (entry.file != kNone) put(out, " file {}", entry.file);
        if (entry.task != kNone) put(out, " task {}", entry.task);
        if (entry.gone != kNone) put(out, " gone @{}", globalName(module, entry.gone));
        put(out, "\n");
    }
    for (uint32_t desc : module.searchTypes)
        put(out, "search {}\n", desc);
    for (const RoutineData& data : module.routineData) {
        put(out, "within {} {} {} {} desc {}", quotedText(data.moduleName), quotedText(data.routine),
            quotedText(data.name), kGlobalKindNames[static_cast<size_t>(data.kind)], data.typeDesc);
        if (data.task != kNone) put(out, " task {}", data.task);
        put(out, "\n");
    }
    for (const NamedRoutine& named : module.namedRoutines)
        printNamed(out, module, named);
}

void printTails(Out& out, const Module& module) {
    auto routineName = [&](uint32_t i) {
        return i < module.routines.size() ? quotedText(module.routines[i].name) : "\"?\"";
    };
    for (const ExternalRef& external : module.externals) {
        put(out, "external {} {}", quotedText(external.name), quotedText(external.kind));
        if (external.global != kNone) put(out, " @{}", globalName(module, external.global));
        if (external.file != kNone) put(out, " at {}:{}:{}", external.file, external.line, external.column);
        put(out, "\n");
    }
    for (const GlobalAlias& alias : module.aliases) {
        put(out, "alias @{} {} in {} task {}", globalName(module, alias.global),
            quotedText(alias.displayName), quotedText(alias.moduleName), alias.task);
        printPlace(out, alias.file, alias.line);
        put(out, "\n");
    }
    for (const TaskEntry& task : module.tasks) {
        put(out, "task {} {}", quotedText(task.name), quotedText(task.kind));
        if (task.entry != kNone) put(out, " entry @{}", routineName(task.entry));
        if (task.reset != kNone) put(out, " reset @{}", routineName(task.reset));
        put(out, "{}\n", task.motionTask ? " motion" : "");
    }
    printSearchTables(out, module);
    for (size_t i = 0; i < module.configTexts.size(); ++i)
        put(out, "config {} {}\n", quotedText(module.configNames[i]), quotedText(module.configTexts[i]));
}

} // namespace

std::string printRoutine(const Module& module, const Routine& routine) {
    Out out;
    RoutinePrinter(out, module, routine).print();
    return fmt::to_string(out);
}

std::string printModule(const Module& module) {
    Out out;
    put(out, "module {}\n", quotedText(module.name));
    for (size_t i = 0; i < module.files.size(); ++i)
        put(out, "file {} {}\n", i, quotedText(module.files[i]));
    if (!module.folder.empty()) put(out, "folder {}\n", quotedText(module.folder));
    if (!module.sources.empty()) put(out, "sources {}\n", quotedText(module.sources));
    if (module.overflowError != 0) put(out, "overflow {}\n", module.overflowError);
    for (TypeId id = kScalarTypes; id < module.types.size(); ++id)
        printType(out, module, id);
    for (size_t i = 0; i < module.typeDescs.size(); ++i)
        printDesc(out, module.typeDescs[i], i);
    for (const Global& global : module.globals)
        printGlobal(out, global);
    for (const Native& native : module.natives)
        printNative(out, native);
    for (const Routine& routine : module.routines)
        RoutinePrinter(out, module, routine).print();
    printTails(out, module);
    return fmt::to_string(out);
}

} // namespace ir

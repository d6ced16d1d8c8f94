#include <fmt/format.h>

#include <unordered_map>

#include "ir/core/op_info.h"
#include "ir/text/names.h"
#include "ir/text/parser.h"
#include "ir/text/text.h"

namespace ir {
namespace text {
namespace {

class ModuleParser {
  public:
    ModuleParser(std::string_view source, Module& module) : in_(source), module_(module) {}

    bool parse() {
        in_.skipNewLines();
        while (in_.peek().kind != TokenKind::End)
            if (!item()) return false;
        return resolve();
    }
    const std::string& error() const { return in_.error(); }

  private:
    bool item() {
        if (in_.takeWord("module")) return in_.string(module_.name) && in_.endOfLine();
        if (in_.takeWord("file")) return file();
        if (in_.takeWord("folder")) return in_.string(module_.folder) && in_.endOfLine();
        if (in_.takeWord("sources")) return in_.string(module_.sources) && in_.endOfLine();
        if (in_.takeWord("overflow")) return in_.signedInt(module_.overflowError) && in_.endOfLine();
        if (in_.takeWord("type")) return type();
        if (in_.takeWord("desc")) return desc();
        if (in_.takeWord("global")) return global();
        if (in_.takeWord("native")) return native();
        if (in_.takeWord("routine")) return routine();
        if (in_.takeWord("external")) return external();
        if (in_.takeWord("alias")) return alias();
        if (in_.takeWord("task")) return task();
        if (in_.takeWord("config")) return config();
        if (in_.takeWord("source")) return source();
        if (in_.takeWord("search")) return searchType();
        if (in_.takeWord("within")) return routineData();
        if (in_.takeWord("named")) return named();
        return in_.expected(
            "module, file, folder, sources, overflow, type, desc, global, native, routine, external, alias, "
            "task, source, search, "
            "within, named or config");
    }

    bool small(uint8_t& value, int64_t largest) {
        int64_t number = 0;
        if (!in_.integer(number, 0, largest)) return false;
        value = static_cast<uint8_t>(number);
        return true;
    }

    bool source() {
        ModuleEntry entry;
        if (!in_.string(entry.name)) return false;
        if (in_.takeWord("file") && !in_.unsignedInt(entry.file)) return false;
        if (in_.takeWord("task") && !in_.unsignedInt(entry.task)) return false;
        if (in_.takeWord("gone") &&
            !tableReference(Fixup::Kind::Global, Fixup::Slot::ModuleGone, module_.modules.size()))
            return false;
        module_.modules.push_back(std::move(entry));
        return in_.endOfLine();
    }

    bool searchType() {
        uint32_t desc = kNone;
        if (!in_.unsignedInt(desc)) return false;
        module_.searchTypes.push_back(desc);
        return in_.endOfLine();
    }

    bool routineData() {
        RoutineData data;
        size_t kind = 0;
        if (!in_.string(data.moduleName) || !in_.string(data.routine) || !in_.string(data.name) ||
            !in_.oneOf(kGlobalKindNames, "a kind of data", kind) || !in_.word("desc") ||
            !in_.unsignedInt(data.typeDesc))
            return false;
        data.kind = static_cast<GlobalKind>(kind);
        if (in_.takeWord("task") && !in_.unsignedInt(data.task)) return false;
        module_.routineData.push_back(std::move(data));
        return in_.endOfLine();
    }

    bool namedParam(ParamEntry& param) {
        size_t mode = 0;
        if (!in_.string(param.name) || !in_.oneOf(kParamModeNames, "a parameter mode", mode)) return false;
        param.mode = static_cast<ParamMode>(mode);
        if (in_.takeWord("desc") && !in_.unsignedInt(param.typeDesc)) return false;
        if (in_.takeWord("rank") && !small(param.rank, 3)) return false;
        param.optional = in_.takeWord("optional");
        if (in_.takeWord("group") && !small(param.group, 255)) return false;
        param.passesName = in_.takeWord("name");
        return true;
    }

    bool named() {
        NamedRoutine entry;
        size_t kind = 0;
        const size_t index = module_.namedRoutines.size();
        if (!tableReference(Fixup::Kind::Routine, Fixup::Slot::Named, index) ||
            !in_.oneOf(kRoutineKindNames, "a kind of routine", kind))
            return false;
        entry.kind = static_cast<RoutineKind>(kind);
        entry.isLocal = in_.takeWord("local");
        entry.late = in_.takeWord("late");
        if (in_.takeWord("task") && !in_.unsignedInt(entry.task)) return false;
        if (!in_.punct('(')) return false;
        while (!in_.isPunct(')')) {
            if (!namedParam(entry.params.emplace_back())) return false;
            if (!in_.takePunct(',')) break;
        }
        module_.namedRoutines.push_back(std::move(entry));
        return in_.punct(')') && in_.endOfLine();
    }

    bool position(size_t wanted, std::string_view what) {
        Token where = in_.peek();
        uint32_t found = 0;
        if (!in_.unsignedInt(found)) return false;
        return found == wanted || in_.failAt(where, fmt::format("{} {} is expected here", what, wanted));
    }

    bool file() {
        std::string path;
        if (!position(module_.files.size(), "file") || !in_.string(path)) return false;
        module_.files.push_back(std::move(path));
        return in_.endOfLine();
    }

    bool type() {
        if (!position(module_.types.size(), "type")) return false;
        Type type;
        if (in_.takeWord("array")) {
            type.kind = TypeKind::Array;
            if (!in_.type(module_, type.element) || !in_.punct('[')) return false;
            do {
                int64_t dim = 0;
                if (!in_.integer(dim, 1, INT32_MAX)) return false;
                type.dims.push_back(static_cast<int32_t>(dim));
            } while (in_.takePunct(','));
            if (!in_.punct(']')) return false;
        } else if (in_.takeWord("string")) {
            type.kind = TypeKind::Str;
            if (!in_.unsignedInt(type.capacity)) return false;
        } else {
            type.kind = TypeKind::Record;
            if (!in_.word("record") || !in_.string(type.name) || !in_.punct('{')) return false;
            while (!in_.isPunct('}')) {
                Field field;
                if (!in_.type(module_, field.type) || !in_.string(field.name)) return false;
                type.fields.push_back(std::move(field));
                if (!in_.takePunct(',')) break;
            }
            if (!in_.punct('}')) return false;
        }
        module_.types.push_back(std::move(type));
        return in_.endOfLine();
    }

    bool desc() {
        TypeDesc desc;
        size_t kind = 0;
        if (!position(module_.typeDescs.size(), "desc") || !in_.string(desc.name) || !in_.word("base") ||
            !in_.string(desc.baseName) || !in_.oneOf(kDescKindNames, "a kind of description", kind) ||
            !in_.type(module_, desc.type))
            return false;
        desc.kind = static_cast<DescKind>(kind);
        uint32_t part = 0;
        if (in_.takeWord("of")) {
            if (!in_.unsignedInt(part)) return false;
            desc.fieldDescs.push_back(part);
        } else if (in_.takePunct('{')) {
            do {
                std::string fieldName;
                if (!in_.string(fieldName) || !in_.punct(':') || !in_.unsignedInt(part)) return false;
                desc.fieldNames.push_back(std::move(fieldName));
                desc.fieldDescs.push_back(part);
            } while (in_.takePunct(','));
            if (!in_.punct('}')) return false;
        }
        module_.typeDescs.push_back(std::move(desc));
        return in_.endOfLine();
    }

    bool scalar(ConstData& data) {
        bool zero = in_.takeWord("zero");
        int64_t count = 1;
        constexpr int64_t kMostScalars = 1 << 26;
        if (zero && !in_.integer(count, 1, kMostScalars)) return false;
        TypeId type = kVoid;
        Token where = in_.peek();
        const bool isText = in_.takeWord("str");
        if (!isText && !in_.type(module_, type)) return false;
        if (!isText && (type == kVoid || type >= kPtr))
            return in_.failAt(where, "constant data are bool, integers, f32, f64 or str");
        ConstScalar value;
        value.kind = isText ? TypeKind::Str : module_.types[type].kind;
        if (zero) {
            data.insert(data.end(), static_cast<size_t>(count), value);
            return true;
        }
        if (!(isText ? in_.string(value.text) : in_.constant(type, value.number, value.integer)))
            return false;
        data.push_back(std::move(value));
        return true;
    }

    bool place(uint32_t& fileIndex, uint32_t& line) {
        if (!in_.takeWord("at")) return true;
        return in_.unsignedInt(fileIndex) && in_.punct(':') && in_.unsignedInt(line);
    }

    bool global() {
        Global global;
        size_t kind = 0;
        if (!in_.name(global.name) || !in_.string(global.displayName) || !in_.word("in") ||
            !in_.string(global.moduleName) || !in_.type(module_, global.type) ||
            !in_.oneOf(kGlobalKindNames, "a kind of global", kind))
            return false;
        global.kind = static_cast<GlobalKind>(kind);
        if (in_.takeWord("desc") && !in_.unsignedInt(global.typeDesc)) return false;
        if (in_.takeWord("task") && !in_.unsignedInt(global.task)) return false;
        if (!place(global.file, global.line)) return false;
        if (in_.takeWord("flags") && !small(global.flags, 255)) return false;
        if (in_.takePunct('=')) {
            if (!in_.punct('{')) return false;
            do {
                if (!scalar(global.init)) return false;
            } while (in_.takePunct(','));
            if (!in_.punct('}')) return false;
        }
        module_.globals.push_back(std::move(global));
        return in_.endOfLine();
    }

    bool native() {
        Native native;
        constexpr std::string_view kClasses[] = {"const", "plain"};
        size_t nativeClass = 0;
        if (!in_.name(native.symbol) || !in_.oneOf(kClasses, "const or plain", nativeClass) ||
            !in_.type(module_, native.result) || !in_.punct('('))
            return false;
        native.nativeClass = static_cast<NativeClass>(nativeClass);
        while (!in_.isPunct(')')) {
            TypeId param = kVoid;
            if (!in_.type(module_, param)) return false;
            native.params.push_back(param);
            if (!in_.takePunct(',')) break;
        }
        if (!in_.punct(')')) return false;
        native.watches = in_.takeWord("watches");
        native.finite = in_.takeWord("finite");
        native.bounded = in_.takeWord("bounded");
        native.whole = in_.takeWord("whole");
        module_.natives.push_back(std::move(native));
        return in_.endOfLine();
    }

    bool routine() {
        Routine routine;
        if (!in_.name(routine.name) || !in_.string(routine.displayName) || !in_.word("in") ||
            !in_.string(routine.moduleName) || !place(routine.file, routine.line))
            return false;
        routine.exported = in_.takeWord("exported");
        routine.noStepIn = in_.takeWord("nostepin");
        routine.isBuiltin = in_.takeWord("builtin");
        routine.stepping = in_.takeWord("stepping");
        routine.hasBackward = in_.takeWord("backward");
        routine.callable = in_.takeWord("callable");
        routine.isDetachedHandler = in_.takeWord("detached");
        if (in_.takeWord("hash") && !in_.unsignedInt(routine.textHash)) return false;
        if (!in_.type(module_, routine.result) || !in_.punct('(')) return false;
        while (!in_.isPunct(')')) {
            Param param;
            if (!in_.type(module_, param.type) || !in_.string(param.name)) return false;
            routine.params.push_back(std::move(param));
            if (!in_.takePunct(',')) break;
        }
        if (!in_.punct(')') || !in_.punct('{')) return false;
        module_.routines.push_back(std::move(routine));
        auto index = static_cast<uint32_t>(module_.routines.size() - 1);
        return RoutineParser(in_, module_, index, fixups_).parse() && in_.endOfLine();
    }

    bool tableReference(Fixup::Kind kind, Fixup::Slot slot, size_t index) {
        Fixup fixup{kind, {}, in_.peek(), kNone, kNone, slot, static_cast<uint32_t>(index)};
        if (!in_.name(fixup.name)) return false;
        fixups_.push_back(std::move(fixup));
        return true;
    }

    bool external() {
        ExternalRef entry;
        if (!in_.string(entry.name) || !in_.string(entry.kind)) return false;
        if (in_.peek().kind == TokenKind::Name &&
            !tableReference(Fixup::Kind::Global, Fixup::Slot::External, module_.externals.size()))
            return false;
        if (!place(entry.file, entry.line)) return false;
        if (entry.file != kNone && (!in_.punct(':') || !in_.unsignedInt(entry.column))) return false;
        module_.externals.push_back(std::move(entry));
        return in_.endOfLine();
    }

    bool alias() {
        GlobalAlias entry;
        if (!tableReference(Fixup::Kind::Global, Fixup::Slot::Alias, module_.aliases.size()) ||
            !in_.string(entry.displayName) || !in_.word("in") || !in_.string(entry.moduleName) ||
            !in_.word("task") || !in_.unsignedInt(entry.task) || !place(entry.file, entry.line))
            return false;
        module_.aliases.push_back(std::move(entry));
        return in_.endOfLine();
    }

    bool task() {
        TaskEntry entry;
        if (!in_.string(entry.name) || !in_.string(entry.kind)) return false;
        size_t index = module_.tasks.size();
        if (in_.takeWord("entry") && !tableReference(Fixup::Kind::Routine, Fixup::Slot::TaskEntry, index))
            return false;
        if (in_.takeWord("reset") && !tableReference(Fixup::Kind::Routine, Fixup::Slot::TaskReset, index))
            return false;
        entry.motionTask = in_.takeWord("motion");
        module_.tasks.push_back(std::move(entry));
        return in_.endOfLine();
    }

    bool config() {
        std::string name, text;
        if (!in_.string(name) || !in_.string(text)) return false;
        module_.configNames.push_back(std::move(name));
        module_.configTexts.push_back(std::move(text));
        return in_.endOfLine();
    }

    template <class Table> static std::unordered_map<std::string, uint32_t> indexByName(const Table& table) {
        std::unordered_map<std::string, uint32_t> result;
        for (uint32_t i = 0; i < table.size(); ++i)
            result.emplace(nameOf(table[i]), i);
        return result;
    }

    void apply(const Fixup& fixup, uint32_t target) {
        if (fixup.inst != kNone) {
            Inst& inst = module_.routines[fixup.routine].insts[fixup.inst];
            inst.index = target;
            TypeId result = inst.type;
            if (inst.op == Op::Call) result = module_.routines[target].result;
            if (inst.op == Op::CallNative) result = module_.natives[target].result;
            inst.type = module_.isScalar(result) ? result : kVoid;
            return;
        }
        switch (fixup.slot) {
        case Fixup::Slot::External: module_.externals[fixup.index].global = target; break;
        case Fixup::Slot::Alias: module_.aliases[fixup.index].global = target; break;
        case Fixup::Slot::ModuleGone: module_.modules[fixup.index].gone = target; break;
        case Fixup::Slot::TaskEntry: module_.tasks[fixup.index].entry = target; break;
        case Fixup::Slot::TaskReset: module_.tasks[fixup.index].reset = target; break;
        case Fixup::Slot::Named: module_.namedRoutines[fixup.index].routine = target; break;
        case Fixup::Slot::DetachedHandler: module_.routines[fixup.routine].detachedHandler = target; break;
        case Fixup::Slot::ErrorFilter:
            module_.routines[fixup.routine].errorFilterGlobals[fixup.index] = target;
            break;
        }
    }

    bool resolve() {
        auto globals = indexByName(module_.globals);
        auto natives = indexByName(module_.natives);
        auto routines = indexByName(module_.routines);
        for (const Fixup& fixup : fixups_) {
            bool isGlobal = fixup.kind == Fixup::Kind::Global, isNative = fixup.kind == Fixup::Kind::Native;
            const auto& table = isGlobal ? globals : isNative ? natives : routines;
            auto found = table.find(fixup.name);
            if (found == table.end()) {
                std::string_view what = isGlobal ? "global" : isNative ? "native" : "routine";
                return in_.failAt(fixup.where, fmt::format("there is no {} @\"{}\"", what, fixup.name));
            }
            apply(fixup, found->second);
        }
        inferResults();
        return true;
    }

    /// Rule `Same`: known only now that the results of calls are, too; a definition may be below its use.
    void inferResults() {
        for (Routine& routine : module_.routines) {
            for (bool changed = true; changed;) {
                changed = false;
                for (Inst& inst : routine.insts) {
                    if (opInfo(inst.op).result != ResultRule::Same) continue;
                    TypeId type = valueType(routine.insts[inst.operands[inst.op == Op::Select ? 1 : 0]]);
                    changed = changed || type != inst.type;
                    inst.type = type;
                }
            }
        }
    }

    TokenStream in_;
    Module& module_;
    std::vector<Fixup> fixups_;
};

} // namespace
} // namespace text

bool parseModule(std::string_view source, Module& module, std::string& error) {
    text::ModuleParser parser(source, module);
    if (parser.parse()) return true;
    error = parser.error();
    return false;
}

} // namespace ir

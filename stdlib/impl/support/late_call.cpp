// Calls whose target is found by name when they are executed (manual 1.1.5).

#include "runtime/abi/support_natives.h"
#include "runtime/base/text_util.h"
#include "runtime/host/controller.h"
#include "stdlib/impl/support/called_name.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/type_match.h"

#include "stdlib_constants.h"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <fmt/format.h>
#include <memory>
#include <vector>

using namespace rt;
using lib::CalledName;

namespace {

/// The description of absent arguments: no dimensions.
const TypeDesc kAbsent = {"", "", DescKind::Other, 0, 0, {0, 0, 0}, nullptr, nullptr, nullptr};

/// So many objects of a type, in place as long as they are few.
template <class T, std::size_t Few> class FewObjects {
  public:
    FewObjects(std::size_t count, const T& value) : many_(count > Few ? count : 0, value) {
        if (count <= Few) std::fill_n(few_, count, value);
        data_ = count > Few ? many_.data() : few_;
    }
    FewObjects(const FewObjects&) = delete;
    FewObjects& operator=(const FewObjects&) = delete;
    T& operator[](std::size_t i) { return data_[i]; }
    const T* data() const { return data_; }

  private:
    T few_[Few];
    std::vector<T> many_;
    T* data_;
};

/// Arguments of the usual call: given in order, of the very types of the parameters, for IN and INOUT. Asks nothing else.
class PlainArguments {
  public:
    /// False: `Binder` is to match them.
    bool bind(const RoutineEntry& routine, const LateCallArg* args, int32_t count) {
        if (static_cast<uint32_t>(count) != routine.paramCount || routine.paramCount > kMost) return false;
        std::byte* room = copies_;
        for (uint32_t i = 0; i < routine.paramCount; ++i) {
            const LateCallArg& arg = args[i];
            const ParamDesc& param = routine.params[i];
            const bool isPlain = arg.parameter == nullptr && arg.data != nullptr && param.optional == 0 &&
                                 param.rank == 0 && arg.type == param.type && param.type != nullptr;
            if (!isPlain) return false;
            bound_[i] = {arg.data, arg.type, arg.objectName};
            const bool reference = (arg.flags & (kLateReference | kLateConstant)) == kLateReference;
            if (param.mode == kParamInOut ? !reference : param.mode != kParamIn) return false;
            if (!reference || param.mode == kParamInOut) continue;
            // The routine may reach the object otherwise: it gets a copy.
            const bool isWords = param.type->kind == DescKind::Num || param.type->kind == DescKind::Bool ||
                                 param.type->kind == DescKind::Dnum || param.type->kind == DescKind::String ||
                                 param.type->kind == DescKind::Record;
            if (!isWords || param.type->size > static_cast<std::size_t>(copies_ + sizeof copies_ - room))
                return false;
            std::memcpy(room, arg.data, param.type->size);
            bound_[i].data = room;
            room += (param.type->size + kAlign - 1) / kAlign * kAlign;
        }
        return true;
    }
    const LateArg* arguments() const { return bound_; }

  private:
    static constexpr uint32_t kMost = 6;
    static constexpr std::size_t kAlign = 8;
    LateArg bound_[kMost];
    alignas(kAlign) std::byte copies_[192];
};

/// Matches the arguments of a call to the parameters of a routine: required ones in order, optional ones by name.
class Binder {
  public:
    Binder(const Controller& controller, const RoutineEntry& routine)
        : controller_(controller), routine_(routine),
          bound_(routine.paramCount, LateArg{nullptr, &kAbsent, nullptr}), taken_(routine.paramCount, 0) {}

    /// "" or what does not fit.
    std::string bind(const LateCallArg* args, int32_t count) {
        for (int32_t i = 0; i < count; ++i) {
            const uint32_t number = target(args[i]);
            if (number == routine_.paramCount)
                return args[i].parameter != nullptr
                           ? fmt::format("it has no optional parameter '{}'", args[i].parameter->view())
                           : fmt::format("it takes fewer arguments than the {} given", count);
            if (taken_[number])
                return fmt::format("parameter '{}' is given twice", routine_.params[number].name);
            taken_[number] = 1;
            if (std::string problem = take(args[i], routine_.params[number], bound_[number]);
                !problem.empty())
                return problem;
        }
        for (uint32_t i = 0; i < routine_.paramCount; ++i)
            if (!taken_[i] && routine_.params[i].optional == 0)
                return fmt::format("an argument for parameter '{}' is missing", routine_.params[i].name);
        return "";
    }
    const LateArg* arguments() const { return bound_.data(); }

  private:
    uint32_t target(const LateCallArg& arg) {
        for (uint32_t i = 0; i < routine_.paramCount; ++i) {
            const ParamDesc& param = routine_.params[i];
            const bool fits = arg.parameter != nullptr
                                  ? param.optional != 0 && sameName(param.name, arg.parameter->view())
                                  : param.optional == 0 && !taken_[i];
            if (fits) return i;
        }
        return routine_.paramCount;
    }

    std::string take(const LateCallArg& arg, const ParamDesc& param, LateArg& out) {
        if ((param.type == nullptr) != ((arg.flags & kLateSwitch) != 0))
            return fmt::format("parameter '{}' {} a switch", param.name,
                               param.type == nullptr ? "is" : "is not");
        if (arg.data == nullptr) return ""; // a conditional argument that is absent
        out = {arg.data, arg.type != nullptr ? arg.type : &kAbsent, arg.objectName};
        if (param.type == nullptr) return "";
        const lib::Match match = lib::matchArgument(*arg.type, *param.type, param.rank);
        if (match == lib::Match::OtherType)
            return fmt::format("parameter '{}' is of type {}, the argument of type {}", param.name,
                               param.type->name, lib::elementOf(*arg.type).name);
        if (match == lib::Match::OtherDimensions)
            return fmt::format("the argument for parameter '{}' has other dimensions", param.name);
        const bool reference = (arg.flags & kLateReference) != 0 && (arg.flags & kLateConstant) == 0;
        if (param.mode != kParamIn && !reference)
            return fmt::format("parameter '{}' needs a variable or persistent", param.name);
        const bool persistent =
            (param.mode == kParamPers || param.mode == kParamVar) && lib::isPersistent(controller_, arg.data);
        if (param.mode == kParamPers && !persistent)
            return fmt::format("parameter '{}' needs a persistent", param.name);
        if (param.mode == kParamVar && persistent)
            return fmt::format("parameter '{}' needs a variable", param.name);
        if (param.mode == kParamIn && reference) out.data = copyOf(arg);
        return "";
    }

    /// IN is a value: whoever made the call could not know the mode, and the routine may reach the object otherwise.
    void* copyOf(const LateCallArg& arg) {
        const DescKind kind = lib::elementOf(*arg.type).kind;
        if (kind == DescKind::Handle || kind == DescKind::Bytes || kind == DescKind::Other) return arg.data;
        std::byte* const copy = roomFor(arg.type->size);
        std::memcpy(copy, arg.data, arg.type->size);
        return copy;
    }

    std::byte* roomFor(std::size_t size) {
        if (size > sizeof few_ - used_)
            return copies_.emplace_back(std::make_unique<std::byte[]>(size)).get();
        std::byte* const room = few_ + used_;
        constexpr std::size_t kAlign = alignof(std::max_align_t);
        used_ = std::min(sizeof few_, used_ + (size + kAlign - 1) / kAlign * kAlign);
        return room;
    }

    const Controller& controller_;
    const RoutineEntry& routine_;
    FewObjects<LateArg, 6> bound_;
    FewObjects<char, 6> taken_;                   // not 0: there is an argument for this parameter
    alignas(std::max_align_t) std::byte few_[96]; // small copies,
    std::size_t used_ = 0;
    std::vector<std::unique_ptr<std::byte[]>> copies_; // and the others
};

/// Null: there is none.
const RoutineEntry* findCalled(Task& task, const String& name, const CalledName& called) {
    ProgramTables& tables = task.controller().tables();
    const char* const from = task.frame->routine->module;
    const auto index = static_cast<int32_t>(task.index());
    const RoutineEntry* routine = tables.findRoutine(called.routine, called.module, from, index);
    if (routine != nullptr) tables.calls().keep(name, from, index, *routine);
    return routine;
}

const char* wordFor(int32_t kind) {
    return kind == kRoutineFunc ? "function" : kind == kRoutineTrap ? "trap routine" : "procedure";
}

} // namespace

extern "C" {

Status rt_lateCall(TaskCore* core, const String* name, const LateCallArg* args, int32_t count, int32_t kind,
                   void* result) {
    Task& task = taskOf(core);
    const Controller& controller = task.controller();
    Frame* const caller = core->frame;
    const RoutineEntry* routine = task.controller().tables().calls().find(*name, caller->routine->module,
                                                                          static_cast<int32_t>(task.index()));
    if (routine == nullptr) {
        const CalledName called(name->view());
        if (!called.isValid)
            return lib::fail(core, err::ERR_CALLPROC,
                             fmt::format("\"{}\" is not the name of a procedure", name->view()));
        routine = findCalled(task, *name, called);
    }
    if (routine == nullptr) {
        const Status number = kind == kRoutineFunc ? err::ERR_REFUNKFUN : err::ERR_REFUNKPRC;
        return lib::fail(core, number,
                         fmt::format("there is no {} named \"{}\"", wordFor(kind), name->view()));
    }
    const auto refuse = [&](const std::string& why) {
        return lib::fail(core, err::ERR_CALLPROC,
                         fmt::format("'{}' cannot be called so: {}", routine->name, why));
    };
    if (routine->kind != kind || routine->late == nullptr)
        return refuse(fmt::format("it is a {}, not a {}", wordFor(routine->kind), wordFor(kind)));
    if (kind == kRoutineProc && !task.controller().debugger().allowsCall(task, caller, *routine->desc))
        return kOk;
    if (PlainArguments plain; plain.bind(*routine, args, count))
        return task.passOn(routine->late(core, caller, plain.arguments(), result));
    std::string problem;
    Status status = kOk;
    {
        Binder binder(controller, *routine);
        problem = binder.bind(args, count);
        if (problem.empty()) status = routine->late(core, caller, binder.arguments(), result);
    }
    return problem.empty() ? task.passOn(status) : refuse(problem);
}

Status rt_lateTrap(TaskCore* core, void** result, const String* name) {
    const std::string_view written = name->view();
    const std::size_t colon = written.find(':');
    const std::string_view module = colon == std::string_view::npos ? "" : written.substr(0, colon);
    const RoutineEntry* trap = taskOf(core).controller().tables().findRoutine(
        written.substr(colon + 1), module, core->frame->routine->module,
        static_cast<int32_t>(taskOf(core).index()));
    if (trap == nullptr || trap->kind != kRoutineTrap)
        return lib::fail(core, err::ERR_REFUNKTRP,
                         fmt::format("there is no trap routine named \"{}\"", written));
    *result = trap->address;
    return kOk;
}

Status rt_unresolved(TaskCore* core, int32_t number, const String* name) {
    const Task& task = taskOf(core);
    const bool isThere =
        number == err::ERR_REFUNKDAT &&
        task.controller().tables().findGlobal(name->view(), "", static_cast<int32_t>(task.index()), false);
    const char* problem = isThere ? "'{}' has changed since the module that uses it was compiled"
                                  : "nothing in program memory declares '{}'";
    return lib::fail(core, number, fmt::format(fmt::runtime(problem), name->view()));
}
}

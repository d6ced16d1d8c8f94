// Manual 1.17: SetDataSearch, GetNextSym, SetAllDataVal; ArgName.

#include "runtime/base/text_util.h"
#include "stdlib/impl/data/data_access.h"
#include "stdlib/impl/data/name_pattern.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/type_match.h"

#include "natives/support.h"
#include "stdlib_constants.h"

#include <algorithm>
#include <fmt/format.h>
#include <tuple>

using namespace rt;

namespace {

struct Hit {
    std::string name;
    lib::DataPosition position;
    bool below = false; ///< in a block below the one the search starts in: found by \Recursive only
};

/// The search of a task in progress.
struct Search {
    std::vector<Hit> hits;
    std::size_t next = 0;
};

struct Criteria {
    std::string_view type;
    lib::NamePattern pattern;
    bool kinds[3] = {true, true, true}; ///< by GlobalKind
    bool global = true, local = true;
};

Status checkType(TaskCore* task, const String& type, const String* module) {
    const ProgramTables& tables = taskOf(task).controller().tables();
    const auto& types = tables.types();
    const bool known = std::any_of(types.begin(), types.end(),
                                   [&](const TypeDesc* desc) { return sameName(desc->name, type.view()); });
    if (!known)
        return lib::fail(task, err::ERR_SYMBOL_TYPE,
                         fmt::format("there is no data type \"{}\"", type.view()));
    if (module != nullptr && !tables.findModule(static_cast<int32_t>(taskOf(task).index()), module->view()))
        return lib::fail(
            task, err::ERR_SYMBOL_TYPE,
            fmt::format("there is no module \"{}\" that could declare the type", module->view()));
    return kOk;
}

Status readPattern(TaskCore* task, const String* text, lib::NamePattern& pattern) {
    if (text == nullptr || pattern.parse(text->view())) return kOk;
    return lib::fail(task, err::ERR_ARGVALERR,
                     fmt::format("\"{}\" is not a pattern of names; \".*\" matches any text", text->view()));
}

bool wanted(const Criteria& criteria, const char* name, const TypeDesc& type, uint8_t kind, bool isLocal) {
    return kind <= kGlobalConstant && criteria.kinds[kind] && (isLocal ? criteria.local : criteria.global) &&
           sameName(lib::elementOf(type).name, criteria.type) && criteria.pattern.matches(name);
}

/// Everything below the block that a search starts in.
class Collector {
  public:
    Collector(const Task& task, const Criteria& criteria)
        : tables_(task.controller().tables()), task_(static_cast<int32_t>(task.index())),
          criteria_(criteria) {}

    std::vector<Hit> system() {
        global([](const GlobalDesc& data) { return (data.flags & kDataPredefined) != 0; }, false);
        global([](const GlobalDesc& data) { return (data.flags & kDataPredefined) == 0; }, true);
        routines("", "", true);
        return std::move(hits_);
    }
    std::vector<Hit> task() {
        global([](const GlobalDesc& data) { return (data.flags & (kDataPredefined | kDataLocal)) == 0; },
               false);
        global([](const GlobalDesc& data) { return (data.flags & kDataLocal) != 0; }, true);
        routines("", "", true);
        return std::move(hits_);
    }
    std::vector<Hit> module(std::string_view name) {
        global([name](const GlobalDesc& data) { return sameName(data.module, name); }, false);
        routines(name, "", true);
        return std::move(hits_);
    }
    std::vector<Hit> routine(std::string_view module, std::string_view name) {
        routines(module, name, false);
        return std::move(hits_);
    }

  private:
    template <class Filter> void global(Filter filter, bool below) {
        std::vector<std::pair<Place, const GlobalDesc*>> found;
        for (const GlobalDesc* data : tables_.globals())
            if (tables_.isDeclaredIn(*data, task_) && filter(*data) &&
                wanted(criteria_, data->name, *data->type, data->kind, (data->flags & kDataLocal) != 0))
                found.push_back({placeOf(*data, found.size()), data});
        // As they are declared: rows of shared persistents stand elsewhere in the table.
        std::sort(found.begin(), found.end());
        for (const auto& [place, data] : found)
            hits_.push_back({data->name, {data->module, "", task_}, below});
    }
    using Place = std::tuple<std::size_t, uint32_t, std::size_t>; ///< module, line, row in the table
    Place placeOf(const GlobalDesc& data, std::size_t row) const {
        const auto& modules = tables_.modules();
        const auto at = std::find_if(modules.begin(), modules.end(), [&](const LoadedModule& module) {
            return module.task == task_ && sameName(module.name, data.module);
        });
        if (at == modules.end()) return {0, 0, row}; // predefined
        return {1 + static_cast<std::size_t>(at - modules.begin()), data.line, row};
    }
    void routines(std::string_view module, std::string_view routine, bool below) {
        for (const RoutineDataDesc* data : tables_.routineData()) {
            if (data->task != task_ || (!module.empty() && !sameName(data->module, module)) ||
                (!routine.empty() && !sameName(data->routine, routine)))
                continue;
            if (wanted(criteria_, data->name, *data->type, data->kind, true))
                hits_.push_back({data->name, {data->module, data->routine, task_}, below});
        }
    }

    const ProgramTables& tables_;
    int32_t task_;
    const Criteria& criteria_;
    std::vector<Hit> hits_;
};

} // namespace

extern "C" {

Status rt_SetDataSearch(TaskCore* task, const String* Type, const String* TypeMod, const String* Object,
                        bool PersSym, bool VarSym, bool ConstSym, bool InTask, const String* InMod,
                        const String* InRout, bool GlobalSym, bool LocalSym) {
    Search& search = taskOf(task).local<Search>();
    search = {};
    Criteria criteria;
    criteria.type = Type->view();
    if (const Status status = checkType(task, *Type, TypeMod); status != kOk) return status;
    if (const Status status = readPattern(task, Object, criteria.pattern); status != kOk) return status;
    if (PersSym || VarSym || ConstSym) {
        criteria.kinds[kGlobalVariable] = VarSym;
        criteria.kinds[kGlobalPersistent] = PersSym;
        criteria.kinds[kGlobalConstant] = ConstSym;
    }
    criteria.global = !LocalSym;
    criteria.local = !GlobalSym;
    Collector collector(taskOf(task), criteria);
    if (InRout != nullptr)
        search.hits = collector.routine(InMod != nullptr ? InMod->view() : "", InRout->view());
    else if (InMod != nullptr)
        search.hits = collector.module(InMod->view());
    else
        search.hits = InTask ? collector.task() : collector.system();
    return kOk;
}

Status rt_GetNextSym(TaskCore* task, bool* result, String* Object, Handle* Block, bool Recursive) {
    Search& search = taskOf(task).local<Search>();
    *result = false;
    while (search.next < search.hits.size()) {
        const Hit& hit = search.hits[search.next++];
        if (hit.below && !Recursive) continue;
        Object->assign(hit.name);
        *Block = taskOf(task).controller().service<lib::DataPositions>().handleOf(hit.position);
        *result = true;
        break;
    }
    return kOk;
}

Status rt_SetAllDataVal(TaskCore* task, const String* Type, const String* TypeMod, const String* Object,
                        bool Hidden, const void* Value, const TypeDesc* ValueType) {
    Criteria criteria;
    criteria.type = Type->view();
    if (const Status status = checkType(task, *Type, TypeMod); status != kOk) return status;
    if (const Status status = readPattern(task, Object, criteria.pattern); status != kOk) return status;
    const TypeDesc& given = lib::elementOf(*ValueType);
    if (!sameName(given.name, Type->view()) && !sameName(given.baseName, Type->view()))
        return lib::fail(task, err::ERR_SYMBOL_TYPE,
                         fmt::format("the value is of type {}, not {}", given.name, Type->view()));
    const Task& owner = taskOf(task);
    const ProgramTables& tables = owner.controller().tables();
    const auto set = [&](const DebugVariable& variable) {
        const bool fits =
            variable.rank == 0 && lib::matchValue(*variable.type, *ValueType) == lib::Match::Yes;
        if (!fits || !lib::writeProtection(variable).empty()) return;
        (void)lib::copyData(task, variable, const_cast<void*>(Value), *ValueType, true);
    };
    for (const GlobalDesc* data : tables.globals()) {
        const bool own = tables.isDeclaredIn(*data, static_cast<int32_t>(owner.index()));
        if (own && (data->flags & kDataPredefined) == 0 && data->kind != kGlobalConstant &&
            wanted(criteria, data->name, *data->type, data->kind, false))
            set(dataOf(*data));
    }
    for (const DebugVariable& variable : lib::routineData(owner, true)) {
        const bool hides =
            tables.findGlobal(variable.name, "", static_cast<int32_t>(owner.index()), false) != nullptr;
        if (variable.data != nullptr && (Hidden || !hides) && variable.rank == 0 &&
            wanted(criteria, variable.name.c_str(), *variable.type, kGlobalVariable, false))
            set(variable);
    }
    return kOk;
}

/// The compiler puts the name of the caller's data object in place of the parameter; null: there is none.
Status rt_ArgName(TaskCore* task, String* result, void* Parameter, const TypeDesc*, float* ErrorNumber) {
    *result = String{};
    if (ErrorNumber != nullptr) *ErrorNumber = 0;
    if (Parameter != nullptr) {
        *result = *static_cast<const String*>(Parameter);
        return kOk;
    }
    if (ErrorNumber == nullptr)
        return lib::fail(task, err::ERR_ARGNAME, "the argument is an expression, not present, or a switch");
    *ErrorNumber = err::ERR_ARGNAME;
    return kOk;
}
}

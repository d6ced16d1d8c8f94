// Checks across tasks: persistents and modules they share.

#include "frontend/sema/across_tasks.h"

#include "frontend/diag/messages/projects.h"
#include "frontend/sema/type_rules.h"
#include "frontend/sema/wording.h"

#include <map>

namespace rapid::sema {

using namespace syntax;

// Each task has types of its own: they are the same when their names and components are.
bool TaskComparison::sameStructure(const Type& left, const Type& right) {
    const Type &a = *left.base(), &b = *right.base();
    if (&a == &b || a.kind == TypeKind::Error || b.kind == TypeKind::Error) return true;
    if (a.kind != b.kind || names_.intern(a.name) != names_.intern(b.name) ||
        a.components.size() != b.components.size())
        return false;
    for (size_t i = 0; i < a.components.size(); ++i)
        if (names_.intern(a.components[i].name) != names_.intern(b.components[i].name) ||
            !sameStructure(*a.components[i].type, *b.components[i].type))
            return false;
    return true;
}

namespace {
/// Names of components, but of long records only some, from the first that is different.
std::string componentNames(const Type& record, size_t different) {
    constexpr size_t kShown = 6;
    const size_t count = record.components.size();
    const size_t begin = count <= kShown ? 0 : std::min(different, count - kShown);
    std::string all = begin > 0 ? "..." : "";
    for (size_t i = begin; i < std::min(count, begin + kShown); ++i)
        all += (all.empty() ? "" : ", ") + record.components[i].name;
    return all + (begin + kShown < count ? ", ..." : "");
}
} // namespace

/// The difference of two types of one name: "place.x is num" and "place.x is dnum", or the names of the components.
std::pair<std::string, std::string> TaskComparison::difference(const Type& left, const Type& right,
                                                               const std::string& where) {
    const Type &a = *left.base(), &b = *right.base();
    const std::string what = where.empty() ? std::string() : where + " is ";
    if (names_.intern(a.name) != names_.intern(b.name)) return {what + a.name, what + b.name};
    size_t i = 0;
    for (; i < std::min(a.components.size(), b.components.size()); ++i) {
        if (names_.intern(a.components[i].name) != names_.intern(b.components[i].name)) break;
        if (!sameStructure(*a.components[i].type, *b.components[i].type))
            return difference(*a.components[i].type, *b.components[i].type,
                              (where.empty() ? std::string() : where + ".") + a.components[i].name);
    }
    return {what + componentNames(a, i), what + componentNames(b, i)};
}

// The data of a module that is installed shared are one and the same for all tasks (manual 1.2.2).
void TaskComparison::checkSharedModules() {
    if (state_.options.sharedModules.empty() || program_.tasks.size() < 2) return;
    std::map<std::pair<std::string, NameId>, const DataSymbol*> known; // module and name
    for (const auto& task : program_.tasks) {
        for (Module* module : task->modules) {
            const std::string name = foldName(module->name);
            if (!state_.options.sharedModules.contains(name)) continue;
            for (DataSymbol* data : module->data) {
                const bool everywhere = data->dataKind == DataKind::Pers && data->scope == ScopeWord::None;
                if (data->dataKind == DataKind::Const || data->scope == ScopeWord::Task || everywhere)
                    continue;
                const auto [first, isNew] = known.try_emplace({name, data->nameId}, data);
                const DataSymbol& other = *first->second;
                if (isNew ||
                    (sameShape(data->type, other.type) && sameStructure(*data->type.type, *other.type.type)))
                    continue;
                state_.enterModule(module);
                noteDeclared(
                    report(say::SharedDataConflict, range(data->nameToken), {data->name, module->name}),
                    other);
            }
        }
    }
}

// A global persistent is one object for all tasks that declare it (manual 1.20).
void TaskComparison::checkShared(const DataSymbol& data, const DataSymbol& other,
                                 DifferentRecords& reported) {
    const bool sameTypes = sameStructure(*data.type.type, *other.type.type);
    if (sameTypes && sameShape(data.type, other.type)) return;
    std::string own = typeName(data.type), theirs = typeName(other.type);
    if (own == theirs) { // records of one name
        if (!reported.insert({data.type.type->base(), other.type.type->base()}).second) return;
        const auto [mine, yours] = difference(*data.type.type, *other.type.type, "");
        own += " (" + mine + ")";
        theirs += " (" + yours + ")";
    }
    state_.enterModule(data.module);
    noteDeclared(
        report(say::PersConflict, range(data.nameToken), {data.name, std::move(own), std::move(theirs)}),
        other);
}

void TaskComparison::checkAcrossTasks() {
    constexpr size_t kMaxTasks = 20; // manual 1.20
    if (program_.tasks.size() > kMaxTasks)
        state_.sink.report(say::TooManyTasks, nullptr, {}, {std::to_string(program_.tasks.size())});
    checkSharedModules();
    NameMap<DataSymbol> shared;
    NameMap<const Task> names;
    DifferentRecords reported;
    const bool several = program_.tasks.size() > 1; // the names of one task are judged already
    for (const auto& task : program_.tasks) {
        const NameId taskName = names_.intern(task->name);
        if (names.find(taskName)) state_.sink.report(say::DuplicateTask, nullptr, {}, {task->name});
        names.set(taskName, task.get());
        for (Module* module : task->modules) {
            for (DataSymbol* data : several ? module->persistents : std::vector<DataSymbol*>()) {
                DataSymbol* other = shared.find(data->nameId);
                if (!other) {
                    shared.set(data->nameId, data);
                    continue;
                }
                checkShared(*data, *other, reported);
            }
        }
    }
}

} // namespace rapid::sema

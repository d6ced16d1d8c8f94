#include "frontend/query/global_names.h"

#include "frontend/query/declared.h"
#include "frontend/sema/names.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;

bool GlobalNames::OfModule::isUpToDate() const {
    const FileFacts* facts = module->facts;
    return facts && facts->stamp == stamp && !owner.owner_before(facts->symbols) &&
           !facts->symbols.owner_before(owner);
}

bool GlobalNames::OfTask::isUnique() const {
    return !hasDuplicates &&
           std::none_of(modules.begin(), modules.end(), [](const OfModule& part) { return part.repeats; });
}

/// False when another module declares one of the names.
bool GlobalNames::add(OfTask& names, OfModule& part) {
    const Module& module = *part.module;
    bool isAlone = true;
    part.repeats = false;
    const auto one = [&](const Symbol& symbol) {
        if (symbol.isLocal || symbol.name.empty()) return;
        const auto [place, isNew] = names.table.emplace(foldName(symbol.name), &symbol);
        if (isNew)
            part.names.push_back(&place->first);
        else if (place->second->module != &module)
            isAlone = false;
        else
            part.repeats = true;
    };
    forEachDeclared(module, one);
    part.stamp = module.facts ? module.facts->stamp : 0;
    part.owner = module.facts ? module.facts->symbols : nullptr;
    return isAlone;
}

void GlobalNames::build(OfTask& names, const Task& task) {
    names = OfTask{};
    for (const Module* module : task.modules) {
        names.modules.emplace_back().module = module;
        if (!add(names, names.modules.back())) names.hasDuplicates = true;
    }
}

/// False when the table has to be built again.
bool GlobalNames::update(OfTask& names, const Task& task) {
    if (names.hasDuplicates ||
        !std::equal(task.modules.begin(), task.modules.end(), names.modules.begin(), names.modules.end(),
                    [](const Module* now, const OfModule& known) { return now == known.module; }))
        return false;
    std::vector<OfModule*> changed;
    for (OfModule& part : names.modules)
        if (!part.isUpToDate()) changed.push_back(&part);
    for (OfModule* part : changed) {
        for (const std::string* name : part->names)
            names.table.erase(names.table.find(*name)); // by place: the key goes with it
        part->names.clear();
    }
    bool isAlone = true;
    for (OfModule* part : changed)
        isAlone = add(names, *part) && isAlone;
    return isAlone;
}

void GlobalNames::programChanged() {
    for (auto& [task, names] : tasks_)
        names.isUpToDate = false;
}

const NameTable& GlobalNames::of(const Task& task) {
    OfTask& names = tasks_[&task];
    if (!names.isUpToDate && !update(names, task)) build(names, task);
    names.isUpToDate = true;
    return names.table;
}

bool GlobalNames::areUnique(const Task& task) {
    of(task);
    return tasks_[&task].isUnique();
}

} // namespace rapid::query

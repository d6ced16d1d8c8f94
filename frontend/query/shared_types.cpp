#include "frontend/query/shared_types.h"

#include "frontend/sema/names.h"

#include <algorithm>
#include <set>
#include <string>
#include <unordered_map>

namespace rapid::query {

using namespace sema;

namespace {

class Links {
  public:
    explicit Links(const Snapshot& snapshot) {
        std::unordered_map<std::string, const DataSymbol*> shared;
        for (const auto& task : snapshot.program().tasks)
            for (const Module* module : task->modules)
                for (const DataSymbol* data : module->persistents) {
                    const auto [first, isNew] = shared.try_emplace(foldName(data->name), data);
                    if (!isNew && data->type.type && first->second->type.type)
                        link(*first->second->type.type->base(), *data->type.type->base());
                }
    }

    /// All that are linked with a type, itself first.
    std::vector<const Type*> of(const Type& type) const {
        std::vector<const Type*> found{&type};
        for (size_t i = 0; i < found.size(); ++i)
            for (const auto& [one, other] : links_) {
                const Type* next = one == found[i] ? other : other == found[i] ? one : nullptr;
                if (next && std::find(found.begin(), found.end(), next) == found.end()) found.push_back(next);
            }
        return found;
    }

  private:
    /// Types that differ are a mistake, which has a message of its own: their components are not compared.
    void link(const Type& one, const Type& other) {
        if (&one == &other || one.kind != TypeKind::Record || other.kind != TypeKind::Record ||
            foldName(one.name) != foldName(other.name) || one.components.size() != other.components.size() ||
            !links_.insert({&one, &other}).second)
            return;
        for (size_t i = 0; i < one.components.size(); ++i)
            if (one.components[i].type && other.components[i].type)
                link(*one.components[i].type->base(), *other.components[i].type->base());
    }

    std::set<std::pair<const Type*, const Type*>> links_;
};

} // namespace

std::vector<Meaning> alikeInAllTasks(const Snapshot& snapshot, const Meaning& meaning) {
    std::vector<Meaning> all{meaning};
    const TypeSymbol* symbol = typeSymbolOf(meaning.symbol);
    const Type* type = meaning.record ? meaning.record->base() : symbol ? symbol->type : nullptr;
    if (!type || type->aliasOf || type->kind != TypeKind::Record || snapshot.program().tasks.size() < 2)
        return all;
    const auto component = static_cast<size_t>(meaning.component);
    for (const Type* other : Links(snapshot).of(*type)) {
        if (other == type) continue;
        Meaning& alike = all.emplace_back();
        if (!meaning.record)
            alike.symbol = snapshot.symbolOf(*other);
        else if (foldName(other->components[component].name) == foldName(type->components[component].name)) {
            alike.record = other;
            alike.component = meaning.component;
        }
        if (!alike.found()) all.pop_back();
    }
    return all;
}

} // namespace rapid::query

#include "frontend/query/snapshot.h"

#include "frontend/query/declared.h"
#include "frontend/sema/names.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;

Snapshot::Snapshot(const CheckedProgram& program,
                   std::vector<std::shared_ptr<const SourceFile>> configuration,
                   std::shared_ptr<GlobalNames> kept)
    : program_(program), configuration_(std::move(configuration)),
      globals_(kept ? std::move(kept) : std::make_shared<GlobalNames>()) {
    globals_->programChanged();
    addFiles();
}

Snapshot::~Snapshot() = default;

void Snapshot::addFiles() {
    const auto add = [this](const Module& module, const Task* task) {
        if (!module.tree) return;
        FileView* view = nullptr;
        if (const auto known = byTree_.find(module.tree); known != byTree_.end()) {
            view = const_cast<FileView*>(known->second);
        } else {
            files_.push_back(std::make_unique<FileView>());
            view = files_.back().get();
            view->tree = module.tree;
            view->task = task;
            view->facts = module.facts;
            byTree_[module.tree] = view;
        }
        view->modules.push_back(&module);
    };
    for (const auto& task : program_.tasks)
        for (const Module* module : task->modules)
            add(*module, task.get());
    std::unordered_map<const syntax::SyntaxTree*, const Module*> ofLibrary;
    for (const Module* module : program_.predefinedModules)
        ofLibrary[module->tree] = module;
    for (const auto& tree : program_.trees) {
        if (!tree || byTree_.contains(tree.get()) || ofLibrary.contains(tree.get()) || program_.tasks.empty())
            continue; // what follows has no module, and belongs to some task
        files_.push_back(std::make_unique<FileView>());
        files_.back()->tree = tree.get();
        files_.back()->task = program_.tasks.front().get();
        byTree_[tree.get()] = files_.back().get();
    }
    for (const Module* module : program_.predefinedModules)
        add(*module, nullptr);
}

const FileView* Snapshot::file(std::string_view path) const {
    for (const auto& view : files_)
        if (view->source().path() == path) return view.get();
    return nullptr;
}

std::vector<const FileView*> Snapshot::filesOf(std::string_view path) const {
    std::vector<const FileView*> found;
    for (const auto& view : files_)
        if (view->source().path() == path) found.push_back(view.get());
    return found;
}

const FileView* Snapshot::fileOf(const Module& module) const {
    const auto found = byTree_.find(module.tree);
    return found == byTree_.end() ? nullptr : found->second;
}

const NameTable& Snapshot::globals(const Task& task) const {
    return globals_->of(task);
}

bool Snapshot::hasUniqueGlobals(const Task& task) const {
    return globals_->areUnique(task);
}

const NameTable& Snapshot::predefined() const {
    if (predefined_.empty())
        for (const Module* module : program_.predefinedModules)
            forEachDeclared(*module, [this](const Symbol& symbol) {
                if (!symbol.isLocal) predefined_.emplace(foldName(symbol.name), &symbol);
            });
    return predefined_;
}

const std::map<std::string, const DataSymbol*>& Snapshot::configured() const {
    if (configuredKnown_) return configured_;
    configuredKnown_ = true;
    for (size_t i = 0; i < program_.dataSymbols.size(); ++i) {
        const DataSymbol& data = program_.dataSymbols[i];
        if (data.storage == Storage::Signal && !data.name.empty() && data.type.type)
            configured_.emplace(foldName(data.name), &data);
    }
    return configured_;
}

const TypeSymbol* Snapshot::symbolOf(const Type& type) const {
    if (types_.empty()) {
        for (const auto& view : files_)
            for (const Module* module : view->modules)
                for (const TypeSymbol* symbol : module->types)
                    if (symbol->type) types_.emplace(symbol->type, symbol);
    }
    const auto found = types_.find(&type);
    return found == types_.end() ? nullptr : found->second;
}

} // namespace rapid::query

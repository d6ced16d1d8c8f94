#include "tools/service/symbols.h"

#include "frontend/syntax/parser.h"
#include "runtime/base/text_util.h"
#include "tools/service/virtual_controller.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>

namespace rapidc::service {

namespace sema = rapid::sema;
namespace syntax = rapid::syntax;
using rt::sameName;

namespace {

SymbolType typeOf(syntax::DataKind kind) {
    switch (kind) {
    case syntax::DataKind::Var: return SymbolType::Variable;
    case syntax::DataKind::Pers: return SymbolType::Persistent;
    case syntax::DataKind::Const: break;
    }
    return SymbolType::Constant;
}

SymbolType typeOf(syntax::RoutineKind kind) {
    switch (kind) {
    case syntax::RoutineKind::Proc: return SymbolType::Procedure;
    case syntax::RoutineKind::Func: return SymbolType::Function;
    case syntax::RoutineKind::Trap: break;
    }
    return SymbolType::Trap;
}

struct Declared {
    syntax::TokenIndex name = syntax::kNoToken; ///< none: a mistake, a placeholder
    SymbolType type = SymbolType::Variable;
    bool isLocal = false;
};

Declared declaredBy(const syntax::Decl& decl) {
    switch (decl.kind) {
    case syntax::NodeKind::Record: {
        const auto& record = syntax::as<syntax::RecordDecl>(decl);
        return {record.name, record.components.empty() ? SymbolType::Atomic : SymbolType::Record,
                record.local};
    }
    case syntax::NodeKind::Alias: {
        const auto& alias = syntax::as<syntax::AliasDecl>(decl);
        return {alias.name, SymbolType::Alias, alias.local};
    }
    case syntax::NodeKind::Data: {
        const auto& data = syntax::as<syntax::DataDecl>(decl);
        return {data.name, typeOf(data.dataKind), data.scope == syntax::ScopeWord::Local};
    }
    case syntax::NodeKind::Routine: {
        const auto& routine = syntax::as<syntax::RoutineDecl>(decl);
        return {routine.name, typeOf(routine.routineKind), routine.local};
    }
    default: return {};
    }
}

bool isType(SymbolType type) {
    return type == SymbolType::Atomic || type == SymbolType::Record || type == SymbolType::Alias;
}

/// tool0, wobj0 and load0.
bool isFixed(std::string_view name) {
    return sameName(name, "tool0") || sameName(name, "wobj0") || sameName(name, "load0");
}

} // namespace

// ---- Modules -------------------------------------------------------------------------------------------------------

const syntax::SyntaxTree* Symbols::parsed(const rt::Task& task, const std::string& module) {
    std::string text;
    if (!controller_.moduleText(task, module, text)) return nullptr;
    Parsed& known = parsed_[task.name() + "/" + rt::lowerCase(module)];
    if (known.tree && known.text == text) return known.tree.get();
    rapid::diag::Sink sink;
    known.tree = syntax::parse(std::make_shared<const rapid::SourceFile>(module + ".modx", text), sink);
    known.text = std::move(text);
    return known.tree.get();
}

std::vector<Symbols::ModuleView> Symbols::modulesOf(const rt::Task& task) {
    std::vector<ModuleView> views;
    const auto index = static_cast<int32_t>(task.index());
    const sema::CheckedProgram& program = *controller_.program().compilation().program;
    const sema::Task* checked =
        task.index() < program.tasks.size() ? program.tasks[task.index()].get() : nullptr;
    for (const rt::LoadedModule& module : controller_.core().tables().modules()) {
        if (module.task >= 0 && module.task != index) continue;
        ModuleView view;
        view.task = checked;
        view.index = index;
        view.url = fmt::format("RAPID/{}/{}", task.name(), module.name);
        if (module.unit == nullptr && checked != nullptr)
            for (const sema::Module* candidate : checked->modules)
                if (sameName(candidate->name, module.name)) view.checked = candidate;
        view.tree = view.checked != nullptr ? view.checked->tree : parsed(task, module.name);
        if (view.tree == nullptr) continue;
        for (const syntax::ModuleDecl* decl : view.tree->modules)
            if (sameName(view.tree->text(decl->name), module.name)) view.decl = decl;
        if (view.decl != nullptr) views.push_back(std::move(view));
    }
    return views;
}

std::vector<Symbols::ModuleView> Symbols::predefined() const {
    std::vector<ModuleView> views;
    for (const sema::Module* module : controller_.program().compilation().program->predefinedModules) {
        ModuleView view;
        view.url = "RAPID";
        view.tree = module->tree;
        view.decl = module->decl;
        view.checked = module;
        views.push_back(std::move(view));
    }
    return views;
}

// ---- One module ----------------------------------------------------------------------------------------------------

/// Makes infos of the declarations of a module, one after the other, and of what is inside them.
class Symbols::Reader {
  public:
    Reader(Symbols& symbols, const ModuleView& view) : symbols_(symbols), view_(view), tree_(*view.tree) {}

    SymbolInfo module() const {
        SymbolInfo info = named(*view_.decl, view_.decl->name, SymbolType::Module);
        info.url = view_.url;
        info.isSystemModule = (view_.decl->attributes & syntax::kAttrSysmodule) != 0;
        return info;
    }

    /// Calls visit(info, declaration) for what the module declares, as far as wants(name, type) says so: modules may have tens of
    /// thousands of data.
    template <class Wants, class Visit> void declarations(Wants&& wants, Visit&& visit) const {
        for (const syntax::Decl* decl : view_.decl->decls) {
            const Declared declared = declaredBy(*decl);
            if (declared.name == syntax::kNoToken || !wants(tree_.text(declared.name), declared.type))
                continue;
            switch (decl->kind) {
            case syntax::NodeKind::Record: visit(record(syntax::as<syntax::RecordDecl>(*decl)), *decl); break;
            case syntax::NodeKind::Alias: visit(alias(syntax::as<syntax::AliasDecl>(*decl)), *decl); break;
            case syntax::NodeKind::Data:
                visit(data(syntax::as<syntax::DataDecl>(*decl), view_.url, true), *decl);
                break;
            default: visit(routine(syntax::as<syntax::RoutineDecl>(*decl)), *decl); break;
            }
        }
    }

    /// The components of a record, the parameters and data of a routine.
    template <class Visit>
    void inside(const syntax::Decl& decl, const std::string& url, Visit&& visit) const {
        if (decl.kind == syntax::NodeKind::Record) {
            uint32_t number = 0;
            for (const syntax::RecordComponent* component : syntax::as<syntax::RecordDecl>(decl).components) {
                SymbolInfo info = named(*component, component->name, SymbolType::Component);
                info.url = url + "/" + info.name;
                setType(info, component->type);
                info.number = ++number;
                visit(std::move(info));
            }
        }
        if (decl.kind != syntax::NodeKind::Routine) return;
        const auto& routine = syntax::as<syntax::RoutineDecl>(decl);
        uint32_t number = 0;
        for (const syntax::ParamDecl* param : routine.params) {
            SymbolInfo info = named(*param, param->name, SymbolType::Parameter);
            info.url = url + "/" + info.name;
            if (param->isSwitch)
                info.dataType = "switch";
            else
                setType(info, param->type);
            info.dims.assign(param->rank == 255 ? 0 : param->rank, 0);
            info.number = ++number;
            info.isRequired = !param->optional;
            visit(std::move(info));
        }
        for (const syntax::DataDecl* local : routine.data)
            visit(data(*local, url, false));
    }

  private:
    SymbolInfo named(const syntax::Node& node, syntax::TokenIndex name, SymbolType type) const {
        SymbolInfo info;
        info.type = type;
        info.name = std::string(tree_.text(name));
        info.url = view_.url + "/" + info.name;
        info.isPredefined = view_.task == nullptr;
        if (!info.isPredefined) {
            const rapid::SourceRange range = tree_.range(node);
            info.begin = tree_.source->lineColumn(range.begin);
            info.end = tree_.source->lineColumn(range.end);
        }
        return info;
    }

    void setType(SymbolInfo& info, syntax::TokenIndex type) const {
        info.dataType = std::string(tree_.text(type));
        info.typeUrl = symbols_.urlOfType(view_, info.dataType);
    }

    SymbolInfo record(const syntax::RecordDecl& decl) const {
        SymbolInfo info =
            named(decl, decl.name, decl.components.empty() ? SymbolType::Atomic : SymbolType::Record);
        info.isLocal = decl.local;
        info.count = static_cast<uint32_t>(decl.components.size());
        return info;
    }
    SymbolInfo alias(const syntax::AliasDecl& decl) const {
        SymbolInfo info = named(decl, decl.name, SymbolType::Alias);
        info.isLocal = decl.local;
        setType(info, decl.type);
        return info;
    }
    SymbolInfo data(const syntax::DataDecl& decl, const std::string& block, bool ofModule) const {
        SymbolInfo info = named(decl, decl.name, typeOf(decl.dataKind));
        info.url = block + "/" + info.name;
        info.isLocal = decl.scope == syntax::ScopeWord::Local;
        info.isTaskOnly = decl.scope == syntax::ScopeWord::Task;
        info.isReadOnly =
            decl.dataKind == syntax::DataKind::Const || (info.isPredefined && isFixed(info.name));
        setType(info, decl.type);
        for (const syntax::Expr* dim : decl.dims)
            info.dims.push_back(literal(*dim));
        if (ofModule && std::find(info.dims.begin(), info.dims.end(), 0) != info.dims.end()) takeDims(info);
        return info;
    }
    SymbolInfo routine(const syntax::RoutineDecl& decl) const {
        SymbolInfo info = named(decl, decl.name, typeOf(decl.routineKind));
        info.isLocal = decl.local;
        info.count = static_cast<uint32_t>(decl.params.size());
        if (decl.routineKind == syntax::RoutineKind::Func) setType(info, decl.returnType);
        return info;
    }

    static int32_t literal(const syntax::Expr& expr) {
        if (expr.kind != syntax::NodeKind::NumLiteral) return 0;
        return static_cast<int32_t>(syntax::as<syntax::NumLiteralExpr>(expr).value);
    }
    /// Dimensions that are constant expressions: as the data are in memory.
    void takeDims(SymbolInfo& info) const {
        const rt::ProgramTables& tables = symbols_.controller_.core().tables();
        const rt::GlobalDesc* global =
            tables.findGlobal(info.name, std::string(tree_.text(view_.decl->name)), view_.index, true);
        if (global == nullptr || global->type->kind != rt::DescKind::Array) return;
        for (std::size_t i = 0; i < info.dims.size() && i < 3; ++i)
            info.dims[i] = global->type->dims[i];
    }

    Symbols& symbols_;
    const ModuleView& view_;
    const syntax::SyntaxTree& tree_;
};

std::string Symbols::urlOfType(const ModuleView& view, const std::string& name) {
    const auto declares = [&](const ModuleView& module, bool withLocal) {
        return std::any_of(module.decl->decls.begin(), module.decl->decls.end(),
                           [&](const syntax::Decl* decl) {
                               const Declared declared = declaredBy(*decl);
                               return isType(declared.type) && (withLocal || !declared.isLocal) &&
                                      sameName(module.tree->text(declared.name), name);
                           });
    };
    if (view.task == nullptr) return "RAPID/" + name;
    std::string& own = typeUrls_[view.url + "/" + rt::lowerCase(name)];
    if (!own.empty()) return own;
    if (declares(view, true)) return own = view.url + "/" + name;
    std::string& known = typeUrls_[fmt::format("{}/{}", view.index, rt::lowerCase(name))];
    if (known.empty()) {
        known = "RAPID/" + name;
        const rt::Task& task = *controller_.core().tasks()[static_cast<std::size_t>(view.index)];
        for (const ModuleView& other : modulesOf(task))
            if (declares(other, false)) known = other.url + "/" + name;
    }
    return own = known;
}

// ---- Looking up and searching ----------------------------------------------------------------------------------------

/// Takes what fits a query.
class Symbols::Collector {
  public:
    Collector(Symbols& symbols, const SymbolQuery& query, std::vector<SymbolInfo>& found)
        : symbols_(symbols), query_(query), found_(found) {}

    void take(SymbolInfo info) {
        if (!isWanted(info.type)) return;
        if (query_.skipPredefined && info.isPredefined) return;
        if (query_.matches && !query_.matches(info.name)) return;
        if (!query_.dataType.empty() && !sameName(info.dataType, query_.dataType)) return;
        if (!query_.typeUrl.empty() && !sameName(info.typeUrl, query_.typeUrl)) return;
        found_.push_back(std::move(info));
    }
    /// Declarations of the module; `recursive`: with what is inside it; `seen`: only what other modules see.
    void module(const ModuleView& view, bool recursive, bool seen) {
        const Reader reader(symbols_, view);
        const bool looksInside = recursive && wantsInside();
        const auto wants = [&](std::string_view name, SymbolType type) {
            return looksInside || (isWanted(type) && (!query_.matches || query_.matches(std::string(name))));
        };
        reader.declarations(wants, [&](SymbolInfo info, const syntax::Decl& decl) {
            if ((seen && info.isLocal) || !isUsed(view, decl)) return;
            if (looksInside) reader.inside(decl, info.url, [&](SymbolInfo inner) { take(std::move(inner)); });
            take(std::move(info));
        });
    }
    void withModule(const ModuleView& view, bool recursive) {
        take(Reader(symbols_, view).module());
        if (recursive) module(view, true, false);
    }

  private:
    bool isWanted(SymbolType type) const { return query_.types.empty() || query_.types.contains(type); }
    /// Something that lies in routines and records.
    bool wantsInside() const {
        return isWanted(SymbolType::Component) || isWanted(SymbolType::Parameter) ||
               isWanted(SymbolType::Variable) || isWanted(SymbolType::Constant) ||
               isWanted(SymbolType::Persistent);
    }
    bool isUsed(const ModuleView& view, const syntax::Decl& decl) const {
        if (!query_.onlyUsed || view.checked == nullptr || view.task != nullptr) return true;
        const sema::Module& checked = *view.checked;
        const auto used = [&](const auto& list) {
            return std::any_of(list.begin(), list.end(),
                               [&](const auto* symbol) { return symbol->decl == &decl && symbol->used; });
        };
        return used(checked.types) || used(checked.data) || used(checked.routines);
    }

    Symbols& symbols_;
    const SymbolQuery& query_;
    std::vector<SymbolInfo>& found_;
};

std::optional<SymbolInfo> Symbols::findPredefined(std::string_view name, std::string_view component) {
    std::optional<SymbolInfo> found;
    for (const ModuleView& view : predefined()) {
        const Reader reader(*this, view);
        const auto isIt = [&](std::string_view each, SymbolType) { return sameName(each, name); };
        reader.declarations(isIt, [&](SymbolInfo info, const syntax::Decl& decl) {
            if (found) return;
            if (component.empty()) {
                found = std::move(info);
                return;
            }
            reader.inside(decl, info.url, [&](SymbolInfo inner) {
                if (sameName(inner.name, component)) found = std::move(inner);
            });
        });
        if (found) break;
    }
    return found;
}

std::optional<SymbolInfo> Symbols::find(std::string_view url) {
    typeUrls_.clear();
    std::vector<std::string> names = rapid::config::splitPath(url);
    if (!names.empty() && sameName(names.front(), "RAPID")) names.erase(names.begin());
    if (names.empty()) return std::nullopt;
    const rt::Task* task = controller_.core().findTask(names.front());
    if (task == nullptr) return findPredefined(names[0], names.size() > 1 ? names[1] : std::string());
    if (names.size() == 1) {
        SymbolInfo info;
        info.type = SymbolType::Task;
        info.name = task->name();
        info.url = "RAPID/" + info.name;
        return info;
    }
    std::optional<SymbolInfo> found, global;
    const std::string& last = names.back();
    for (const ModuleView& view : modulesOf(*task)) {
        const Reader reader(*this, view);
        SymbolInfo module = reader.module();
        const bool isHere = sameName(module.name, names[1]);
        if (isHere && names.size() == 2) return module;
        const std::string& wanted = names.size() == 4 ? names[2] : last;
        const auto isIt = [&](std::string_view each, SymbolType) {
            return (isHere || names.size() == 2) && sameName(each, wanted);
        };
        reader.declarations(isIt, [&](SymbolInfo info, const syntax::Decl& decl) {
            if (names.size() == 3) found = info;
            if (names.size() == 4)
                reader.inside(decl, info.url, [&](SymbolInfo inner) {
                    if (sameName(inner.name, last)) found = std::move(inner);
                });
            if (names.size() == 2 && (!global || global->isLocal)) global = std::move(info);
        });
    }
    if (found) return found;
    if (global) return global;
    const bool mayBePredefined =
        names.size() == 2 ||
        (names.size() == 3 && (sameName(names[1], "BASE") || sameName(names[1], "user")));
    return mayBePredefined ? findPredefined(last, {}) : std::nullopt;
}

bool Symbols::search(const SymbolQuery& query, std::vector<SymbolInfo>& found) {
    typeUrls_.clear();
    Collector collector(*this, query, found);
    std::vector<std::string> names = rapid::config::splitPath(query.block);
    if (!names.empty() && sameName(names.front(), "RAPID")) names.erase(names.begin());
    const rt::Task* task = names.empty() ? nullptr : controller_.core().findTask(names.front());
    if (query.view == SymbolQuery::View::Stack) return task != nullptr && searchStack(query, *task, found);
    if (names.empty()) {
        for (const auto& each : controller_.core().tasks()) {
            SymbolInfo info = *find("RAPID/" + each->name());
            collector.take(std::move(info));
            if (!query.recursive) continue;
            for (const ModuleView& view : modulesOf(*each))
                collector.withModule(view, true);
        }
        for (const ModuleView& view : predefined())
            collector.module(view, query.recursive, false);
        return true;
    }
    if (task == nullptr) return searchPredefined(names, collector);
    const std::vector<ModuleView> modules = modulesOf(*task);
    const auto here = std::find_if(modules.begin(), modules.end(), [&](const ModuleView& view) {
        return names.size() > 1 && sameName(view.tree->text(view.decl->name), names[1]);
    });
    if (names.size() > 1 && here == modules.end()) return false;
    const bool isScope = query.view == SymbolQuery::View::Scope;
    if (names.size() > 2 && !searchInside(*here, names[2], collector) && !isScope) return false;
    if (names.size() == 2 && !isScope) collector.module(*here, query.recursive, false);
    if (names.size() == 1 && !isScope)
        for (const ModuleView& view : modules)
            collector.withModule(view, query.recursive);
    if (!isScope) return true;
    if (names.size() > 1) collector.module(*here, false, false);
    for (const ModuleView& view : modules) {
        collector.take(Reader(*this, view).module());
        if (names.size() < 2 || &view != &*here) collector.module(view, false, true);
    }
    for (const ModuleView& view : predefined())
        collector.module(view, false, true);
    return true;
}

/// Contents of a routine or a record of the module.
bool Symbols::searchInside(const ModuleView& view, const std::string& name, Collector& collector) {
    const Reader reader(*this, view);
    bool isThere = false;
    const auto isIt = [&](std::string_view each, SymbolType) { return sameName(each, name); };
    reader.declarations(isIt, [&](const SymbolInfo& info, const syntax::Decl& decl) {
        isThere = true;
        reader.inside(decl, info.url, [&](SymbolInfo inner) { collector.take(std::move(inner)); });
    });
    return isThere;
}

bool Symbols::searchPredefined(const std::vector<std::string>& names, Collector& collector) {
    if (names.size() != 1) return false;
    for (const ModuleView& view : predefined())
        if (searchInside(view, names[0], collector)) return true;
    return false;
}

bool Symbols::searchStack(const SymbolQuery& query, const rt::Task& task, std::vector<SymbolInfo>& found) {
    const auto frames = controller_.core().debugger().frames(task);
    if (query.frame >= frames.size()) return false;
    Collector collector(*this, query, found);
    for (const ModuleView& view : modulesOf(task))
        if (sameName(view.tree->text(view.decl->name), frames[query.frame].place.module))
            searchInside(view, frames[query.frame].place.routine, collector);
    return true;
}

} // namespace rapidc::service

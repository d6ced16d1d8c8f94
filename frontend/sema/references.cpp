#include "frontend/sema/references.h"

#include "frontend/sema/names.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <unordered_map>

namespace rapid::sema {

using namespace syntax;

namespace {

using TypeTable = std::unordered_map<std::string, const TypeSymbol*>;

class ReferenceCollector {
  public:
    ReferenceCollector(const CheckedProgram& program, std::vector<Reference>& out)
        : program_(program), out_(out) {
        for (const Module* module : program.predefinedModules)
            for (const TypeSymbol* type : module->types)
                predefinedTypes_.emplace(foldName(type->name), type);
    }

    void collect(const Task& task) {
        task_ = &task;
        globalTypes_.clear();
        for (const Module* module : task.modules)
            for (const TypeSymbol* type : module->types)
                if (!type->isLocal) globalTypes_.emplace(foldName(type->name), type);
        for (const Module* module : task.modules) {
            module_ = module;
            localTypes_.clear();
            for (const TypeSymbol* type : module->types)
                if (type->isLocal) localTypes_.emplace(foldName(type->name), type);
            const size_t begin = out_.size();
            declare();
            if (module->decl) visit(*module->decl);
            std::sort(out_.begin() + static_cast<std::ptrdiff_t>(begin), out_.end(),
                      [](const Reference& a, const Reference& b) { return a.token < b.token; });
        }
    }

  private:
    void add(TokenIndex token, const Symbol* symbol, bool declaration = false) {
        if (token != kNoToken && symbol) out_.push_back({task_, module_, token, symbol, declaration});
    }
    void declare(const Symbol* symbol) { add(symbol->nameToken, symbol, true); }

    void declare() {
        for (const TypeSymbol* type : module_->types)
            declare(type);
        for (const DataSymbol* data : module_->data)
            declare(data);
        for (const RoutineSymbol* routine : module_->routines) {
            declare(routine);
            for (const DataSymbol* param : routine->params)
                declare(param);
            for (const DataSymbol* data : routine->data)
                declare(data);
        }
        declareLabels();
    }

    /// Those of a file are kept together.
    void declareLabels() {
        if (labelsOf_ != module_->facts) {
            labelsOf_ = module_->facts;
            labels_.clear();
            for (size_t i = 0; i < labelsOf_->labels.size(); ++i)
                labels_[labelsOf_->labels[i].module].push_back(&labelsOf_->labels[i]);
        }
        for (const LabelSymbol* label : labels_[module_])
            declare(label);
    }

    void type(TokenIndex token) {
        if (token == kNoToken) return;
        const std::string name = foldName(module_->tree->text(token));
        for (const TypeTable* table : {&localTypes_, &globalTypes_, &predefinedTypes_})
            if (const auto found = table->find(name); found != table->end()) return add(token, found->second);
    }

    void call(const Node& node, TokenIndex name) {
        const auto found = module_->facts->calls.find(&node);
        if (found == module_->facts->calls.end()) return;
        if (found->second.routine) add(name, found->second.routine);
        for (const BoundArg& arg : found->second.args)
            if (arg.param && arg.argument) add(arg.argument->name, arg.param);
    }

    const Symbol* statementSymbol(const Node& node) const {
        const auto found = module_->facts->references.find(&node);
        return found == module_->facts->references.end() ? nullptr : found->second;
    }

    void visit(const Node& node) {
        switch (node.kind) {
        case NodeKind::Name: {
            const auto& name = as<NameExpr>(node);
            add(name.name, program_.info(*module_, name).symbol);
            break;
        }
        case NodeKind::Call: call(node, as<CallExpr>(node).name); break;
        case NodeKind::CallStmt: call(node, as<CallStmt>(node).name); break;
        case NodeKind::Break:
        case NodeKind::Continue: call(node, node.first); break; // a procedure of that name in old files
        case NodeKind::Goto: add(as<GotoStmt>(node).label, statementSymbol(node)); break;
        case NodeKind::Connect: add(as<ConnectStmt>(node).trap, statementSymbol(node)); break;
        case NodeKind::Data: type(as<DataDecl>(node).type); break;
        case NodeKind::Param: type(as<ParamDecl>(node).type); break;
        case NodeKind::Alias: type(as<AliasDecl>(node).type); break;
        case NodeKind::RecordComponent: type(as<RecordComponent>(node).type); break;
        case NodeKind::Routine: type(as<RoutineDecl>(node).returnType); break;
        default: break;
        }
        forEachChild(node, [this](const Node& child) { visit(child); });
    }

    const CheckedProgram& program_;
    std::vector<Reference>& out_;
    TypeTable predefinedTypes_;
    TypeTable globalTypes_;
    TypeTable localTypes_; ///< of the module
    const FileFacts* labelsOf_ = nullptr;
    std::unordered_map<const Module*, std::vector<const LabelSymbol*>> labels_; ///< of this file
    const Task* task_ = nullptr;
    const Module* module_ = nullptr;
};

} // namespace

std::vector<Reference> collectReferences(const CheckedProgram& program) {
    std::vector<Reference> out;
    ReferenceCollector collector(program, out);
    for (const auto& task : program.tasks)
        collector.collect(*task);
    return out;
}

} // namespace rapid::sema

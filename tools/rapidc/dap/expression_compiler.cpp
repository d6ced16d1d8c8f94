#include "tools/rapidc/dap/expression_compiler.h"

#include "codegen/codegen.h"
#include "config/read_file.h"
#include "frontend/syntax/tree_walk.h"
#include "ir/lower/lower.h"
#include "runtime/abi/unit_image.h"
#include "runtime/base/text_util.h"
#include "runtime/host/module_units.h"
#include "runtime/host/unit_compiler.h"
#include "stdlib/native_table.h"
#include "tools/program/native_library.h"
#include "tools/rapidc/dap/expression_names.h"

#include <algorithm>
#include <dlfcn.h>
#include <fmt/format.h>
#include <set>
#include <thread>
#include <unordered_map>

namespace rapidc::dap {

namespace sema = rapid::sema;
namespace syntax = rapid::syntax;
namespace diag = rapid::diag;

/// Data of other modules by their symbols in the image.
struct ImportedData {
    std::unordered_map<std::string, std::pair<std::string, std::string>> bySymbol; ///< name, module
};

namespace {

constexpr const char* kModule = "rapidc_expression";
constexpr const char* kRoutine = "rapidc_evaluate";
constexpr const char* kShown = "(expression)"; ///< its name in events
constexpr const char* kResult = "rapidc_result";
constexpr const char* kError = "rapidc_error";
constexpr const char* kAfterText = "\n \n"; ///< after the last one comes what the user has not written

std::string pathOf(std::size_t task) {
    return fmt::format("expression:{}.modx", task);
}

std::string emptyModule() {
    return fmt::format("MODULE {}\nENDMODULE\n", kModule);
}

const sema::Module* findModule(const sema::Task& task, std::string_view name) {
    for (const sema::Module* module : task.modules)
        if (rt::sameName(module->name, name)) return module;
    return nullptr;
}

const sema::RoutineSymbol* findRoutine(const sema::Module* module, std::string_view name) {
    if (module == nullptr) return nullptr;
    for (const sema::RoutineSymbol* routine : module->routines)
        if (rt::sameName(routine->name, name)) return routine;
    return nullptr;
}

bool isValueType(const sema::Type* type) {
    return type != nullptr && !type->containsNonValue && type->base()->kind != sema::TypeKind::Error;
}

/// A task of the program has a small stack, too small for a compiler.
template <class Work> void onOwnStack(Work&& work) {
    std::thread(std::forward<Work>(work)).join();
}

const syntax::Expr* valueOf(const syntax::RoutineDecl& routine);

} // namespace

struct ExpressionCompiler::Draft {
    const ExpressionScope& scope;
    const std::string& text;
    ExpressionKind kind;
    std::string resultType = "num";
    std::vector<std::string> names = {};   ///< data of the routine that the text names, in order
    const sema::Module* module = nullptr;  ///< as it was checked
    const sema::Type* valueType = nullptr; ///< of the expression; null: not known
    bool isMisread = false;                ///< a mistake of syntax

    bool isOrder() const { return kind == ExpressionKind::Orders; }
};

namespace {

std::string declarationOf(const sema::DataSymbol& data) {
    if (data.isSwitch) return fmt::format("\\switch {}", data.name);
    std::string text = data.optional ? "\\" : "";
    text += fmt::format("{} {} {}", isValueType(data.type.type) ? "INOUT" : "VAR", data.type.type->name,
                        data.name);
    for (uint8_t k = 0; k < data.type.rank; ++k)
        text += k == 0 ? "{*" : ",*";
    return data.type.rank > 0 ? text + "}" : text;
}

std::string constantOf(const sema::Module& module, const sema::DataSymbol& data) {
    const auto& decl = syntax::as<syntax::DataDecl>(*data.decl);
    const rapid::SourceRange range = module.tree->range(decl);
    return std::string(module.tree->source->text().substr(range.begin, range.end - range.begin)) + "\n";
}

/// The text of a module whose routine does what the draft asks for; fills in its names.
std::string moduleText(const sema::CheckedProgram& program, const std::set<std::string>& mentioned,
                       const ExpressionScope& scope, const std::string& text, bool isOrder,
                       const std::string& resultType, std::vector<std::string>& names) {
    const sema::Module* host = findModule(*program.tasks[static_cast<std::size_t>(scope.task)], scope.module);
    const sema::RoutineSymbol* routine = scope.routine.empty() ? nullptr : findRoutine(host, scope.routine);
    std::string params = fmt::format("INOUT num {}", kError);
    if (!isOrder) params += fmt::format(", INOUT {} {}", resultType, kResult);
    std::string constants;
    bool needsConstants = false;
    names.clear();
    const auto isMentioned = [&](const sema::DataSymbol& data) {
        return mentioned.contains(rt::upperCase(data.name));
    };
    const auto add = [&](const sema::DataSymbol& data) {
        if (!isMentioned(data) || (!data.isSwitch && data.type.type == nullptr)) return;
        params += ", " + declarationOf(data);
        names.push_back(data.name);
    };
    if (routine != nullptr) {
        for (const sema::DataSymbol* data : routine->params)
            add(*data);
        for (const sema::DataSymbol* data : routine->data) {
            const bool constant = data->storage == sema::Storage::RoutineData && data->decl != nullptr &&
                                  data->dataKind == syntax::DataKind::Const;
            if (constant) constants += constantOf(*host, *data);
            needsConstants = needsConstants || (constant && isMentioned(*data));
            const bool known = std::find(names.begin(), names.end(), data->name) != names.end();
            if (!constant && !known && data->storage != sema::Storage::Parameter) add(*data);
        }
    }
    std::string out = fmt::format("MODULE {}\nLOCAL PROC {}({})\n", kModule, kRoutine, params);
    if (needsConstants) out += constants;
    if (isOrder)
        out += text + kAfterText;
    else
        out += fmt::format("{} := \n{}{};\n", kResult, text, kAfterText);
    out += fmt::format("ERROR (LONG_JMP_ALL_ERR)\n{} := ERRNO;\nSkipWarn;\nRETURN;\nENDPROC\nENDMODULE\n",
                       kError);
    return out;
}

const syntax::RoutineDecl* onlyRoutine(const sema::Module& module) {
    if (module.routines.size() != 1 || module.tree->modules.size() != 1 || !module.data.empty() ||
        !module.types.empty())
        return nullptr;
    const syntax::RoutineDecl* routine = module.routines.front()->routineDecl;
    const bool plain =
        routine != nullptr && routine->errors.size() == 1 && !routine->hasUndo && !routine->hasBackward;
    return plain ? routine : nullptr;
}

const syntax::Expr* valueOf(const syntax::RoutineDecl& routine) {
    if (routine.body.size() != 1 || routine.body.front()->kind != syntax::NodeKind::Assign) return nullptr;
    return syntax::as<syntax::AssignStmt>(*routine.body.front()).value;
}

/// The first error in the text; the names that only this file knows do not help anybody.
const diag::Diagnostic* firstError(const std::vector<diag::Diagnostic>& diagnostics,
                                   const std::string& path) {
    for (const diag::Diagnostic& diagnostic : diagnostics)
        if (diagnostic.severity == diag::Severity::Error && diagnostic.file &&
            diagnostic.file->path() == path)
            return &diagnostic;
    return nullptr;
}

std::string problemOf(const diag::Diagnostic* error) {
    return error != nullptr ? fmt::format("{} ({})", error->message, diag::codeName(error->code)) : "";
}

bool isOfSyntax(const diag::Diagnostic& diagnostic) {
    return static_cast<int>(diagnostic.code) / 1000 == 1;
}

/// Calls that an expression without consequences must not make: "" when there are none.
std::string harmfulCall(const sema::Module& module, const syntax::Node& node) {
    if (node.kind == syntax::NodeKind::Call) {
        const auto found = module.facts->calls.find(&node);
        const sema::RoutineSymbol* routine =
            found != module.facts->calls.end() ? found->second.routine : nullptr;
        const bool harmless =
            routine != nullptr && routine->predefined &&
            (routine->effects == sema::Effects::None || routine->effects == sema::Effects::Const ||
             routine->effects == sema::Effects::Pure || routine->effects == sema::Effects::Reads);
        if (!harmless) return routine != nullptr ? routine->name : "a routine";
    }
    std::string found;
    syntax::forEachChild(node, [&](const syntax::Node& child) {
        if (found.empty()) found = harmfulCall(module, child);
    });
    return found;
}

} // namespace

namespace {

/// A movement instruction in the text; "" when there is none.
std::string movement(const sema::Module& module, const syntax::Node& node) {
    if (node.kind == syntax::NodeKind::CallStmt) {
        const auto found = module.facts->calls.find(&node);
        const sema::RoutineSymbol* routine =
            found != module.facts->calls.end() ? found->second.routine : nullptr;
        if (routine != nullptr && routine->effects == sema::Effects::Motion) return routine->name;
    }
    std::string found;
    syntax::forEachChild(node, [&](const syntax::Node& child) {
        if (found.empty()) found = movement(module, child);
    });
    return found;
}

} // namespace

ExpressionCompiler::ExpressionCompiler(const Compilation& compilation, rt::Controller& controller)
    : compilation_(compilation), controller_(controller) {}

ExpressionCompiler::~ExpressionCompiler() = default;

void ExpressionCompiler::followMemory() {
    std::string memory;
    for (const rt::LoadedModule& module : controller_.tables().modules())
        memory += fmt::format("{}:{}:{}\n", module.task, module.name, static_cast<const void*>(module.unit));
    if (memory == memory_) return;
    memory_ = std::move(memory);
    session_.reset();
    for (auto& [key, made] : known_)
        if (made) former_.push_back(std::move(made));
    known_.clear();
}

/// The files of each task that are in program memory now, and one for the expressions.
void ExpressionCompiler::openSession() {
    std::vector<sema::TaskInput> tasks;
    for (std::size_t i = 0; i < compilation_.program->tasks.size(); ++i) {
        const sema::Task& checked = *compilation_.program->tasks[i];
        const auto found =
            std::find_if(compilation_.tasks.begin(), compilation_.tasks.end(),
                         [&](const sema::TaskInput& input) { return input.name == checked.name; });
        sema::TaskInput& task = tasks.emplace_back();
        task.name = checked.name;
        if (found != compilation_.tasks.end()) task = *found;
        for (const rt::LoadedModule& module : controller_.tables().modules()) {
            std::string bytes;
            if (module.unit == nullptr || module.task != static_cast<int32_t>(i)) continue;
            if (rapid::config::readFile(module.file, bytes).empty())
                task.files.push_back(std::make_shared<const rapid::SourceFile>(module.file, bytes));
        }
        task.files.push_back(std::make_shared<const rapid::SourceFile>(pathOf(i), emptyModule()));
    }
    sema::CheckOptions options = compilation_.options;
    options.configurationKnown = true; // the program runs: no signal is assumed any more
    session_ = std::make_unique<sema::Session>(options);
    session_->open(std::move(tasks));
}

/// Whether the text means something; then the type of its value is known.
bool ExpressionCompiler::check(Draft& draft, std::string& problem) {
    const auto task = static_cast<std::size_t>(draft.scope.task);
    const std::string text = moduleText(session_->program(), namesIn(draft.text), draft.scope, draft.text,
                                        draft.isOrder(), draft.resultType, draft.names);
    session_->setGuest(kModule, draft.scope.module);
    session_->change(std::make_shared<const rapid::SourceFile>(pathOf(task), text));
    const std::vector<diag::Diagnostic> diagnostics = session_->diagnostics();
    const diag::Diagnostic* error = firstError(diagnostics, pathOf(task));
    problem = problemOf(error);
    draft.isMisread = error != nullptr && isOfSyntax(*error);
    if (draft.isMisread &&
        error->range.begin >= text.rfind(kAfterText)) // finds what the user has not written
        problem = fmt::format("'{}' is not complete", draft.text);
    draft.module = findModule(*session_->program().tasks[task], kModule);
    draft.valueType = nullptr;
    const syntax::RoutineDecl* routine = draft.module != nullptr ? onlyRoutine(*draft.module) : nullptr;
    const syntax::Expr* value = routine != nullptr && !draft.isOrder() ? valueOf(*routine) : nullptr;
    if (value != nullptr) {
        const sema::DataType& type = session_->program().info(*draft.module, *value).type();
        if (type.rank == 0 && isValueType(type.type)) draft.valueType = type.type;
    }
    if (problem.empty() && (routine == nullptr || (!draft.isOrder() && value == nullptr)))
        problem = draft.isOrder() ? "expected instructions" : "expected one expression";
    return problem.empty();
}

bool ExpressionCompiler::judge(const Draft& draft, std::string& problem) const {
    if (const std::string move = movement(*draft.module, *onlyRoutine(*draft.module)); !move.empty()) {
        problem = fmt::format("'{}' moves the robot, which only the program itself can do", move);
        return false;
    }
    if (draft.kind != ExpressionKind::Harmless) return true;
    const std::string call = harmfulCall(*draft.module, *valueOf(*onlyRoutine(*draft.module)));
    if (call.empty()) return true;
    problem = fmt::format("'{}' is not called here, because it may change something", call);
    return false;
}

std::unique_ptr<CompiledExpression> ExpressionCompiler::make(const ExpressionScope& scope,
                                                             const std::string& text, ExpressionKind kind,
                                                             std::string& problem) {
    if (!session_) openSession();
    Draft draft{scope, text, kind};
    const bool fits = check(draft, problem);
    const bool otherType = draft.valueType != nullptr && !rt::sameName(draft.valueType->name, "num");
    if (otherType) {
        draft.resultType = draft.valueType->name;
        if (!check(draft, problem)) return nullptr;
    } else if (!fits) {
        if (draft.isMisread && !draft.isOrder()) {
            std::string ignored;
            const std::string instruction = text + ";"; // a second one does no harm
            Draft order{scope, instruction, ExpressionKind::Orders};
            if (check(order, ignored))
                problem = fmt::format("'{}' is an instruction: an expression is expected", text);
        }
        return nullptr;
    }
    if (!judge(draft, problem)) return nullptr;
    auto made = std::make_unique<CompiledExpression>();
    made->hasValue = !draft.isOrder();
    made->names = draft.names;
    return generate(draft, *made, problem) ? std::move(made) : nullptr;
}

bool ExpressionCompiler::generate(const Draft& draft, CompiledExpression& out, std::string& problem) {
    rapid::lower::UnitOptions unit;
    unit.program.programName = kModule;
    unit.program.nativeImplemented = [](std::string_view symbol) {
        return rt::findNativeAddress(symbol) != nullptr;
    };
    unit.program.sharedModules = compilation_.sharedModules;
    const rt::ProgramTables& tables = controller_.tables();
    unit.exists = [&](std::string_view moduleName, std::string_view name) {
        return rt::findUnitData(tables, name, moduleName, draft.scope.task) != nullptr;
    };
    ir::Module made;
    diag::Sink sink;
    if (!rapid::lower::lowerUnit(session_->program(), static_cast<uint32_t>(draft.scope.task), *draft.module,
                                 unit, sink, made) ||
        !runIrPasses(made, {.profile = ir::Profile::Release}, sink)) {
        problem = problemOf(firstError(sink.sorted(), draft.module->tree->source->path()));
        if (problem.empty()) problem = "the expression cannot be compiled";
        return false;
    }
    // Routines that it calls by name may be LOCAL in its module.
    for (ir::Routine& routine : made.routines) {
        if (routine.moduleName != kModule) continue;
        if (!draft.scope.module.empty()) routine.moduleName = draft.scope.module;
        routine.displayName = kShown;
    }
    ImportedData data;
    for (const ir::Global& global : made.globals)
        if (global.kind == ir::GlobalKind::External) {
            const bool anywhere = global.typeDesc != ir::kNone;
            data.bySymbol[global.name] = {global.displayName, anywhere ? "" : global.moduleName};
        }
    rt::UnitImage image;
    return codegen::emitImage(made, codegenOptions(false), image, problem) &&
           map(image, data, draft.scope.task, out, problem);
}

bool ExpressionCompiler::map(const rt::UnitImage& image, const ImportedData& data, int32_t task,
                             CompiledExpression& out, std::string& problem) {
    std::vector<const void*> addresses;
    for (const std::string& symbol : image.imports) {
        const auto found = data.bySymbol.find(symbol);
        const void* address = nullptr;
        if (found == data.bySymbol.end()) {
            address = rt::findNativeAddress(symbol);
            if (address == nullptr) address = ::dlsym(RTLD_DEFAULT, symbol.c_str());
        } else {
            const auto& [name, module] = found->second;
            const rt::GlobalDesc* object = rt::findUnitData(controller_.tables(), name, module, task);
            if (object == nullptr) object = rt::findUnitData(controller_.tables(), name, "", task);
            if (object != nullptr) address = object->address;
        }
        if (address == nullptr) {
            problem = fmt::format("'{}' is not available at run time",
                                  found == data.bySymbol.end() ? symbol : found->second.first);
            return false;
        }
        addresses.push_back(address);
    }
    out.image = rt::MappedImage::map(image, addresses, problem);
    if (!out.image) return false;
    const rt::ProgramDesc& program = *out.image->program();
    if (!rt::connectUnit(controller_, program)) {
        problem = "it names a signal or mechanical unit that is not configured";
        return false;
    }
    for (uint32_t i = 0; i < program.routineCount; ++i)
        if (rt::sameName(program.routines[i].name, kShown)) out.entry = &program.routines[i];
    if (out.entry == nullptr || out.entry->late == nullptr) problem = "the expression cannot be called";
    return problem.empty();
}

const CompiledExpression* ExpressionCompiler::compile(const ExpressionScope& scope, const std::string& text,
                                                      ExpressionKind kind, std::string& problem) {
    constexpr std::size_t kMostKept = 2000, kLongest = 100'000;
    if (text.size() > kLongest) {
        problem = "the text is too long";
        return nullptr;
    }
    followMemory();
    const auto key = std::make_tuple(scope.task, scope.module, scope.routine, text, kind);
    if (const auto found = known_.find(key); found != known_.end()) return found->second.get();
    if (known_.size() >= kMostKept) {
        problem = "too many expressions have been compiled; restart the program";
        return nullptr;
    }
    std::unique_ptr<CompiledExpression> made;
    problem.clear();
    onOwnStack([&] { made = make(scope, text, kind, problem); });
    return made ? known_.emplace(key, std::move(made)).first->second.get() : nullptr;
}

} // namespace rapidc::dap

// rapidc emit: shows a stage of the compiler.

#include "runtime/host/command_line.h"
#include "tools/program/native_library.h"
#include "tools/program/pipeline.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/usage.h"

#include "frontend/syntax/parser.h"
#include "ir/text/text.h"
#include "runtime/base/output_file.h"
#include "runtime/host/run_options.h"

#include <cstdio>
#include <fmt/format.h>

namespace rapidc {

namespace {

struct EmitSettings {
    Inputs inputs;
    std::string as = "ir";
    std::string output;
    bool noOptimise = false;
    bool stepping = false;
};

std::string symbolsText(const rapid::sema::CheckedProgram& program) {
    std::string out;
    for (const auto& task : program.tasks) {
        out += fmt::format("task {} {}\n", task->name, task->type);
        for (const rapid::sema::Module* module : task->modules) {
            out += fmt::format("  module {}\n", module->name);
            for (const auto* type : module->types)
                out += fmt::format("    type {}{}\n", type->name, type->isLocal ? " local" : "");
            for (const auto* data : module->data) {
                static constexpr const char* kKinds[] = {"var", "pers", "const"};
                out += fmt::format("    {} {} {}", kKinds[static_cast<int>(data->dataKind)],
                                   data->type.type->name, data->name);
                for (int k = 0; k < data->type.rank; ++k)
                    out += fmt::format("{}{}{}", k == 0 ? "{" : ",", data->type.dims[k],
                                       k + 1 == data->type.rank ? "}" : "");
                out += data->isLocal ? " local\n" : "\n";
            }
            for (const auto* routine : module->routines) {
                static constexpr const char* kKinds[] = {"proc", "func", "trap"};
                out +=
                    fmt::format("    {} {}", kKinds[static_cast<int>(routine->routineKind)], routine->name);
                for (const auto* param : routine->params)
                    out += fmt::format(" {}:{}", param->name, param->type.type->name);
                out += routine->isLocal ? " local\n" : "\n";
            }
        }
    }
    return out;
}

int write(const EmitSettings& settings, const std::string& text) {
    if (settings.output.empty()) {
        std::fwrite(text.data(), 1, text.size(), stdout);
        return 0;
    }
    const std::string problem = rt::writeWhole(settings.output, text);
    if (problem.empty()) return 0;
    return usageError("emit", problem);
}

std::string emitMachine(const EmitSettings& settings, const ir::Module& module, std::string& error) {
    const codegen::CodegenOptions options = codegenOptions(!settings.noOptimise);
    if (settings.as == "llvm") return codegen::emitLlvm(module, options, error);
    if (settings.as == "asm") return codegen::emitAsm(module, options, error);
    if (settings.output.empty())
        error = "an object file needs a name: give -o FILE.o";
    else
        codegen::emitObject(module, settings.output, options, error);
    return {};
}

/// Of modules without main everything is shown: nothing would be reachable.
std::function<bool(const rapid::sema::RoutineSymbol&)> keptRoutines(const Compilation& compilation) {
    for (const auto& task : compilation.program->tasks)
        if (task->entryRoutine) return {};
    return [](const rapid::sema::RoutineSymbol&) { return true; };
}

int emit(EmitSettings& settings) {
    const bool early = settings.as == "tokens" || settings.as == "tree";
    const auto compilation = checkInputs(settings.inputs);
    if (!compilation->usageErrors.empty()) return usageErrors("emit", compilation->usageErrors);
    if (const std::string conflict = outputConflict(*compilation, {{"-o", settings.output}});
        !conflict.empty())
        return usageError("emit", conflict);
    std::string text;
    if (early) {
        for (const auto& tree : compilation->program->trees) {
            bool user = false;
            for (const auto& task : compilation->program->tasks)
                for (const auto* module : task->modules)
                    user = user || module->tree == tree.get();
            if (!user) continue;
            text +=
                settings.as == "tree" ? rapid::syntax::printTree(*tree) : rapid::syntax::printTokens(*tree);
        }
        printDiagnostics(*compilation);
        const int written = write(settings, text);
        return compilation->sink.hasErrors() ? static_cast<int>(rt::ExitStatus::BadProgram) : written;
    }
    ir::Module module;
    const bool ok = !compilation->sink.hasErrors() &&
                    (settings.as == "symbols" || lowerToIr(*compilation, "program", settings.stepping, module,
                                                           SIZE_MAX, keptRoutines(*compilation)));
    printDiagnostics(*compilation);
    if (!ok) return static_cast<int>(rt::ExitStatus::BadProgram);
    if (settings.as == "symbols") return write(settings, symbolsText(*compilation->program));
    if (settings.as == "ir") return write(settings, ir::printModule(module));
    std::string error;
    text = emitMachine(settings, module, error);
    if (!error.empty()) {
        fmt::print(stderr, "rapidc emit: {}\n", error);
        // Only the file can be wrong with an object: the program has passed the checker.
        return static_cast<int>(settings.as == "obj" ? rt::ExitStatus::BadUsage : rt::ExitStatus::BadProgram);
    }
    return settings.as == "obj" ? 0 : write(settings, text);
}

} // namespace

void addEmitCommand(rt::CommandLine& line) {
    auto settings = std::make_shared<EmitSettings>();
    const rt::Command command =
        line.addCommand("emit", "Show a stage of the compiler", [settings] { return emit(*settings); });
    addInputArgument(command, settings->inputs);
    command.add("--as", settings->as, "tokens, tree, symbols, ir, llvm, asm or obj")
        .oneOf({"tokens", "tree", "symbols", "ir", "llvm", "asm", "obj"});
    addWarningOption(command, settings->inputs);
    addTaskOption(command, settings->inputs);
    addConfigOption(command, settings->inputs);
    addRobotOption(command, settings->inputs);
    command.add("-o,--output", settings->output, "File to write instead of the terminal");
    command.addFlag("--stepping", settings->stepping, "Show the code of the stepping profile");
    command.addFlag("--no-optimise", settings->noOptimise, "Leave out the optimiser");
}

} // namespace rapidc

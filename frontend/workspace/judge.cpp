#include "frontend/workspace/judge.h"

#include "frontend/diag/messages/lowering.h"
#include "frontend/workspace/configuration.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::workspace {

UnimplementedCalls::UnimplementedCalls(const Environment& environment) {
    for (const std::string_view name : environment.declaredOnly())
        names_.insert(name);
}

void UnimplementedCalls::file(const sema::CheckedProgram& program, std::span<sema::Module* const> modules) {
    if (!known_) findRoutines(program);
    if (std::none_of(routines_.begin(), routines_.end(), [](const auto* routine) { return routine->used; }))
        return;
    const syntax::SyntaxTree& tree = *modules.front()->tree; // they share the facts, too
    if (!seen_.insert(tree.source).second) return;
    for (const auto& [node, call] : modules.front()->facts->calls) {
        if (!call.routine || !routines_.contains(call.routine)) continue;
        Use& use = uses_[call.routine->name];
        const SourceRange range = tree.range(*node);
        if (++use.count == 1) use.file = tree.source;
        if (use.count == 1 || (use.file == tree.source && range.begin < use.first.begin)) use.first = range;
    }
}

void UnimplementedCalls::report(diag::Sink& sink) const {
    for (const auto& [name, use] : uses_) {
        const size_t more = use.count - 1;
        sink.report(diag::say::BuiltinNotImplemented, use.file, use.first,
                    {name, more == 0
                               ? std::string()
                               : fmt::format(", here and in {} more place{}", more, more == 1 ? "" : "s")});
    }
}

void UnimplementedCalls::findRoutines(const sema::CheckedProgram& program) {
    for (const sema::Module* module : program.predefinedModules)
        for (const sema::RoutineSymbol* routine : module->routines)
            if (routine->native && names_.contains(routine->name)) routines_.insert(routine);
    known_ = true;
}

Judge::Judge(const Compilation& compilation, const Environment& environment, diag::Sink& sink)
    : compilation_(compilation), sink_(sink), unimplemented_(environment),
      lint_(compilation.warningLevels, sink, compilation.tasks.size() > 1,
            compilation.warningLevels.anyLint() ? namedByConfiguration(compilation)
                                                : std::set<std::string>()) {}

void Judge::file(const sema::CheckedProgram& program, const sema::Task& task,
                 std::span<sema::Module* const> modules) {
    unimplemented_.file(program, modules);
    lint_.file(program, task, modules);
}

void Judge::files(const sema::CheckedProgram& program) {
    for (const auto& task : program.tasks) {
        const std::span<sema::Module* const> all = task->modules;
        for (size_t begin = 0, end; begin < all.size(); begin = end) {
            for (end = begin + 1; end < all.size() && all[end]->tree == all[begin]->tree;)
                ++end;
            file(program, *task, all.subspan(begin, end - begin));
        }
    }
}

void Judge::finish(const sema::CheckedProgram& program, std::span<const sema::TaskInput> tasks) {
    std::set<std::string_view> seen; // several tasks may load a file
    for (const sema::TaskInput& task : tasks)
        for (const auto& source : task.files)
            if (seen.insert(source->path()).second) lint::checkDirectives(source, sink_);
    unimplemented_.report(sink_);
    lint_.finish(program);
    lint::applyLevels(compilation_.warningLevels, sink_);
}

} // namespace rapid::workspace

#include "tools/rapidc/judge_configuration.h"

#include "runtime/io/io_system.h"
#include "runtime/sched/scheduler.h"

namespace rapidc {

using rapid::SourceFile;
using rapid::SourceRange;
using rapid::config::CfgProblem;
namespace say = rapid::diag::say;

namespace {

SourceRange lineRange(const SourceFile& file, uint32_t line) {
    if (line == 0 || line > file.lineCount()) return {};
    const uint32_t start = file.lineStart(line);
    const std::string_view text = file.lineText(line);
    const size_t first = text.find_first_not_of(" \t");
    if (first == std::string_view::npos) return {start, start};
    const size_t last = text.find_last_not_of(" \t");
    return {start + static_cast<uint32_t>(first), start + static_cast<uint32_t>(last + 1)};
}

} // namespace

void reportConfigurationProblems(rapid::diag::Sink& sink, const std::string& name, const std::string& text,
                                 std::span<const CfgProblem> problems) {
    std::shared_ptr<const SourceFile> file;
    for (const CfgProblem& problem : problems) {
        if (problem.file != name) continue;
        if (!file) file = std::make_shared<const SourceFile>(name, text);
        sink.report(problem.warning ? say::ConfigurationDoubt : say::ConfigurationProblem, file,
                    lineRange(*file, problem.line), {problem.message});
    }
}

void judgeSignals(std::vector<CfgProblem>& problems, const std::vector<std::string>& names,
                  const std::vector<std::string>& texts) {
    rt::Scheduler scheduler{rt::SchedulerOptions{}};
    rt::IoSystem io(scheduler);
    std::vector<CfgProblem> known;
    for (size_t i = 0; i < texts.size(); ++i)
        io.configure(rt::parseCfg(texts[i], names[i], known), problems);
    io.finishConfiguration(problems);
}

} // namespace rapidc

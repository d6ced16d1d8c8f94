// libFuzzer target: any bytes as a configuration file, read as such and for the tasks of a backup. Places lie within the
// file and problems stay within bounds.

#include "config/cfg_parser.h"
#include "frontend/project/system_parameters.h"
#include "fuzz_support.h"

#include <algorithm>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    using namespace rapid;
    using fuzz::require;
    const std::string bytes = fuzz::bytesOf(data, size);
    std::vector<config::CfgProblem> problems;
    const config::CfgFile file = config::parseCfg(bytes, "fuzz.cfg", problems);
    const auto isEnd = [](char c) { return c == '\n' || c == '\r'; };
    const auto lines = static_cast<size_t>(std::count_if(bytes.begin(), bytes.end(), isEnd)) + 1;
    require(problems.size() <= config::kMaxCfgProblems + 1, "too many problems");
    for (const config::CfgProblem& problem : problems)
        require(problem.line >= 1 && problem.line <= lines && !problem.message.empty(),
                "a problem without a place");
    size_t attributes = 0;
    for (const config::CfgSection& section : file.sections) {
        require(!section.type.empty(), "a section without a type");
        for (const config::CfgInstance& instance : section.instances) {
            require(instance.line >= 1 && instance.line <= lines, "an instance without a place");
            for (const config::CfgAttribute& attribute : instance.attributes)
                require(!attribute.name.empty() && instance.find(attribute.name),
                        "an attribute that is not found");
            attributes += instance.attributes.size();
        }
    }
    require(attributes <= size, "more attributes than bytes");
    for (const project::ConfiguredTask& task : project::readTaskParameters(bytes).tasks)
        require(!task.name.empty() && !task.entry.empty(), "a task without a name");
    return 0;
}

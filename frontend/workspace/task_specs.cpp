#include "frontend/workspace/task_specs.h"

#include "config/text_util.h"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fmt/format.h>

namespace rapid::workspace {

using config::sameName;
using project::TaskSpec;

namespace {

/// The task's identity is the variable NAMEId, and identifiers have at most 32 characters.
constexpr size_t kLongestName = 30;

/// An identifier as RAPID has it.
bool isTaskName(const std::string& name) {
    return !name.empty() && name.size() <= kLongestName &&
           std::isalpha(static_cast<unsigned char>(name[0])) != 0 &&
           std::all_of(name.begin(), name.end(),
                       [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
}

/// Separated by commas, unless a file has that very name.
std::vector<std::string> inputsOf(const std::string& text) {
    std::error_code ignored;
    if (std::filesystem::exists(text, ignored)) return {text};
    std::vector<std::string> inputs;
    for (size_t at = 0; at <= text.size();) {
        const size_t comma = std::min(text.find(',', at), text.size());
        inputs.push_back(text.substr(at, comma - at));
        at = comma + 1;
    }
    return inputs;
}

/// "" or what is wrong.
std::string readTaskSpec(const std::string& text, TaskSpec& spec, bool& typeTold) {
    const size_t equals = std::min(text.find('='), text.size());
    const std::string head = text.substr(0, equals);
    const size_t colon = head.find(':');
    typeTold = colon != std::string::npos;
    spec.name = head.substr(0, colon);
    spec.type = typeTold ? config::upperCase(head.substr(colon + 1)) : "NORMAL";
    spec.inputs = inputsOf(equals == text.size() ? std::string() : text.substr(equals + 1));
    const bool knownType = spec.type == "NORMAL" || spec.type == "STATIC" || spec.type == "SEMISTATIC";
    const bool emptyInput =
        std::any_of(spec.inputs.begin(), spec.inputs.end(), [](const auto& input) { return input.empty(); });
    if (spec.name.empty() || emptyInput || !knownType)
        return fmt::format("cannot read --task={}: expected NAME=INPUT, NAME:STATIC=INPUT or "
                           "NAME:SEMISTATIC=INPUT; further inputs follow after commas",
                           text);
    if (!isTaskName(spec.name))
        return fmt::format(
            "--task={}: '{}' cannot be the name of a task; expected a letter, then letters, digits or "
            "'_', at most {} characters",
            text, spec.name, kLongestName);
    return {};
}

} // namespace

std::vector<TaskSpec> readTaskSpecs(const std::vector<std::string>& options, std::set<std::string>& typesTold,
                                    std::vector<std::string>& problems) {
    std::vector<TaskSpec> specs;
    for (const std::string& text : options) {
        TaskSpec spec;
        bool typeTold = false;
        if (std::string problem = readTaskSpec(text, spec, typeTold); !problem.empty()) {
            problems.push_back(std::move(problem));
            continue;
        }
        const auto known = std::find_if(specs.begin(), specs.end(), [&](const TaskSpec& other) {
            return sameName(other.name, spec.name);
        });
        if (known == specs.end()) {
            if (typeTold) typesTold.insert(spec.name);
            specs.push_back(std::move(spec));
            continue;
        }
        const bool otherTold = typesTold.contains(known->name);
        if (typeTold && otherTold && known->type != spec.type)
            problems.push_back(fmt::format("--task={}: the task '{}' is {} already; give its type once", text,
                                           spec.name, known->type));
        if (typeTold) {
            known->type = spec.type;
            typesTold.insert(known->name);
        }
        known->inputs.insert(known->inputs.end(), spec.inputs.begin(), spec.inputs.end());
    }
    return specs;
}

} // namespace rapid::workspace

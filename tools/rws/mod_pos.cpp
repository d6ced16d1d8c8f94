#include "tools/rws/mod_pos.h"

#include "config/letter_case.h"
#include "frontend/syntax/parser.h"
#include "runtime/value/value_text.h"
#include "tools/rws/path_pattern.h"
#include "tools/service/data_path.h"
#include "tools/service/symbols.h"

#include "natives/positions.h"

#include <algorithm>
#include <fmt/format.h>
#include <vector>

namespace rapidc::rws {

namespace {

using rapid::config::sameName;

struct NamedData {
    service::DataPath path;
    service::FoundData data;
};

/// The data that are named in the range, in order, each once.
std::vector<NamedData> namedIn(service::VirtualController& controller, const rt::Task& task,
                               const std::string& module, const std::string& part) {
    rapid::diag::Sink ignored;
    const auto tree =
        rapid::syntax::parse(std::make_shared<const rapid::SourceFile>("part.modx", part), ignored);
    std::vector<NamedData> found;
    for (const rapid::syntax::Token& token : tree->tokens) {
        if (token.kind != rapid::syntax::TokenKind::Identifier) continue;
        const std::string name(tree->source->text().substr(token.offset, token.length));
        const bool isKnown = std::any_of(found.begin(), found.end(), [&](const NamedData& each) {
            return sameName(each.path.name, name);
        });
        if (isKnown) continue;
        for (const std::string& where : {module, std::string()}) {
            service::DataPath path{task.name(), where, {}, name, {}};
            service::FoundData data = findData(controller, path);
            if (data.data == nullptr) continue;
            found.push_back({std::move(path), std::move(data)});
            break;
        }
    }
    return found;
}

bool hasType(const NamedData& named, const char* type) {
    return named.data.dims.empty() && sameName(named.data.type->baseName, type);
}

/// The first data of the type; null: none.
template <class Value> Value* firstOf(const std::vector<NamedData>& named, const char* type) {
    for (const NamedData& each : named)
        if (hasType(each, type)) return static_cast<Value*>(each.data.data);
    return nullptr;
}

} // namespace

std::string modifyPositions(service::VirtualController& controller, rt::Task& task, const std::string& module,
                            const std::string& text, const TextRange& range) {
    const std::optional<std::string> part = partOf(text, range);
    if (!part) return "the range does not lie in the module";
    if (!task.isMotionTask()) return fmt::format("task {} moves no robot", task.name());
    const std::vector<NamedData> named = namedIn(controller, task, module, *part);
    auto* tool = firstOf<rt::data::Tooldata>(named, "tooldata");
    auto* object = firstOf<rt::data::Wobjdata>(named, "wobjdata");
    bool any = false;
    for (const NamedData& each : named) {
        const bool isRobtarget = hasType(each, "robtarget");
        if (!isRobtarget && !hasType(each, "jointtarget")) continue;
        rt::data::Robtarget target{};
        rt::data::Jointtarget joints{};
        const rt::Status status = isRobtarget ? rt_CRobT(&task, &target, nullptr, nullptr, tool, object)
                                              : rt_CJointT(&task, &joints, nullptr, nullptr);
        const void* value = isRobtarget ? static_cast<const void*>(&target) : &joints;
        std::string source;
        if (status != rt::kOk || !rt::valueToSource(value, *each.data.type, source))
            return fmt::format("there is no position for {}", each.path.name);
        if (each.data.isConstant) {
            const std::optional<service::SymbolInfo> symbol =
                service::Symbols(controller).find(each.path.url());
            const std::vector<std::string> names = splitPath(symbol ? symbol->url : "");
            std::string other;
            if (names.size() != 4 || !controller.moduleText(task, names[2], other))
                return fmt::format("the declaration of {} cannot be changed", each.path.name);
            const auto changed = withInitialValue(other, names[2], each.path.name, source);
            if (!changed) return fmt::format("the declaration of {} cannot be changed", each.path.name);
            return controller.setModuleText(task, names[2],
                                            *changed); // replaces the program: one constant at a time
        }
        if (const std::string problem = assign(each.data, source); !problem.empty()) return problem;
        any = true;
    }
    if (any) controller.core().scheduler().lookAtData();
    return any ? std::string() : "no robtarget or jointtarget is named there";
}

} // namespace rapidc::rws

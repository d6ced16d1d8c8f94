#include "tools/rws/instruction_catalogue.h"

#include "frontend/sema/checked.h"
#include "tools/rws/rapid_support.h"
#include "tools/rws/request_values.h"

#include <algorithm>
#include <cctype>
#include <fmt/format.h>

namespace rapidc::rws {

namespace {

namespace sema = rapid::sema;

bool isInstruction(const sema::RoutineSymbol& routine) {
    return routine.routineKind == rapid::syntax::RoutineKind::Proc;
}

/// Modules of the library that declare instructions; each is a subject.
std::vector<const sema::Module*> subjectsOf(service::VirtualController& controller) {
    std::vector<const sema::Module*> subjects;
    for (const sema::Module* module : controller.program().compilation().program->predefinedModules)
        if (std::any_of(module->routines.begin(), module->routines.end(),
                        [](const auto* routine) { return isInstruction(*routine); }))
            subjects.push_back(module);
    return subjects;
}

/// "decl_io_signals" -> "Io signals".
std::string titleOf(const std::string& module) {
    constexpr std::string_view kPrefix = "decl_";
    std::string title = module.starts_with(kPrefix) ? module.substr(kPrefix.size()) : module;
    std::replace(title.begin(), title.end(), '_', ' ');
    if (!title.empty())
        title.front() = static_cast<char>(std::toupper(static_cast<unsigned char>(title.front())));
    return title;
}

std::string parametersOf(const sema::RoutineSymbol& routine) {
    std::string text;
    for (const sema::DataSymbol* parameter : routine.params)
        text +=
            fmt::format("{}{}{}", text.empty() ? "" : " ", parameter->optional ? "\\" : "", parameter->name);
    return text;
}

} // namespace

Reply subjectsOfInstructions(service::VirtualController& controller, const Request& request) {
    if (taskOf(controller, request) == nullptr) return noTask(request);
    Document document;
    for (const sema::Module* module : subjectsOf(controller)) {
        const std::size_t number = document.entries.size() + 1;
        document.add("rap-pallet-head", fmt::format("pallet-head{}", number))
            .value("Name", titleOf(module->name))
            .value("Number", fmt::format("{}", number));
    }
    return Reply::of(std::move(document));
}

Reply instructionsOf(service::VirtualController& controller, const Request& request,
                     const std::string& number) {
    if (taskOf(controller, request) == nullptr) return noTask(request);
    const auto all = subjectsOf(controller);
    const auto subject = countIn(number);
    if (!subject || *subject < 1 || *subject > all.size())
        return Reply::refuse(ReturnCode::NotFound, "category " + number + " does not exist");
    Document document;
    for (const sema::RoutineSymbol* routine : all[*subject - 1]->routines) {
        if (!isInstruction(*routine)) continue;
        document.add("rap-pallet", fmt::format("pallet{}", document.entries.size() + 1))
            .value("Name", routine->name)
            .value("Instruction", routine->name)
            .value("Parameter", parametersOf(*routine));
    }
    return Reply::of(std::move(document));
}

void addInstructionCatalogue(Router& router, service::VirtualController& controller) {
    router.get(Dialect::V2, "/rw/rapid/tasks/{task}/pallet-head",
               [&controller](const Request& request) { return subjectsOfInstructions(controller, request); });
    router.get(Dialect::V2, "/rw/rapid/tasks/{task}/pallet/{category}",
               [&controller](const Request& request) {
                   return instructionsOf(controller, request, request.parameter("category"));
               });
}

} // namespace rapidc::rws

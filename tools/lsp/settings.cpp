#include "tools/lsp/settings.h"

#include "config/json_text.h"
#include "frontend/lint/warnings.h"

#include <fmt/format.h>

namespace lsp {

void applySettings(State& state, const Json& settings) {
    constexpr int kWarning = 2;
    state.dirty = true;
    if (!settings.is_null() && !settings.is_object())
        return state.show(kWarning, "rapidc: the settings have to be an object with the entry 'warnings'");
    std::vector<std::string> warnings;
    const Json* given = optionalField(settings, "warnings");
    if (given && !given->is_array())
        return state.show(kWarning, "rapidc: the setting 'warnings' has to be a list of options such as "
                                    "\"no-unused-variable\" or \"error=lint\"");
    for (const Json& each : given ? *given : Json::array()) {
        rapid::lint::WarningLevels levels;
        std::string problem = "expected text";
        if (each.is_string() && rapid::lint::applyOption(each.get<std::string>(), levels, problem))
            warnings.push_back(each.get<std::string>());
        else
            state.show(kWarning, fmt::format("rapidc: the setting 'warnings': {}", problem));
    }
    state.workspace.setWarnings(warnings);
}

void askForSettings(State& state) {
    const Json items = Json::array({{{"section", "rapidc"}}});
    state.request("workspace/configuration", {{"items", items}}, [](State& now, const Json* result) {
        now.settingsKnown = true;
        now.dirty = true;
        if (result && result->is_array() && !result->empty() && !result->front().is_null())
            applySettings(now, result->front());
    });
}

void configurationChanged(State& state, const Json& params) {
    const Json* settings = optionalField(params, "settings");
    if (const Json* own = settings ? optionalField(*settings, "rapidc") : nullptr)
        applySettings(state, *own);
    else if (state.can("workspace.configuration"))
        askForSettings(state);
    else if (settings && settings->is_object() && settings->contains("rapidc"))
        applySettings(state, nullptr);
}

} // namespace lsp

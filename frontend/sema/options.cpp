// Built-ins that belong to a RobotWare option, when the controller's options are known from a backup.

#include "frontend/sema/options.h"

#include "config/letter_case.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/sema/availability.h"

#include <algorithm>
#include <cctype>

namespace rapid::sema {

namespace {

/// "623-1 Multitasking" -> {"multitasking"}; the word RobotWare says nothing.
std::vector<std::string> wordsOf(std::string_view text) {
    std::vector<std::string> words(1);
    for (const char c : text) {
        if (std::isalpha(static_cast<unsigned char>(c)))
            words.back() += config::lowerLetter(c);
        else if (!words.back().empty())
            words.emplace_back();
    }
    std::erase_if(words, [](const std::string& word) { return word.empty() || word == "robotware"; });
    return words;
}

/// "Independent Axis" is sold as "610-1 Independent Axes": a letter may differ.
bool covers(std::string_view installed, std::string_view wanted) {
    const std::vector<std::string> has = wordsOf(installed);
    const std::vector<std::string> needs = wordsOf(wanted);
    return std::all_of(needs.begin(), needs.end(), [&](const std::string& need) {
        const unsigned limit = need.size() > 3 ? 1 : 0;
        return std::any_of(has.begin(), has.end(),
                           [&](const std::string& word) { return editDistance(word, need, limit) <= limit; });
    });
}

/// Options that come with another one, or are another one under the name of its release.
struct Included {
    std::string_view number; ///< of the option, as backups write it first
    std::string_view name;   ///< or its words
    std::string_view option;
};
constexpr Included kIncluded[] = {
    {"689-1", "Externally Guided Motion", "Robot Reference Interface"},
    {"604-1", "MultiMove Coordinated", "Multitasking"},
    {"604-2", "MultiMove Independent", "Multitasking"},
    {"616-1", "PC Interface", "RobotStudio Connect"},
    {"612-1", "Path Offset", "Path Corrections"},
    {"635-3", "Spot Servo", "Servo Tool Control"},
};

bool includes(std::string_view installed, std::string_view wanted) {
    return std::any_of(std::begin(kIncluded), std::end(kIncluded), [&](const Included& entry) {
        const bool numbered =
            installed.starts_with(entry.number) &&
            (installed.size() == entry.number.size() || installed[entry.number.size()] == ' ');
        return (numbered || covers(installed, entry.name)) && covers(entry.option, wanted);
    });
}

} // namespace

bool isOptionInstalled(const std::vector<std::string>& installed, std::string_view wanted) {
    constexpr std::string_view kOr = " or ";
    if (wanted == "rapidc") return true; // comes with the compiler, whatever the controller has
    for (;;) {
        const size_t end = wanted.find(kOr);
        const std::string_view one = wanted.substr(0, end);
        if (std::any_of(installed.begin(), installed.end(), [&](const std::string& option) {
                return covers(option, one) || includes(option, one);
            }))
            return true;
        if (end == std::string_view::npos) return false;
        wanted.remove_prefix(end + kOr.size());
    }
}

Availability::Availability(State& state) : CheckerPart(state) {}

void Availability::checkOption(const RoutineSymbol& routine, syntax::TokenIndex name) {
    if (routine.option.empty() || !state_.options.robotWareOptions) return;
    if (isOptionInstalled(*state_.options.robotWareOptions, routine.option)) return;
    if (!task_.reportedNames.insert(routine.nameId).second) return; // once a task
    report(say::OptionMissing, range(name), {routine.name, "'" + routine.option + "'"});
}

} // namespace rapid::sema

#include "tools/rapidc/explain_runtime.h"

#include "config/nearest.h"
#include "config/text_util.h"
#include "runtime/log/event_log.h"
#include "stdlib/native_table.h"
#include "stdlib/stdlib_text.h"

#include <algorithm>
#include <charconv>
#include <fmt/format.h>
#include <vector>

namespace rapidc {

namespace {

using rapid::config::sameName;
using rapid::config::trimmed;

struct EventRow {
    int number;
    rt::EventType type;
    std::string_view title, text;
};

constexpr EventRow kEvents[] = {
#define EVENT(name, number, type, title, text) {number, rt::EventType::type, title, text},
#include "runtime/log/event_texts.def"
#undef EVENT
};

/// Explanations of events whose text says too little, and of those that the program writes.
struct EventNote {
    int number;
    std::string_view note;
};
constexpr EventNote kNotes[] = {
    {40229,
     "An execution error reached the system error handler: no error handler handled it. The text names the "
     "error "
     "constant and the cause; the program stops at the instruction that failed. Handle it in the ERROR part "
     "of that routine, and explain the constant with `rapidc explain ERR_...`."},
    {40901, "The program continues: its error handler dealt with the error. The event is written so that it "
            "can be found "
            "later."},
    {40914,
     "WaitSyncTask, SyncMoveOn and their like need the same tasks and the same identity in every task that "
     "takes part; the text says what differs."},
    {70902,
     "RMQ instructions were used in an order or a mode that the message queue of the task does not have; the "
     "text says which."},
    {80001, "ErrWrite or ErrLog of the program wrote this event: title and text are the program's own."},
    {80002, "ErrWrite \\W of the program wrote this warning: title and text are the program's own."},
    {80003, "ErrWrite \\I of the program wrote this information: title and text are the program's own."},
};

const char* userTitle(int number) {
    return number == 80001   ? "Error of the program"
           : number == 80002 ? "Warning of the program"
                             : "Information of the program";
}

/// The whole text is one number.
int numberOf(std::string_view text) {
    int number = -1;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
    return error == std::errc() && end == text.data() + text.size() ? number : -1;
}

/// {0} and its like stand for what the log fills in.
std::string withoutPlaces(std::string_view text) {
    std::string out;
    for (size_t i = 0; i < text.size(); ++i) {
        const bool place = text[i] == '{' && i + 2 < text.size() && text[i + 2] == '}';
        out += place ? "..." : std::string(1, text[i]);
        if (place) i += 2;
    }
    return out;
}

std::string noteOf(int number) {
    for (const EventNote& note : kNotes)
        if (note.number == number) return fmt::format("\n{}\n", note.note);
    return {};
}

std::string head(int number, std::string_view title, rt::EventType type) {
    return fmt::format("event {} {} ({})\narea: {} (number {} of event domain {})\n", number, title,
                       rt::typeName(type), rt::domainName(number), number % 10'000, number / 10'000);
}

std::string unknownEvent(int number) {
    const bool user = number / 10'000 == 8;
    if (user && number >= 80001 && number <= 80003)
        return head(number, userTitle(number), static_cast<rt::EventType>(80004 - number)) + noteOf(number);
    if (number < 10'000 || number >= 130'000 || std::string_view(rt::domainName(number)) == "other")
        return {};
    return fmt::format(
        "event {}\narea: {} (number {} of event domain {})\n\nThis virtual controller writes no event of "
        "this number. {}\n",
        number, rt::domainName(number), number % 10'000, number / 10'000,
        user ? "The program can: ErrLog with its own number, or ErrWrite."
             : "A controller may: its manual (Operating manual - Trouble shooting) lists them by number.");
}

std::string_view lineOf(std::string_view& rest) {
    const size_t end = std::min(rest.find('\n'), rest.size());
    const std::string_view line = rest.substr(0, end);
    rest.remove_prefix(std::min(end + 1, rest.size()));
    return trimmed(line);
}

bool hasWord(std::string_view list, std::string_view word) {
    for (size_t at = list.find(word); at != std::string_view::npos; at = list.find(word, at + 1)) {
        const auto isLetter = [](char c) {
            return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
        };
        const size_t end = at + word.size();
        if ((at == 0 || !isLetter(list[at - 1])) && (end == list.size() || !isLetter(list[end]))) return true;
    }
    return false;
}

/// "PROC MoveL(...": MoveL; "FUNC num Sqrt(...": Sqrt.
std::string declaredName(std::string_view line) {
    const size_t paren = line.find('(');
    const bool declares = line.starts_with("PROC ") || line.starts_with("FUNC ");
    if (!declares || paren == std::string_view::npos) return {};
    const std::string_view before = trimmed(line.substr(0, paren));
    return std::string(before.substr(before.rfind(' ') + 1));
}

/// The instructions and functions whose declarations name the error, in the order of the library.
std::vector<std::string> raisersOf(std::string_view error) {
    std::vector<std::string> raisers;
    for (const rapid::stdlib::StdlibSource& source : rapid::stdlib::sources()) {
        bool raises = false;
        for (std::string_view rest = source.text; !rest.empty();) {
            const std::string_view line = lineOf(rest);
            const bool comment = line.starts_with("!");
            if (comment && line.find("raises:") != std::string_view::npos && hasWord(line, error))
                raises = true;
            if (comment) continue;
            if (const std::string name = declaredName(line); raises && !name.empty()) raisers.push_back(name);
            raises = false;
        }
    }
    return raisers;
}

std::string describe(const rt::ErrorEntry& entry) {
    std::string out = fmt::format("{} (error constant, ERRNO {})\n", entry.name, entry.number);
    if (entry.summary[0] != '\0') out += fmt::format("meaning: {}\n", entry.summary);
    std::vector<std::string> raisers = raisersOf(entry.name);
    constexpr size_t kShown = 30;
    const size_t more = raisers.size() > kShown ? raisers.size() - kShown : 0;
    raisers.resize(raisers.size() - more);
    if (!raisers.empty())
        out += fmt::format("raised by: {}{}\n", fmt::join(raisers, ", "),
                           more == 0 ? "" : fmt::format(" and {} more", more));
    out += fmt::format(
        "\nhandle it in the routine that can fail:\n    ERROR\n      IF ERRNO = {} THEN\n        ...\n      "
        "ENDIF\n",
        entry.name);
    return out;
}

} // namespace

std::string explainEvent(std::string_view text) {
    constexpr std::string_view kWord = "event";
    if (text.size() > kWord.size() && sameName(text.substr(0, kWord.size()), kWord))
        text = trimmed(text.substr(kWord.size()));
    const int number = numberOf(text);
    if (number < 10'000) return {};
    for (const EventRow& row : kEvents)
        if (row.number == number)
            return head(number, row.title, row.type) + fmt::format("text: {}\n", withoutPlaces(row.text)) +
                   noteOf(number);
    return unknownEvent(number);
}

std::string explainError(std::string_view text) {
    const int number = numberOf(text);
    for (const rt::ErrorEntry& entry : rt::errorTable())
        if (sameName(entry.name, text) || (number > 0 && entry.number == number)) return describe(entry);
    return {};
}

std::string nearestError(std::string_view text) {
    if (text.size() < 4 || !sameName(text.substr(0, 4), "ERR_")) return {};
    std::vector<std::string> names;
    for (const rt::ErrorEntry& entry : rt::errorTable())
        names.emplace_back(entry.name);
    std::vector<std::string> near = rapid::config::nearestNames(text, names);
    if (near.empty()) return {};
    near.resize(std::min<size_t>(near.size(), 3));
    return fmt::format("; did you mean {}?", fmt::join(near, " or "));
}

} // namespace rapidc

// The rules of declarations that the grammar and the tables do not need: documentation, attributes, errors.

#include "stdlib/gen/model.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <set>
#include <sstream>

namespace stdlibgen {

namespace {

using rapid::config::lowerCase;

/// The `!!` lines of a routine, by tag.
struct Documented {
    std::vector<std::string> params, errors;
    std::string result; ///< empty: no text after @return
};

/// Lower case and without the full stop, to compare texts.
std::string bare(std::string text) {
    text = lowerCase(text);
    if (text.ends_with('.')) text.pop_back();
    return text;
}

std::string summaryOf(const Doc& doc) {
    return doc.text.substr(0, doc.text.find('\n'));
}

Documented documentedIn(const Doc& doc) {
    Documented out;
    std::istringstream lines(doc.text);
    for (std::string line; std::getline(lines, line);) {
        const auto [tag, text] = splitFirstWord(line);
        const auto [name, meaning] = splitFirstWord(text);
        if (tag == "@param" && !meaning.empty()) out.params.push_back(name);
        if (tag == "@error") out.errors.push_back(name);
        if (tag == "@return" && out.result.empty()) out.result = bare(text);
    }
    return out;
}

class Rules {
  public:
    explicit Rules(const Model& model) : model_(model) {}

    std::vector<std::string> check() {
        for (const Datum& datum : model_.data)
            checkDatum(datum);
        for (const TypeInfo& type : model_.types)
            if (!type.place.file.empty()) checkSummary(type.place, type.name, "type", type.doc);
        for (const Routine& routine : model_.routines)
            checkRoutine(routine);
        return std::move(problems_);
    }

  private:
    void fail(const Place& at, std::string_view name, std::string_view text) {
        problems_.push_back(fmt::format("{}:{}: '{}': {}", at.file, at.line, name, text));
    }

    /// A summary of its own, in words: not empty, not copied from another name of the kind.
    void checkSummary(const Place& at, const std::string& name, const std::string& kind, const Doc& doc) {
        const std::string line = summaryOf(doc);
        if (line.empty() || line.starts_with('@')) {
            fail(at, name, "has no summary: write a line that starts with !! above it, before every @ line");
            return;
        }
        constexpr long kFewestWords = 3;
        if (kind != "datum" && std::count(line.begin(), line.end(), ' ') + 1 < kFewestWords)
            fail(at, name, "the summary says too little: write at least 3 words");
        const auto [other, fresh] = summaries_.try_emplace({kind, bare(line)}, name);
        if (!fresh) fail(at, name, fmt::format("has the same summary as '{}'", other->second));
    }

    void checkDatum(const Datum& datum) {
        checkSummary(datum.place, datum.name, "datum", datum.doc);
        if (datum.kind != "CONST") return;
        if (datum.initText.empty())
            fail(datum.place, datum.name, "is a constant without a value: add ':= value'");
        if (lowerCase(datum.type) != "errnum") return;
        errors_.insert(lowerCase(datum.name));
        constexpr double kLastOfPrograms = 90;
        if (!datum.number) return;
        if (*datum.number >= 1 && *datum.number <= kLastOfPrograms)
            fail(datum.place, datum.name, "has an error number of programs (1 to 90): take a free one above");
        const auto [other, fresh] = numbers_.try_emplace(*datum.number, datum.name);
        if (!fresh) fail(datum.place, datum.name, fmt::format("has the error number of '{}'", other->second));
    }

    void checkRoutine(const Routine& routine) {
        checkSummary(routine.place, routine.name, "routine", routine.doc);
        for (const char* key : {"manual", "effects", "confidence"})
            if (routine.doc.get(key).empty())
                fail(routine.place, routine.name,
                     fmt::format("lacks '!@ {}:' (frontend/sema/builtin_words.def)", key));
        const Documented documented = documentedIn(routine.doc);
        checkParams(routine, documented);
        if (!routine.returnType.empty() && documented.result.empty())
            fail(routine.place, routine.name, "lacks '!! @return' with what it returns");
        if (!documented.result.empty() && documented.result == bare(summaryOf(routine.doc)))
            fail(routine.place, routine.name, "'@return' repeats the summary");
        checkErrors(routine, documented);
    }

    void checkParams(const Routine& routine, const Documented& documented) {
        std::set<std::string> names, lower;
        for (const Param& param : routine.params) {
            names.insert(param.name);
            if (!lower.insert(lowerCase(param.name)).second)
                fail(routine.place, routine.name, fmt::format("has two parameters '{}'", param.name));
            if (std::find(documented.params.begin(), documented.params.end(), param.name) ==
                documented.params.end())
                fail(routine.place, routine.name,
                     fmt::format("lacks '!! @param {}' with what it is", param.name));
        }
        for (const std::string& name : documented.params)
            if (!names.contains(name))
                fail(routine.place, routine.name, fmt::format("'@param {}' names no parameter of it", name));
        if (const std::string deferred = routine.doc.get("deferred");
            !deferred.empty() && !names.contains(deferred))
            fail(routine.place, routine.name,
                 fmt::format("deferred: '{}' is not a parameter of it", deferred));
    }

    void checkErrors(const Routine& routine, const Documented& documented) {
        std::set<std::string> raised;
        std::string list = routine.doc.get("raises");
        std::replace(list.begin(), list.end(), ',', ' ');
        std::istringstream words(list);
        for (std::string name; words >> name;) {
            raised.insert(name);
            if (!errors_.contains(lowerCase(name)))
                fail(routine.place, routine.name,
                     fmt::format("raises: '{}' is not a constant of type errnum in stdlib/data", name));
        }
        if (!raised.empty() && routine.doc.get("effects") == "const")
            fail(routine.place, routine.name,
                 "raises an error, which 'effects: const' excludes: write 'effects: pure'");
        const std::set<std::string> described(documented.errors.begin(), documented.errors.end());
        if (raised != described)
            fail(routine.place, routine.name,
                 fmt::format("'!@ raises:' lists ({}), the lines '!! @error' describe ({}): make them equal",
                             fmt::join(raised, ", "), fmt::join(described, ", ")));
    }

    const Model& model_;
    std::vector<std::string> problems_;
    std::map<std::pair<std::string, std::string>, std::string> summaries_; ///< kind and text -> first name
    std::set<std::string> errors_;
    std::map<double, std::string> numbers_; ///< of errors
};

} // namespace

std::vector<std::string> brokenRules(const Model& model) {
    return Rules(model).check();
}

} // namespace stdlibgen

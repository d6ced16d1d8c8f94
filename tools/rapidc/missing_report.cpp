#include "tools/rapidc/missing_report.h"

#include "config/json_text.h"
#include "frontend/diag/messages/calls.h"
#include "frontend/diag/messages/names.h"
#include "frontend/diag/messages/projects.h"
#include "frontend/sema/names.h"
#include "frontend/sema/options.h"
#include "stdlib/native_table.h"

#include <fmt/format.h>

#include <algorithm>
#include <filesystem>
#include <map>
#include <set>
#include <unordered_map>
#include <unordered_set>

namespace rapidc {

namespace {

namespace diag = rapid::diag;
namespace sema = rapid::sema;
using diag::Code;
namespace say = diag::say;
using Json = nlohmann::ordered_json;

struct Place {
    std::string file;
    rapid::LineColumn at;
    auto operator<=>(const Place& other) const {
        return std::tie(file, at.line, at.column) <=> std::tie(other.file, other.at.line, other.at.column);
    }
    bool operator==(const Place& other) const { return (*this <=> other) == 0; }
};

struct MissingRow {
    std::string detail;
    std::set<std::string> parts; ///< built-ins that need the option
    std::set<Place> places;
};

/// By kind, then name.
using Table = std::map<std::pair<std::string, std::string>, MissingRow>;

/// The missing thing that a diagnostic reports; an empty kind: nothing.
struct Finding {
    std::string_view kind, detail;
    bool isName = false; ///< it is in the source: all of its places are reported
};

Finding findingOf(Code code) {
    switch (code) {
    case say::MayBeDeclared.code: return {"name", "", true};
    case say::UnknownName.code: return {"name", "nothing declares this data", true};
    case say::UnknownType.code: return {"name", "nothing declares this data type", true};
    case say::UnknownProcedure.code: return {"name", "nothing declares this procedure", true};
    case say::UnknownFunction.code: return {"name", "nothing declares this function", true};
    case say::UnknownTrap.code: return {"name", "nothing declares this trap routine", true};
    case say::SignalUnknown.code: return {"signal", "no configuration is given", true};
    case say::SignalUndefined.code: return {"signal", "the configuration does not define it", true};
    case say::MechanicalUnitUnknown.code:
        return {"unit", "the configuration has no such mechanical unit", true};
    case say::EncryptedModule.code: return {"module", "encrypted"};
    case say::ModuleNotSaved.code:
    case say::ListedModuleMissing.code:
    case say::ProgramModuleMissing.code: return {"module", "the file is not there"};
    case say::SystemModuleNotSaved.code: return {"module", "part of RobotWare"};
    case say::TaskWithoutFolder.code: return {"task", "it has no modules"};
    case say::RobotUnknown.code: return {"robot", "the model is not known here"};
    default: return {};
    }
}

/// The name that a diagnostic is about.
std::string nameIn(const diag::Diagnostic& d) {
    const std::string& given = d.args[d.code == say::ProgramModuleMissing.code ? 1 : 0];
    const size_t open = given.find('\''); // "signal 'doGrip'"
    return open == std::string::npos ? given : given.substr(open + 1, given.rfind('\'') - open - 1);
}

class MissingReport {
  public:
    explicit MissingReport(const Compilation& compilation) : compilation_(compilation) {
        for (const diag::Diagnostic& d : compilation.sink.all())
            fromDiagnostic(d);
        findBuiltins();
        findPlaces();
    }

    const Table& table() const { return table_; }

  private:
    void fromDiagnostic(const diag::Diagnostic& d) {
        const Finding finding = findingOf(d.code);
        if (finding.kind.empty()) return;
        std::string name = nameIn(d);
        if (d.code == say::ListedModuleMissing.code || finding.kind == "module")
            name = std::filesystem::path(name).filename().string();
        MissingRow& row = table_[{std::string(finding.kind), name}];
        if (row.detail.empty()) row.detail = finding.detail;
        if (d.code == say::MayBeDeclared.code) row.detail = d.args[1] + d.args[2];
        if (finding.isName) names_[sema::foldName(name)].push_back(&row);
    }

    void findBuiltins() {
        std::unordered_set<std::string_view> declaredOnly;
        for (const rt::NativeEntry& entry : rt::nativeTable())
            if (!entry.isImplemented()) declaredOnly.insert(entry.name);
        for (const auto& task : compilation_.program->tasks)
            for (const sema::Module* module : task->modules)
                for (const auto& [node, call] : module->facts->calls) {
                    const sema::RoutineSymbol* routine = call.routine;
                    if (!routine || !routine->predefined || call.module != module) continue;
                    const Place place = placeOf(*module->tree, module->tree->range(*node).begin);
                    if (routine->native && declaredOnly.contains(routine->name)) {
                        MissingRow& row = table_[{"built-in", routine->name}];
                        row.detail = "not implemented: the program stops when it calls it";
                        row.places.insert(place);
                    }
                    if (!routine->option.empty()) needOption(*routine, place);
                }
    }

    void needOption(const sema::RoutineSymbol& routine, const Place& place) {
        const auto& installed = compilation_.options.robotWareOptions;
        if (installed && sema::isOptionInstalled(*installed, routine.option)) return;
        MissingRow& row = table_[{"option", routine.option}];
        row.detail =
            installed ? "the controller does not have it" : "whether the controller has it is not known";
        row.parts.insert(routine.name);
        row.places.insert(place);
    }

    static Place placeOf(const rapid::syntax::SyntaxTree& tree, uint32_t offset) {
        return {tree.source->path(), tree.source->lineColumn(offset)};
    }

    /// The places of names that are reported once only.
    void findPlaces() {
        std::unordered_set<const rapid::syntax::SyntaxTree*> seen;
        for (const auto& tree : compilation_.program->trees) {
            if (!isOwn(*tree)) continue;
            for (const rapid::syntax::Token& token : tree->tokens) {
                if (token.kind != rapid::syntax::TokenKind::Identifier) continue;
                const auto found =
                    names_.find(sema::foldName(tree->source->text().substr(token.offset, token.length)));
                if (found == names_.end()) continue;
                for (MissingRow* row : found->second)
                    row->places.insert(placeOf(*tree, token.offset));
            }
        }
    }

    bool isOwn(const rapid::syntax::SyntaxTree& tree) {
        if (own_.empty())
            for (const sema::TaskInput& task : compilation_.tasks)
                for (const auto& file : task.files)
                    own_.insert(file.get());
        return own_.contains(tree.source.get());
    }

    const Compilation& compilation_;
    Table table_;
    std::unordered_map<std::string, std::vector<MissingRow*>> names_; ///< in lower case
    std::unordered_set<const rapid::SourceFile*> own_;
};

std::string detailOf(const MissingRow& row) {
    if (row.parts.empty()) return row.detail;
    return fmt::format("{}; needed by {}", row.detail, fmt::join(row.parts, ", "));
}

std::string placesOf(const MissingRow& row, const std::string& root) {
    if (row.places.empty()) return "-";
    const Place& first = *row.places.begin();
    const bool below = !root.empty() && first.file.starts_with(root);
    std::string text = fmt::format("{}:{}", first.file.substr(below ? root.size() : 0), first.at.line);
    if (row.places.size() > 1) text += fmt::format(" and {} more", row.places.size() - 1);
    return text;
}

} // namespace

std::string missingTable(const Compilation& compilation, const std::string& root) {
    const MissingReport report(compilation);
    if (report.table().empty()) return "nothing is missing\n";
    constexpr std::array<std::string_view, 4> kTitles = {"KIND", "NAME", "WHERE", "WHY"};
    std::vector<std::array<std::string, 4>> lines;
    std::array<size_t, 4> widths{};
    const auto add = [&](std::array<std::string, 4> line) {
        for (size_t i = 0; i < line.size(); ++i)
            widths[i] = std::max(widths[i], line[i].size());
        lines.push_back(std::move(line));
    };
    add({std::string(kTitles[0]), std::string(kTitles[1]), std::string(kTitles[2]), std::string(kTitles[3])});
    for (const auto& [key, row] : report.table())
        add({key.first, key.second, placesOf(row, root), detailOf(row)});
    std::string text;
    for (const auto& line : lines)
        text += fmt::format("{:<{}}  {:<{}}  {:<{}}  {}\n", line[0], widths[0], line[1], widths[1], line[2],
                            widths[2], line[3]);
    return text;
}

std::string missingJson(const Compilation& compilation) {
    const MissingReport report(compilation);
    Json rows = Json::array();
    for (const auto& [key, row] : report.table()) {
        Json places = Json::array();
        for (const Place& place : row.places)
            places.push_back({{"file", place.file}, {"line", place.at.line}, {"column", place.at.column}});
        Json item = {{"kind", key.first}, {"name", key.second}, {"detail", row.detail}};
        if (!row.parts.empty()) item["neededBy"] = row.parts;
        item["count"] = row.places.size();
        item["places"] = std::move(places);
        rows.push_back(std::move(item));
    }
    const Json json = {{"missing", std::move(rows)}};
    return rapid::config::textOf(json, 2) + "\n"; // a path need not be UTF-8
}

} // namespace rapidc

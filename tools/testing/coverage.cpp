#include "tools/testing/coverage.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <tuple>

namespace testing {
namespace {

/// The same routine in several tasks: a row of the program each, but one in the file.
using RoutineKey = std::tuple<std::string, uint32_t, std::string>;

} // namespace

double percent(uint32_t part, uint32_t whole) {
    return whole == 0 ? 100.0 : 100.0 * part / whole;
}

Coverage::Coverage(const rt::ProgramDesc& program,
                   const std::function<bool(const rt::RoutineDesc&)>& isCounted) {
    std::set<const rt::RoutineDesc*> seen;
    for (uint32_t i = 0; i < program.routineCount; ++i) {
        const rt::RoutineDesc* routine = program.routines[i].desc;
        Row& row = rows_.emplace_back();
        if (routine == nullptr || routine->isBuiltin != 0 || routine->file == nullptr ||
            *routine->file == '\0')
            continue;
        if (!seen.insert(routine).second || !isCounted(*routine)) continue;
        row.routine = routine;
        row.counts.resize(routine->statementCount);
    }
}

void Coverage::add(const TestResult& result) {
    for (const auto& [place, count] : result.executed) {
        if (place.first >= rows_.size() || place.second >= rows_[place.first].counts.size()) continue;
        rows_[place.first].counts[place.second] += count;
    }
}

std::vector<CoveredFile> Coverage::files() const {
    std::map<RoutineKey, std::vector<std::pair<const rt::StmtDesc*, uint64_t>>> routines;
    for (const Row& row : rows_) {
        if (row.routine == nullptr) continue;
        auto& statements = routines[{row.routine->file, row.routine->line, row.routine->name}];
        statements.resize(std::max<std::size_t>(statements.size(), row.counts.size()));
        for (std::size_t s = 0; s < row.counts.size(); ++s) {
            statements[s].first = &row.routine->statements[s];
            statements[s].second += row.counts[s];
        }
    }
    std::vector<CoveredFile> files;
    for (const auto& [key, statements] : routines) {
        const auto& [path, line, name] = key;
        if (files.empty() || files.back().path != path) files.emplace_back().path = path;
        CoveredFile& file = files.back();
        CoveredRoutine routine{name, line, 0, 0, 0};
        for (const auto& [statement, count] : statements) {
            if (statement->line == 0 || statement->canStart == rt::kCannotStart) continue;
            if (routine.statements++ == 0) routine.calls = count;
            routine.executed += count > 0 ? 1 : 0;
            uint64_t& most = file.lines[statement->line];
            most = std::max(most, count);
        }
        file.statements += routine.statements;
        file.executed += routine.executed;
        if (routine.statements > 0) file.routines.push_back(std::move(routine));
    }
    std::erase_if(files, [](const CoveredFile& file) { return file.statements == 0; });
    return files;
}

std::string lcovText(const std::vector<CoveredFile>& files) {
    std::string text = "TN:rapidc\n";
    for (const CoveredFile& file : files) {
        text += "SF:" + file.path + "\n";
        for (const CoveredRoutine& routine : file.routines)
            text += fmt::format("FN:{},{}\n", routine.line, routine.name);
        std::size_t called = 0;
        for (const CoveredRoutine& routine : file.routines) {
            text += fmt::format("FNDA:{},{}\n", routine.calls, routine.name);
            called += routine.calls > 0 ? 1 : 0;
        }
        text += fmt::format("FNF:{}\nFNH:{}\n", file.routines.size(), called);
        std::size_t hit = 0;
        for (const auto& [line, count] : file.lines) {
            text += fmt::format("DA:{},{}\n", line, count);
            hit += count > 0 ? 1 : 0;
        }
        text += fmt::format("LF:{}\nLH:{}\nend_of_record\n", file.lines.size(), hit);
    }
    return text;
}

std::string coverageSummary(const std::vector<CoveredFile>& files) {
    uint32_t statements = 0, executed = 0;
    for (const CoveredFile& file : files) {
        statements += file.statements;
        executed += file.executed;
    }
    std::string text = fmt::format("covered {} of {} statements ({:.1f} %)\n", executed, statements,
                                   percent(executed, statements));
    for (const CoveredFile& file : files)
        text += fmt::format("  {:>5.1f} %  {}\n", percent(file.executed, file.statements), file.path);
    return text;
}

} // namespace testing

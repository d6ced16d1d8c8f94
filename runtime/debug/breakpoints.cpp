#include "runtime/debug/breakpoints.h"

#include "runtime/base/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace rt {
namespace {

std::string_view fileName(std::string_view path) {
    return path.substr(path.find_last_of('/') + 1);
}

std::size_t callDepthOf(const Frame* frame) {
    std::size_t depth = 0;
    for (; frame != nullptr; frame = frame->caller)
        ++depth;
    return depth;
}

int32_t firstStatement(const RoutineDesc& routine) {
    for (uint32_t s = 0; s < routine.statementCount; ++s)
        if (routine.statements[s].canStart != 0) return static_cast<int32_t>(s);
    return -1;
}

} // namespace

bool isPlace(const RoutineDesc& routine, std::string_view where) {
    const std::string_view file = routine.file != nullptr ? routine.file : "";
    if (sameName(routine.module, where) || sameName(file, where) || sameName(fileName(file), where))
        return true;
    const std::string_view name = fileName(file);
    return sameName(name.substr(0, name.find_last_of('.')), where);
}

Breakpoint Breakpoints::addLine(std::string_view where, uint32_t line) {
    std::string place(where);
    return addLine(place, line, [place](const RoutineDesc& routine) { return isPlace(routine, place); }, {});
}

Breakpoint Breakpoints::addLine(std::string where, uint32_t line,
                                std::function<bool(const RoutineDesc&)> covers, BreakCondition accepts) {
    Breakpoint& made = all_.emplace_back();
    made.id = ++lastId_;
    made.file = std::move(where);
    made.line = std::max(line, 1U); // 0 is that of breakpoints at routines
    made.covers = std::move(covers);
    made.accepts = std::move(accepts);
    find(made);
    marks_.clear();
    return made;
}

Breakpoint Breakpoints::addRoutine(std::string name, BreakCondition accepts) {
    Breakpoint& made = all_.emplace_back();
    made.id = ++lastId_;
    made.file = std::move(name);
    made.accepts = std::move(accepts);
    made.covers = [name = made.file](const RoutineDesc& routine) {
        const std::size_t colon = name.find(':');
        if (colon == std::string::npos) return sameName(routine.name, trimmed(name));
        const std::string_view text = name;
        return sameName(routine.module, trimmed(text.substr(0, colon))) &&
               sameName(routine.name, trimmed(text.substr(colon + 1)));
    };
    find(made);
    marks_.clear();
    return made;
}

int Breakpoints::addData(std::string name, std::function<std::string()> read, BreakCondition accepts) {
    DataWatch& made = watches_.emplace_back();
    made.id = ++lastId_;
    made.name = std::move(name);
    made.last = read();
    made.read = std::move(read);
    made.accepts = std::move(accepts);
    return made.id;
}

bool Breakpoints::remove(int id) {
    marks_.clear();
    const bool data = std::erase_if(watches_, [id](const DataWatch& watch) { return watch.id == id; }) > 0;
    return std::erase_if(all_, [id](const Breakpoint& b) { return b.id == id; }) > 0 || data;
}

namespace {

void takeNearest(Breakpoint& breakpoint, const RoutineDesc& routine) {
    for (uint32_t s = 0; s < routine.statementCount; ++s) {
        const StmtDesc& statement = routine.statements[s];
        if (statement.canStart == 0 || statement.line < breakpoint.line) continue;
        if (breakpoint.actualLine != 0 && statement.line >= breakpoint.actualLine) continue;
        breakpoint.actualLine = statement.line;
        breakpoint.routine = &routine;
    }
}

void takeFirst(Breakpoint& breakpoint, const RoutineDesc& routine) {
    const int32_t first = firstStatement(routine);
    if (first < 0 || breakpoint.routine != nullptr) return;
    breakpoint.routine = &routine;
    breakpoint.actualLine = routine.statements[first].line;
}

} // namespace

/// The nearest statement at or below the line that can be stopped at; without a line, the first one of the routine.
void Breakpoints::find(Breakpoint& breakpoint) const {
    breakpoint.actualLine = 0;
    breakpoint.routine = nullptr;
    breakpoint.waits = true;
    for (const RoutineEntry* entry : host_.tables().routines()) {
        const RoutineDesc& routine = *entry->desc;
        if (!breakpoint.covers(routine)) continue;
        breakpoint.waits = false;
        if (breakpoint.line == 0)
            takeFirst(breakpoint, routine);
        else
            takeNearest(breakpoint, routine);
    }
}

void Breakpoints::memoryChanged() {
    marks_.clear();
    for (Breakpoint& breakpoint : all_) {
        const std::pair before(breakpoint.actualLine, breakpoint.waits);
        find(breakpoint);
        if (changed_ && before != std::pair(breakpoint.actualLine, breakpoint.waits)) changed_(breakpoint);
    }
}

/// The statements of the routine that it stops at: of several in a line the first one.
std::vector<int> Breakpoints::stopsAt(const Breakpoint& breakpoint, const RoutineDesc& routine) const {
    if (breakpoint.actualLine == 0 || !breakpoint.covers(routine)) return {};
    if (breakpoint.line == 0) return {firstStatement(routine)};
    for (uint32_t s = 0; s < routine.statementCount; ++s) {
        const StmtDesc& statement = routine.statements[s];
        if (statement.canStart != 0 && statement.line == breakpoint.actualLine) return {static_cast<int>(s)};
    }
    return {};
}

/// The task has come into the routine of `at` since it executed a statement last.
bool Breakpoints::entered(const Task& task, const Frame* at) {
    Latest& latest = latest_[&task];
    const Latest now{at, callDepthOf(at)};
    const Latest before = std::exchange(latest, now);
    return now.depth > before.depth || (now.depth == before.depth && now.frame != before.frame);
}

bool Breakpoints::stops(Task& task, Frame* at) {
    if (all_.empty()) return false;
    const auto isRoutine = [](const Breakpoint& b) { return b.line == 0; };
    const bool isNew = std::any_of(all_.begin(), all_.end(), isRoutine) && entered(task, at);
    auto [found, made] = marks_.try_emplace(at->routine);
    auto& marks = found->second;
    if (made)
        for (const Breakpoint& breakpoint : all_)
            for (const int statement : stopsAt(breakpoint, *at->routine))
                marks[statement].push_back(breakpoint.id);
    const auto here = marks.find(at->statement);
    if (here == marks.end()) return false;
    std::vector<int> hits;
    bool routine = true;
    const std::vector<int> ids = here->second; // a condition may change the program memory
    for (const int id : ids) {
        const auto same = [id](const Breakpoint& b) { return b.id == id; };
        const auto breakpoint = std::find_if(all_.begin(), all_.end(), same);
        if (breakpoint == all_.end() || (breakpoint->line == 0 && !isNew)) continue;
        const bool atRoutine = breakpoint->line == 0;
        const BreakCondition accepts = breakpoint->accepts;
        if (accepts && !accepts(task, at)) continue;
        hits.push_back(id);
        routine = routine && atRoutine;
    }
    if (hits.empty()) return false;
    hits_ = std::move(hits);
    hitRoutine_ = routine;
    return true;
}

bool Breakpoints::stopsBackward(const Frame& at) {
    std::vector<int> hits;
    for (const Breakpoint& breakpoint : all_) {
        if (breakpoint.accepts) continue;
        const std::vector<int> here = stopsAt(breakpoint, *at.routine);
        if (std::find(here.begin(), here.end(), at.statement) != here.end()) hits.push_back(breakpoint.id);
    }
    if (hits.empty()) return false;
    hits_ = std::move(hits);
    return true;
}

bool Breakpoints::dataStops(Task& task, Frame* at) {
    if (watches_.empty()) return false;
    std::vector<DataWatch> changed; // copies: a condition that waits lets clients change the list
    for (DataWatch& watch : watches_) {
        std::string value = watch.read();
        if (value == watch.last) continue;
        watch.last = std::move(value);
        changed.push_back(watch);
    }
    std::vector<int> hits;
    for (const DataWatch& watch : changed) {
        if (watch.accepts && !watch.accepts(task, at)) continue;
        hits.push_back(watch.id);
        change_ = fmt::format("{} has changed", watch.name);
    }
    if (hits.empty()) return false;
    hits_ = std::move(hits);
    hitRoutine_ = false;
    return true;
}

} // namespace rt

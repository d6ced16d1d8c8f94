#include "frontend/sema/session.h"

#include "frontend/diag/messages/projects.h"
#include "frontend/sema/analyzer.h"
#include "frontend/syntax/parser.h"

#include <algorithm>
#include <map>
#include <optional>

namespace rapid::sema {

namespace {

using Diagnostics = std::vector<diag::Diagnostic>;

/// A file of a task with what was said about it.
struct SessionFile {
    std::shared_ptr<const SourceFile> source;
    Diagnostics parsed;
    Diagnostics checked;
};

struct SessionTask {
    TaskInput input;
    TaskContext scope;
    std::vector<SessionFile> files; ///< as in `scope`
    Diagnostics whole;              ///< about no file, or known only when all files are checked
};

bool pointsInto(const Diagnostics& diagnostics, const std::shared_ptr<const SourceFile>& file) {
    return std::any_of(diagnostics.begin(), diagnostics.end(), [&](const diag::Diagnostic& d) {
        return std::any_of(d.notes.begin(), d.notes.end(),
                           [&](const auto& note) { return note.file == file; });
    });
}

/// How a changed file is checked.
struct CheckPlan {
    bool isMade = false;
    bool alone = true;    ///< others need not be checked because of its declarations
    bool isNamed = false; ///< in a message about another file
    std::vector<size_t> dirty;
    std::optional<FileOffer> offer; ///< before the change, while files that are `open` might be left alone
    Analyzer::Likeness likeness = Analyzer::Likeness::WithLocals;
    std::vector<Symbol*> held; ///< see Analyzer::holdUses
};

/// A file of a task.
struct FilePlace {
    size_t task = 0, file = 0;
};

/// A change whose check is not finished.
struct Sketched {
    FilePlace place;
    CheckPlan plan;
    std::vector<FilePlace> others; ///< the same file in further tasks, which have the text of before
    bool isLarge = false;          ///< the check that is left takes longer than the pause between two letters
};

} // namespace

struct Session::State {
    explicit State(const CheckOptions& given)
        : options(given), library(given.library.begin(), given.library.end()) {
        options.library = library;
        options.requireMain = false;
        options.onFile = nullptr;
        options.onlyDiagnostics = false;
    }

    CheckOptions options;
    std::vector<LibraryText> library;
    diag::Sink sink; ///< empty between the steps
    std::unique_ptr<CheckedProgram> program;
    std::unique_ptr<Analyzer> analyzer;
    Diagnostics libraryDiagnostics;
    std::vector<SessionTask> tasks;
    Diagnostics across;
    std::optional<Sketched> sketched;
    size_t largeFrom = size_t{256} << 10; ///< bytes, which are checked in 5 to 10 ms

    void openTask(TaskInput input);
    /// Takes the text of a file; the task has been entered. `earlier`: the plan of a change of this file that has not been checked.
    CheckPlan takeTree(SessionTask& task, size_t index, const std::shared_ptr<const SourceFile>& file,
                       CheckPlan earlier);
    /// Checks what a change concerns.
    void carryOut(SessionTask& task, size_t index, CheckPlan plan);
    bool sketch(const std::shared_ptr<const SourceFile>& file, uint32_t offset);
    std::vector<FilePlace> placesOf(const std::string& path) const;
    /// Bytes that the check of a change reads beside the file in the first of its tasks.
    size_t restOf(const std::vector<FilePlace>& places, const CheckPlan& plan) const;
    /// Whether a change can be checked later: `plan` has been made for it.
    bool canWait(const FilePlace& place, const CheckPlan& plan, size_t rest) const;
    /// Takes the text of the sketched file in the other tasks that have it; that of the first has been checked.
    void finishSketch();
    void complete();
    /// Completes a sketch of another file.
    void completeUnless(const std::string& path);
    /// Nothing but this file may be sketched.
    void change(SessionTask& task, size_t index, const std::shared_ptr<const SourceFile>& file);
    void checkAcross();
    /// The last step of a check of a task, and what it reports about the whole.
    void finish(SessionTask& task);
    /// Moves what was reported since to the files it is about.
    void distribute(SessionTask& task, Diagnostics SessionFile::* list);
};

void Session::State::distribute(SessionTask& task, Diagnostics SessionFile::* list) {
    std::map<const SourceFile*, SessionFile*> byFile;
    Diagnostics found = sink.take();
    if (!found.empty())
        for (SessionFile& file : task.files)
            byFile[file.source.get()] = &file;
    for (diag::Diagnostic& d : found) {
        const auto at = byFile.find(d.file.get());
        (at == byFile.end() ? task.whole : (at->second->*list)).push_back(std::move(d));
    }
}

void Session::State::finish(SessionTask& task) {
    analyzer->finishTask();
    for (diag::Diagnostic& d : sink.take())
        task.whole.push_back(std::move(d));
    task.scope = analyzer->leaveTask();
}

void Session::State::openTask(TaskInput input) {
    SessionTask& task = tasks.emplace_back();
    task.input = std::move(input);
    analyzer->startTask(task.input);
    analyzer->readFiles(task.input, false);
    for (const TaskFile& file : analyzer->task().files) {
        task.files.emplace_back();
        task.files.back().source = program->trees[file.slot]->source;
    }
    distribute(task, &SessionFile::parsed);
    analyzer->checkFiles();
    distribute(task, &SessionFile::checked);
    finish(task);
}

CheckPlan Session::State::takeTree(SessionTask& task, size_t index,
                                   const std::shared_ptr<const SourceFile>& file, CheckPlan earlier) {
    SessionFile& changed = task.files[index];
    const std::shared_ptr<const SourceFile> before = changed.source;
    syntax::ParseOptions parsing;
    parsing.earlier = program->trees[analyzer->task().files[index].slot].get();
    auto tree = syntax::parse(file, sink, parsing);
    const bool broken = sink.hasErrors();
    changed.parsed = sink.take();
    changed.source = file;
    CheckPlan plan = std::move(earlier);
    const bool dependedOnOrder = analyzer->task().dependsOnOrder;
    const auto isOpen = [&](size_t i) { return program->facts[analyzer->task().files[i].slot]->open; };
    if (!plan.isMade) {
        bool othersOpen = false;
        for (size_t i = 0; i < task.files.size(); ++i)
            othersOpen = othersOpen || (i != index && isOpen(i));
        if (othersOpen && analyzer->allowsAlone()) plan.offer = analyzer->offerOf(index);
        plan.held = analyzer->holdUses(index);
    }
    plan.likeness = std::min(plan.likeness, analyzer->replaceTree(index, std::move(tree), broken));
    plan.isMade = true;
    plan.alone = plan.likeness != Analyzer::Likeness::None && !dependedOnOrder;
    plan.dirty.clear();
    for (size_t i = 0; i < task.files.size(); ++i) {
        const bool names = i != index && pointsInto(task.files[i].checked, before);
        plan.isNamed = plan.isNamed || names;
        if (i == index || !plan.alone || isOpen(i) || names) plan.dirty.push_back(i);
    }
    return plan;
}

void Session::State::carryOut(SessionTask& task, size_t index, CheckPlan plan) {
    analyzer->releaseUses(plan.held);
    bool isDone = false;
    if (plan.offer && plan.alone && !plan.isNamed && plan.likeness == Analyzer::Likeness::WithLocals &&
        analyzer->allowsAlone()) {
        isDone = analyzer->recheckAlone(index, *plan.offer);
        if (isDone)
            plan.dirty = {index};
        else
            sink.take();
    }
    std::erase_if(task.whole,
                  [](const diag::Diagnostic& d) { return d.code != diag::say::SameFileTwice.code; });
    for (const size_t i : plan.dirty)
        task.files[i].checked.clear();
    if (!plan.alone)
        analyzer->recheckTask();
    else if (!isDone)
        analyzer->recheckFiles(plan.dirty);
    if (plan.alone && analyzer->task().dependsOnOrder) { // from now on
        sink.take();
        for (SessionFile& each : task.files)
            each.checked.clear();
        analyzer->recheckTask();
    }
    distribute(task, &SessionFile::checked);
    finish(task);
}

void Session::State::change(SessionTask& task, size_t index, const std::shared_ptr<const SourceFile>& file) {
    CheckPlan earlier;
    if (sketched) earlier = std::move(sketched->plan);
    sketched.reset();
    analyzer->enterTask(std::move(task.scope));
    carryOut(task, index, takeTree(task, index, file, std::move(earlier)));
}

std::vector<FilePlace> Session::State::placesOf(const std::string& path) const {
    std::vector<FilePlace> places;
    for (size_t t = 0; t < tasks.size(); ++t)
        for (size_t i = 0; i < tasks[t].files.size(); ++i)
            if (tasks[t].files[i].source->path() == path) places.push_back({t, i});
    return places;
}

size_t Session::State::restOf(const std::vector<FilePlace>& places, const CheckPlan& plan) const {
    size_t size = 0;
    for (size_t i = 0; i < places.size(); ++i) {
        const std::vector<SessionFile>& files = tasks[places[i].task].files;
        for (size_t k = 0; k < files.size(); ++k)
            if (k == places[i].file ? i > 0 : !plan.alone) size += files[k].source->text().size();
    }
    return size;
}

// Of a small program all is known at once; in a large one other files keep for a moment what they had from the last check.
bool Session::State::canWait(const FilePlace& place, const CheckPlan& plan, size_t rest) const {
    if (plan.alone) return !plan.isNamed;
    const TaskFile& file = analyzer->task().files[place.file];
    return file.modules.size() == program->trees[file.slot]->modules.size() && rest >= largeFrom;
}

bool Session::State::sketch(const std::shared_ptr<const SourceFile>& file, uint32_t offset) {
    std::vector<FilePlace> places = placesOf(file->path());
    if (places.empty()) return false;
    const FilePlace place = places.front();
    if (tasks[place.task].files[place.file].source->isBinary() || file->isBinary()) return false;
    completeUnless(file->path());
    for (SessionTask& task : tasks)
        for (std::shared_ptr<const SourceFile>& known : task.input.files)
            if (known->path() == file->path()) known = file;
    CheckPlan plan;
    if (sketched) plan = std::move(sketched->plan);
    SessionTask& task = tasks[place.task];
    analyzer->enterTask(std::move(task.scope));
    plan = takeTree(task, place.file, file, std::move(plan));
    const size_t rest = restOf(places, plan);
    const bool waits = canWait(place, plan, rest);
    places.erase(places.begin());
    sketched = Sketched{place, {}, std::move(places), rest >= largeFrom};
    if (!waits) {
        carryOut(task, place.file, std::move(plan));
        finishSketch();
        return true;
    }
    analyzer->sketchFile(place.file, offset);
    sink.take();
    task.scope = analyzer->leaveTask();
    sketched->plan = std::move(plan);
    return true;
}

void Session::State::finishSketch() {
    const Sketched open = std::move(*sketched);
    sketched.reset();
    const std::shared_ptr<const SourceFile> file = tasks[open.place.task].files[open.place.file].source;
    for (const FilePlace& other : open.others)
        change(tasks[other.task], other.file, file);
    checkAcross();
}

void Session::State::complete() {
    if (!sketched) return;
    SessionTask& task = tasks[sketched->place.task];
    analyzer->enterTask(std::move(task.scope));
    carryOut(task, sketched->place.file, std::move(sketched->plan));
    finishSketch();
}

void Session::State::completeUnless(const std::string& path) {
    if (sketched && tasks[sketched->place.task].files[sketched->place.file].source->path() != path)
        complete();
}

void Session::State::checkAcross() {
    analyzer->checkAcrossTasks();
    across = sink.take();
}

Session::Session(const CheckOptions& options) : state_(std::make_unique<State>(options)) {}
Session::~Session() = default;

void Session::open(std::vector<TaskInput> tasks) {
    State& s = *state_;
    s.tasks.clear();
    s.sketched.reset();
    s.analyzer.reset();
    s.program = std::make_unique<CheckedProgram>();
    s.analyzer = std::make_unique<Analyzer>(*s.program, s.options, s.sink);
    s.analyzer->keepFacts();
    s.analyzer->loadLibrary();
    s.libraryDiagnostics = s.sink.take();
    std::vector<std::string> names;
    for (const TaskInput& task : tasks)
        names.push_back(task.name);
    s.analyzer->setTaskNames(std::move(names));
    for (TaskInput& task : tasks)
        s.openTask(std::move(task));
    s.checkAcross();
}

bool Session::change(const std::shared_ptr<const SourceFile>& file) {
    state_->completeUnless(file->path());
    bool found = false;
    bool readable = true;
    for (SessionTask& task : state_->tasks) {
        for (std::shared_ptr<const SourceFile>& known : task.input.files) {
            if (known->path() != file->path()) continue;
            found = true;
            readable = readable && known->isBinary() == file->isBinary();
            known = file;
        }
    }
    if (!readable) { // the task is complete now, or no longer
        std::vector<TaskInput> tasks;
        for (SessionTask& task : state_->tasks)
            tasks.push_back(std::move(task.input));
        open(std::move(tasks));
        return true;
    }
    for (SessionTask& task : state_->tasks)
        for (size_t i = 0; i < task.files.size(); ++i)
            if (task.files[i].source->path() == file->path()) state_->change(task, i, file);
    if (found) state_->checkAcross();
    return found;
}

bool Session::sketch(const std::shared_ptr<const SourceFile>& file, uint32_t offset) {
    return state_->sketch(file, offset);
}

void Session::setLargeFrom(size_t bytes) {
    state_->largeFrom = bytes;
}

void Session::complete() {
    state_->complete();
}

bool Session::isComplete() const {
    return !state_->sketched;
}

bool Session::isSlowToComplete() const {
    return state_->sketched && state_->sketched->isLarge;
}

void Session::setGuest(const std::string& guest, const std::string& host) {
    state_->analyzer->setGuest(guest, host);
}

const CheckedProgram& Session::program() const {
    return *state_->program;
}

std::vector<diag::Diagnostic> Session::diagnostics() const {
    diag::Sink all;
    all.add(state_->libraryDiagnostics);
    for (const SessionTask& task : state_->tasks) {
        for (const SessionFile& file : task.files)
            all.add(file.parsed);
        for (const SessionFile& file : task.files)
            all.add(file.checked);
        all.add(task.whole);
    }
    all.add(state_->across);
    mergeLineCauses(all);
    return all.sorted();
}

} // namespace rapid::sema

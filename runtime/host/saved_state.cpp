#include "runtime/host/saved_state.h"

#include "config/atomic_file.h"
#include "config/json_text.h"
#include "config/read_file.h"
#include "config/temporary.h"
#include "runtime/base/text_util.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/host/controller.h"
#include "runtime/host/run_files.h"
#include "runtime/host/synchronised_group.h"
#include "runtime/value/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cmath>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

namespace rt {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kMostNamed = 5; // names in one event
constexpr std::size_t kKeptEvents = 100;
constexpr double kTurn = 360;
constexpr std::chrono::seconds kPeriod{1};
constexpr std::chrono::milliseconds kRetryPeriod{5};

/// Numbers of interrupts mean nothing to the next process.
bool namesInterrupts(const TypeDesc& type) {
    if (type.kind != DescKind::Record && type.kind != DescKind::Array)
        return sameName(type.name, "intnum") || sameName(type.baseName, "intnum");
    const uint32_t parts = type.kind == DescKind::Array ? 1 : type.count;
    for (uint32_t i = 0; i < parts; ++i)
        if (namesInterrupts(*type.fields[i])) return true;
    return false;
}

/// "" or what is wrong with the text.
std::string loadKept(const StateKeepers::Keeper& keeper, const std::string& text) {
    try {
        keeper.load(rapid::config::parseJson(text));
    } catch (const std::exception& problem) {
        return problem.what();
    }
    return {};
}

std::string listed(const std::vector<std::string>& names) {
    const std::size_t shown = std::min(names.size(), kMostNamed);
    std::string text =
        fmt::format("{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), ", "));
    if (shown < names.size()) text += fmt::format(" and {} more", names.size() - shown);
    return text;
}

} // namespace

SavedState::~SavedState() {
    if (lock_ >= 0) ::close(lock_);
}

std::string SavedState::path() const {
    return folder_ + "/" + kStateFile;
}

bool SavedState::open(const std::string& folder, std::string& error) {
    std::error_code code;
    fs::create_directories(folder, code);
    if (!fs::is_directory(folder, code)) {
        error = fmt::format("{} is not a folder and cannot be made", folder);
        return false;
    }
    folder_ = folder;
    const std::string lock = folder + "/" + kStateLock;
    lock_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NONBLOCK, 0666);
    if (lock_ < 0) {
        error = fmt::format("cannot write {}: {}", lock, std::strerror(errno));
        return false;
    }
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        error = fmt::format("{} is in use by another controller; give each one a folder of its own", folder);
        return false;
    }
    rapid::config::removeLeftovers(folder);
    remember();
    return true;
}

/// The names and initial values of everything that is kept.
void SavedState::remember() {
    if (remembered_) return;
    remembered_ = true;
    const ProgramDesc& program = controller_.program();
    std::map<const void*, bool> known; // shared persistents have several rows
    for (uint32_t i = 0; i < program.globalCount; ++i) {
        const GlobalDesc& data = program.globals[i];
        std::string initial;
        data_.add(data, keyOf(data));
        if (data.kind != kGlobalVariable && data.kind != kGlobalPersistent) continue;
        if (!known.try_emplace(data.address, true).second) continue;
        // Variables of handles begin without an object. Objects without a keeper are made again.
        if (!valueToSource(data.address, *data.type, initial) &&
            !valueToImage(data.address, *data.type, 1, controller_.service<StateKeepers>(), initial))
            continue;
        Rows& rows = namesInterrupts(*data.type)      ? interruptNumbers_
                     : data.kind == kGlobalPersistent ? persistents_
                                                      : variables_;
        rows.emplace_back(&data, std::move(initial));
    }
    data_.sort();
}

const Task* SavedState::ownerOf(const GlobalDesc& data) const {
    const auto& tasks = controller_.tasks();
    return data.task < 0 || static_cast<std::size_t>(data.task) >= tasks.size()
               ? nullptr
               : tasks[static_cast<std::size_t>(data.task)].get();
}

/// Shared persistents are known by their name alone.
std::string SavedState::keyOf(const GlobalDesc& data) const {
    const Task* owner = ownerOf(data);
    if (owner == nullptr && (data.kind != kGlobalPersistent || (data.flags & kDataLocal) != 0))
        return upperCase(fmt::format("{}/{}", data.module, data.name));
    return upperCase(owner == nullptr ? data.name
                                      : fmt::format("{}/{}/{}", owner->name(), data.module, data.name));
}

// ---- Writing -------------------------------------------------------------------------------------------------------

namespace {

bool hasIndependentAxis(MotionDriver& motion) {
    return motion.hasLostIndependentAxis() || !motion.system().independentAxes().empty();
}

} // namespace

StateImage::TaskImage SavedState::presentTask(Task& task) const {
    StateImage::TaskImage state;
    if (const auto found = earlier_.find(&task); task.isReentering() && found != earlier_.end())
        return found->second;
    const SourcePlace place = task.place();
    state.cycles = task.cyclesDone();
    if (task.endedByItself()) {
        state.pointer = StateImage::Pointer::Ended;
    } else if (task.state() == TaskState::Finished) {
        state.pointer = StateImage::Pointer::Exited;
    } else if (!place.module.empty()) {
        state.pointer = StateImage::Pointer::Inside;
        state.place = fmt::format("{}:{}", place.module, place.line);
        if (task.isMotionTask() && hasIndependentAxis(controller_.motion(task))) {
            state.refusal = "an axis was in independent mode (IndAMove)"; // manual 2.2.4
            return state;
        }
        CallChain chain;
        state.refusal = takeChain({task, data_, controller_.stateKeepers()}, chain);
        if (!state.refusal.empty()) return state;
        state.chain = std::move(chain);
        state.interruptsEnabled = task.interrupts().enabled();
        state.queuedInterrupts = task.interrupts().queuedSafe();
        for (SavedInterrupt& interrupt : task.interrupts().saved()) {
            const RoutineEntry* trap = trapAt(interrupt.trap);
            state.interrupts.push_back({std::move(interrupt), trap == nullptr ? "" : trap->module,
                                        trap == nullptr ? "" : trap->name});
        }
    }
    return state;
}

const RoutineEntry* SavedState::trapAt(EntryFunction function) const {
    for (const RoutineEntry* entry : controller_.tables().routines())
        if (function != nullptr && reinterpret_cast<EntryFunction>(entry->address) == function) return entry;
    return nullptr;
}

StateImage SavedState::present() const {
    StateImage image;
    for (const auto& task : controller_.tasks())
        image.tasks[upperCase(task->name())] = presentTask(*task);
    const auto& keepers = controller_.service<StateKeepers>();
    const auto add = [this, &keepers](const Rows& rows, std::map<std::string, StateImage::Datum>& out) {
        for (const auto& [data, initial] : rows) {
            std::string value;
            if (valueToImage(data->address, *data->type, 1, keepers, value))
                out[keyOf(*data)] = {describeType(*data->type), initial, std::move(value)};
        }
    };
    add(persistents_, image.persistents);
    add(variables_, image.variables);
    add(interruptNumbers_, image.interruptNumbers);
    for (const auto& [name, keeper] : keepers.keepers)
        image.kept[name] = rapid::config::textOf(keeper.save());
    IoSystem& io = controller_.io();
    for (SignalId id = 0; id < static_cast<SignalId>(io.size()); ++id)
        if (io.config(id).store) image.signals[upperCase(io.config(id).name)] = io.value(id);
    for (const auto& motion : controller_.motions()) {
        const motion::JointTarget joints = motion->system().currentJoints();
        StateImage::Group& group = image.groups.emplace_back();
        group.robot = motion->model().name;
        group.axes.assign(joints.robax.begin(), joints.robax.end());
        for (const motion::GroupAxis& axis : motion->system().independentAxes())
            if (!axis.isExternal)
                group.axes[axis.index] -= kTurn * std::round(group.axes[axis.index] / kTurn);
        group.axes.insert(group.axes.end(), joints.extax.begin(), joints.extax.end());
        group.path = motion->remainingPath();
    }
    for (const auto& motion : controller_.motions()) {
        const auto& together = motion->joinedGroup();
        if (together == nullptr || together->members().front().driver != motion.get()) continue;
        auto& names = image.synchronised.emplace_back();
        for (const SynchronisedGroup::Member& member : together->members())
            names.push_back(upperCase(member.task->name()));
    }
    const auto& events = controller_.log().events();
    const std::size_t first = events.size() > kKeptEvents ? events.size() - kKeptEvents : 0;
    image.events.assign(events.begin() + static_cast<std::ptrdiff_t>(first), events.end());
    return image;
}

bool SavedState::write() {
    if (!folder_.empty()) write(present());
    return !failed_;
}

void SavedState::write(const StateImage& image) {
    written_ = std::chrono::steady_clock::now();
    if (beforeWriting_) beforeWriting_();
    const std::string problem = rapid::config::replaceFile(path(), writeImage(image));
    if (!problem.empty() && !failed_) controller_.log().write(EventId::StateNotWritten, nullptr, {problem});
    failed_ = !problem.empty();
}

void SavedState::keepFresh() {
    if (folder_.empty()) return;
    const auto now = std::chrono::steady_clock::now();
    if (now - written_ < kPeriod || now - tried_ < kRetryPeriod) return;
    tried_ = now;
    const auto reenters = [](const auto& task) { return task->isReentering(); };
    if (std::any_of(controller_.tasks().begin(), controller_.tasks().end(), reenters)) return;
    const StateImage image = present();
    const auto lost = [](const auto& task) { return !task.second.refusal.empty(); };
    const bool anyLost = std::any_of(image.tasks.begin(), image.tasks.end(), lost);
    if (anyLost && now - written_ < 2 * kPeriod && controller_.debugger().available()) return;
    write(image);
}

// ---- Reading -------------------------------------------------------------------------------------------------------

void SavedState::putAside(const std::string& why) {
    std::error_code code;
    fs::rename(path(), folder_ + "/" + kStateAside, code);
    controller_.log().write(EventId::StateUnreadable, nullptr, {path(), why, kStateAside});
}

bool SavedState::restore(std::string& error) {
    if (folder_.empty()) return true;
    written_ = std::chrono::steady_clock::now();
    struct stat status{};
    if (::lstat(path().c_str(), &status) != 0 && errno == ENOENT) return true; // the first run
    std::string text;
    if (const std::string problem = rapid::config::readFile(path(), text); !problem.empty()) {
        error = fmt::format("{} cannot be read: {}; remove it or name another folder", path(), problem);
        return false;
    }
    if (const std::string problem = restoreText(text); !problem.empty()) putAside(problem);
    return true;
}

/// "" or why it cannot be understood.
std::string SavedState::restoreText(const std::string& text) {
    StateImage image;
    const auto unitNamed = [this](const std::string& name) -> const robot::ExternalUnit* {
        const MechanicalUnit* unit = controller_.units().find(name);
        return unit != nullptr ? &unit->geometry : nullptr;
    };
    std::string problem = readImage(text, image, unitNamed);
    if (problem.empty()) restore(image);
    return problem;
}

void SavedState::continueFrom(const std::string& text) {
    remember();
    if (const std::string problem = restoreText(text); !problem.empty())
        controller_.log().write(EventId::StateNotWritten, nullptr, {problem});
}

void SavedState::restore(StateImage& image) {
    controller_.log().restore(image.events);
    restoreData(persistents_, image.persistents);
    restoreTasks(image);
    restoreSurroundings(image);
    if (!earlier_.empty()) restoreKept(image);
    for (const auto& task : controller_.tasks()) {
        if (task->isReentering()) restoreInterrupts(*task, earlier_.at(task.get()));
    }
    restorePaths(image);
}

namespace {

/// A work object that another robot carries knows it by its number only.
void findCarrier(const std::vector<std::unique_ptr<MotionDriver>>& motions, motion::MoveCommand& move) {
    const int group = move.frames.carrierGroup;
    if (group >= 0 && static_cast<std::size_t>(group) < motions.size())
        move.frames.carrier = &motions[static_cast<std::size_t>(group)]->system();
}

bool isMoved(const Task& task, const StateImage& image) {
    return task.isReentering() && task.isMotionTask() &&
           static_cast<std::size_t>(task.motionGroup()) < image.groups.size();
}

} // namespace

/// Of tasks that continue where they were.
void SavedState::restorePaths(StateImage& image) {
    for (StateImage::Group& group : image.groups) {
        MotionDriver::EarlierPath& path = group.path;
        const auto complete = [&](motion::MoveCommand& move) { findCarrier(controller_.motions(), move); };
        std::for_each(path.moves.begin(), path.moves.end(), complete);
        for (MotionDriver::EarlierLevel& level : path.stored) {
            std::for_each(level.moves.begin(), level.moves.end(), complete);
            if (level.place && level.place->before) complete(*level.place->before);
        }
        if (path.place && path.place->before) complete(*path.place->before);
        if (path.awaited) complete(*path.awaited);
    }
    for (const std::vector<std::string>& names : image.synchronised)
        restoreTogether(image, names);
    for (const auto& task : controller_.tasks()) {
        const auto isNamed = [&](const auto& names) {
            return std::find(names.begin(), names.end(), upperCase(task->name())) != names.end();
        };
        if (!isMoved(*task, image) ||
            std::any_of(image.synchronised.begin(), image.synchronised.end(), isNamed))
            continue;
        controller_.motion(*task).continuePath(
            image.groups[static_cast<std::size_t>(task->motionGroup())].path);
    }
}

/// All of them, or none: a task that begins again ends the synchronised movement, as when its program pointer is moved.
void SavedState::restoreTogether(const StateImage& image, const std::vector<std::string>& names) {
    std::vector<SynchronisedGroup::Member> members;
    std::vector<MotionDriver::EarlierPath> paths;
    for (const std::string& name : names) {
        Task* task = controller_.findTask(name);
        if (task == nullptr || !isMoved(*task, image)) return;
        members.push_back({&controller_.motion(*task), task});
        paths.push_back(image.groups[static_cast<std::size_t>(task->motionGroup())].path);
    }
    const auto group = std::make_shared<SynchronisedGroup>(members);
    for (const SynchronisedGroup::Member& member : members)
        member.driver->joinGroup(group);
    MotionDriver::continueTogether(*group, std::move(paths));
}

void SavedState::restoreInterrupts(Task& task, const StateImage::TaskImage& image) {
    const auto& again = controller_.service<StateKeepers>().orderAgain;
    for (const StateImage::Interrupt& saved : image.interrupts) {
        SavedInterrupt what = saved.what;
        const RoutineEntry* trap =
            saved.routine.empty() ? nullptr : controller_.findRoutine(saved.routine, saved.module, task);
        what.trap = trap == nullptr ? nullptr : reinterpret_cast<EntryFunction>(trap->address);
        task.interrupts().restore(what);
        const bool lost = what.trap == nullptr && !saved.routine.empty();
        const bool ordered =
            !what.ordered || (again && again(task, what.number, what.single, what.safe, what.order));
        if (lost || !ordered)
            controller_.log().write(EventId::InterruptLost, &task,
                                    {std::to_string(what.number), saved.routine});
        if (what.asleep) task.interrupts().sleep(what.number);
    }
    for (const int number : image.queuedInterrupts)
        task.interrupts().queueAgain(number);
    if (!image.interruptsEnabled) task.interrupts().disable();
}

void SavedState::restoreKept(const StateImage& image) {
    for (const auto& [name, keeper] : controller_.service<StateKeepers>().keepers) {
        const auto found = image.kept.find(name);
        if (found == image.kept.end()) continue;
        const std::string problem = loadKept(keeper, found->second);
        if (!problem.empty()) controller_.log().write(EventId::StateMisfit, nullptr, {name});
    }
}

void SavedState::restoreTasks(const StateImage& image) {
    Rows kept; // variables of shared modules get their initial values once, when the program is loaded
    for (const auto& row : variables_)
        if (ownerOf(*row.first) == nullptr) kept.push_back(row);
    bool continues = false;
    for (const auto& task : controller_.tasks()) {
        const auto found = image.tasks.find(upperCase(task->name()));
        if (found == image.tasks.end() || !restorePointer(*task, found->second)) continue;
        continues = continues || (task->kind() == TaskKind::Normal && task->isReentering());
        for (const auto& row : variables_)
            if (ownerOf(*row.first) == task.get()) kept.push_back(row);
    }
    // The interrupted run continues: tasks that had ended in it stay ended.
    for (const auto& task : controller_.tasks()) {
        const auto found = image.tasks.find(upperCase(task->name()));
        if (!continues || found == image.tasks.end() || task->kind() != TaskKind::Normal) continue;
        task->setCyclesDone(found->second.cycles);
        const StateImage::Pointer pointer = found->second.pointer;
        if (pointer == StateImage::Pointer::Ended || pointer == StateImage::Pointer::Exited)
            task->stayEnded();
    }
    restoreData(kept, image.variables);
    Rows numbers;
    for (const auto& row : interruptNumbers_) {
        const Task* owner = ownerOf(*row.first);
        if (owner != nullptr && owner->isReentering()) numbers.push_back(row);
    }
    restoreData(numbers, image.interruptNumbers);
}

/// The beginning of the task. True when its variables keep their values.
bool SavedState::restorePointer(Task& task, const StateImage::TaskImage& image) {
    // SEMISTATIC tasks start from the beginning at every power on (manual 1.20).
    if (image.pointer == StateImage::Pointer::Main || image.pointer == StateImage::Pointer::Exited ||
        task.kind() == TaskKind::SemiStatic)
        return false;
    if (controller_.options().ppToMain && task.kind() == TaskKind::Normal) return false;
    if (image.pointer == StateImage::Pointer::Ended) {
        task.keepVariables();
        return true;
    }
    std::string why = image.refusal;
    if (image.chain) {
        reentries_.push_back(std::make_unique<Reentry>(controller_, *image.chain, image.place, data_));
        why = reentries_.back()->begin(task);
    }
    if (task.isReentering()) {
        earlier_[&task] = image;
        controller_.log().write(EventId::PointerKept, &task, {task.name(), image.place});
        return true;
    }
    controller_.log().write(EventId::PointerLost, &task, {task.name(), image.place, why});
    return false;
}

/// A value is taken over where name and type still fit. An initial value edited since then wins: the user meant it.
void SavedState::restoreData(const Rows& rows, const std::map<std::string, StateImage::Datum>& data) {
    const auto& keepers = controller_.service<StateKeepers>();
    std::vector<std::string> edited, misfits;
    for (const auto& [row, initial] : rows) {
        const auto found = data.find(keyOf(*row));
        if (found == data.end()) continue; // new in the program
        const StateImage::Datum& saved = found->second;
        const std::string name = fmt::format("{}.{}", row->module, row->name);
        if (saved.type != describeType(*row->type))
            misfits.push_back(name);
        else if (saved.initial != initial &&
                 saved.value != initial) // the same when it was written there by --save
            edited.push_back(name);
        else if (saved.initial == initial && !imageToValue(saved.value, row->address, *row->type, 1, keepers))
            misfits.push_back(name);
    }
    if (!edited.empty()) controller_.log().write(EventId::StateEdited, nullptr, {listed(edited)});
    if (!misfits.empty()) controller_.log().write(EventId::StateMisfit, nullptr, {listed(misfits)});
}

namespace {

/// Nothing happens when it is another arm.
void restorePosture(motion::MotionSystem& arm, const StateImage::Group& group) {
    motion::JointTarget posture = arm.currentJoints();
    const robot::RobotModel& model = arm.model();
    if (group.robot != model.name || group.axes.size() != posture.robax.size() + posture.extax.size()) return;
    for (std::size_t i = 0; i < posture.robax.size(); ++i) {
        if (!(group.axes[i] >= model.lowerDeg[i] && group.axes[i] <= model.upperDeg[i])) return;
        posture.robax[i] = group.axes[i];
    }
    for (std::size_t i = 0; i < posture.extax.size(); ++i)
        posture.extax[i] = group.axes[posture.robax.size() + i];
    arm.placeAt(posture);
}

} // namespace

/// Signals and the postures of the arms.
void SavedState::restoreSurroundings(const StateImage& image) {
    IoSystem& io = controller_.io();
    for (const auto& [name, value] : image.signals) {
        const SignalId id = io.find(name);
        if (id >= 0 && io.config(id).store) (void)io.force(id, value);
    }
    for (std::size_t i = 0; i < std::min(image.groups.size(), controller_.motions().size()); ++i)
        restorePosture(controller_.motions()[i]->system(), image.groups[i]);
}

} // namespace rt

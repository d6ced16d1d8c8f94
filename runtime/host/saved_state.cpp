#include "runtime/host/saved_state.h"

#include "config/atomic_file.h"
#include "runtime/host/controller.h"
#include "runtime/io/text_util.h"
#include "runtime/value/value_text.h"

#include <fmt/format.h>

#include <cerrno>
#include <cstring>
#include <fcntl.h>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sys/file.h>
#include <unistd.h>

namespace rt {
namespace {

namespace fs = std::filesystem;

constexpr const char* kFile = "state.json";
constexpr const char* kAside = "state.broken.json";
constexpr uint8_t kVariable = 0, kPersistent = 1; // ir::GlobalKind
constexpr std::size_t kMostNamed = 5;             // names in one event
constexpr std::size_t kKeptEvents = 100;

/// Numbers of interrupts mean nothing to the next process.
bool namesInterrupts(const TypeDesc& type) {
    if (type.kind != DescKind::Record && type.kind != DescKind::Array)
        return sameName(type.name, "intnum") || sameName(type.baseName, "intnum");
    const uint32_t parts = type.kind == DescKind::Array ? 1 : type.count;
    for (uint32_t i = 0; i < parts; ++i)
        if (namesInterrupts(*type.fields[i])) return true;
    return false;
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
    return folder_ + "/" + kFile;
}

bool SavedState::open(const std::string& folder, std::string& error) {
    std::error_code code;
    fs::create_directories(folder, code);
    if (!fs::is_directory(folder, code)) {
        error = fmt::format("{} is not a folder and cannot be made", folder);
        return false;
    }
    folder_ = folder;
    const std::string lock = folder + "/lock";
    lock_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666);
    if (lock_ < 0) {
        error = fmt::format("cannot write {}: {}", lock, std::strerror(errno));
        return false;
    }
    if (::flock(lock_, LOCK_EX | LOCK_NB) != 0) {
        error = fmt::format("{} is in use by another controller; give each one a folder of its own", folder);
        return false;
    }
    remember();
    return true;
}

/// The names and initial values of everything that is kept.
void SavedState::remember() {
    const ProgramDesc& program = controller_.program();
    std::map<const void*, bool> known; // shared persistents have several rows
    for (uint32_t i = 0; i < program.globalCount; ++i) {
        const GlobalDesc& data = program.globals[i];
        std::string initial;
        if (data.kind != kVariable && data.kind != kPersistent) continue;
        if (!known.try_emplace(data.address, true).second) continue;
        if (!valueToSource(data.address, *data.type, initial)) continue; // handles are made anew
        if (namesInterrupts(*data.type)) continue;
        (data.kind == kPersistent ? persistents_ : variables_).emplace_back(&data, std::move(initial));
    }
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
    if (owner == nullptr && (data.kind != kPersistent || (data.flags & kDataLocal) != 0))
        return upperCase(fmt::format("{}/{}", data.module, data.name));
    return upperCase(owner == nullptr ? data.name
                                      : fmt::format("{}/{}/{}", owner->name(), data.module, data.name));
}

// ---- Writing -------------------------------------------------------------------------------------------------------

StateImage SavedState::present() const {
    StateImage image;
    for (const auto& task : controller_.tasks()) {
        StateImage::TaskImage& state = image.tasks[upperCase(task->name())];
        const SourcePlace place = task->place();
        if (task->endedByItself())
            state.pointer = StateImage::Pointer::Ended;
        else if (!place.module.empty() && task->state() != TaskState::Finished)
            state = {StateImage::Pointer::Inside, fmt::format("{}:{}", place.module, place.line)};
    }
    const auto add = [this](const Rows& rows, std::map<std::string, StateImage::Datum>& out) {
        for (const auto& [data, initial] : rows) {
            std::string value;
            if (valueToSource(data->address, *data->type, value))
                out[keyOf(*data)] = {describeType(*data->type), initial, std::move(value)};
        }
    };
    add(persistents_, image.persistents);
    add(variables_, image.variables);
    IoSystem& io = controller_.io();
    for (SignalId id = 0; id < static_cast<SignalId>(io.size()); ++id)
        if (io.config(id).store) image.signals[upperCase(io.config(id).name)] = io.value(id);
    motion::MotionSystem& arm = controller_.motion().system();
    const motion::JointTarget joints = arm.currentJoints();
    image.robot = arm.model().name;
    image.axes.assign(joints.robax.begin(), joints.robax.end());
    image.axes.insert(image.axes.end(), joints.extax.begin(), joints.extax.end());
    const auto& events = controller_.log().events();
    const std::size_t first = events.size() > kKeptEvents ? events.size() - kKeptEvents : 0;
    image.events.assign(events.begin() + static_cast<std::ptrdiff_t>(first), events.end());
    return image;
}

void SavedState::write() {
    if (folder_.empty()) return;
    written_ = std::chrono::steady_clock::now();
    const std::string problem = rapid::config::replaceFile(path(), writeImage(present()));
    if (!problem.empty() && !failed_) controller_.log().write(EventId::StateNotWritten, nullptr, {problem});
    failed_ = !problem.empty();
}

void SavedState::keepFresh() {
    if (folder_.empty() || std::chrono::steady_clock::now() - written_ < std::chrono::seconds(1)) return;
    write();
}

// ---- Reading -------------------------------------------------------------------------------------------------------

void SavedState::putAside(const std::string& why) {
    std::error_code code;
    fs::rename(path(), folder_ + "/" + kAside, code);
    controller_.log().write(EventId::StateUnreadable, nullptr, {path(), why, kAside});
}

void SavedState::restore() {
    if (folder_.empty()) return;
    written_ = std::chrono::steady_clock::now();
    std::ifstream file(path(), std::ios::binary);
    if (!file) return; // the first run
    const std::string text((std::istreambuf_iterator<char>(file)), {});
    StateImage image;
    if (const std::string problem = readImage(text, image); !problem.empty()) return putAside(problem);
    controller_.log().restore(image.events);
    restoreData(persistents_, image.persistents);
    restoreTasks(image);
    restoreSurroundings(image);
}

void SavedState::restoreTasks(const StateImage& image) {
    Rows kept; // variables of shared modules get their initial values once, when the program is loaded
    for (const auto& row : variables_)
        if (ownerOf(*row.first) == nullptr) kept.push_back(row);
    for (const auto& task : controller_.tasks()) {
        const auto found = image.tasks.find(upperCase(task->name()));
        if (found == image.tasks.end()) continue;
        if (found->second.pointer == StateImage::Pointer::Inside && task->kind() != TaskKind::SemiStatic)
            controller_.log().write(EventId::PointerLost, task.get(), {task->name(), found->second.place});
        // SEMISTATIC tasks start from the beginning at every power on (manual 1.20).
        if (found->second.pointer != StateImage::Pointer::Ended || task->kind() == TaskKind::SemiStatic)
            continue;
        task->keepVariables();
        for (const auto& row : variables_)
            if (ownerOf(*row.first) == task.get()) kept.push_back(row);
    }
    restoreData(kept, image.variables);
}

/// A value is taken over where name and type still fit. An initial value edited since then wins: the user meant it.
void SavedState::restoreData(const Rows& rows, const std::map<std::string, StateImage::Datum>& data) {
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
        else if (saved.initial == initial && !sourceToValue(saved.value, row->address, *row->type))
            misfits.push_back(name);
    }
    if (!edited.empty()) controller_.log().write(EventId::StateEdited, nullptr, {listed(edited)});
    if (!misfits.empty()) controller_.log().write(EventId::StateMisfit, nullptr, {listed(misfits)});
}

/// Signals and the posture of the arm.
void SavedState::restoreSurroundings(const StateImage& image) {
    IoSystem& io = controller_.io();
    for (const auto& [name, value] : image.signals) {
        const SignalId id = io.find(name);
        if (id >= 0 && io.config(id).store) (void)io.force(id, value);
    }
    MotionDriver& motion = controller_.motion();
    motion::JointTarget posture = motion.system().currentJoints();
    if (image.robot != motion.system().model().name ||
        image.axes.size() != posture.robax.size() + posture.extax.size())
        return; // another arm
    const robot::RobotModel& model = motion.system().model();
    for (std::size_t i = 0; i < posture.robax.size(); ++i) {
        if (!(image.axes[i] >= model.lowerDeg[i] && image.axes[i] <= model.upperDeg[i])) return;
        posture.robax[i] = image.axes[i];
    }
    for (std::size_t i = 0; i < posture.extax.size(); ++i)
        posture.extax[i] = image.axes[posture.robax.size() + i];
    motion.system().placeAt(posture);
}

} // namespace rt

#include "runtime/debug/call_chain.h"

#include "config/json_text.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/sched/error_search.h"
#include "runtime/value/value_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstring>
#include <tuple>

namespace rt {
namespace {

bool hasHandles(const TypeDesc& type) {
    if (type.kind == DescKind::Handle || type.kind == DescKind::Other) return true;
    if (type.kind != DescKind::Record && type.kind != DescKind::Array) return false;
    const uint32_t parts = type.kind == DescKind::Array ? 1 : type.count;
    for (uint32_t i = 0; i < parts; ++i)
        if (hasHandles(*type.fields[i])) return true;
    return false;
}

template <class Number> Number numberAt(const unsigned char* data) {
    Number number;
    std::memcpy(&number, data, sizeof number);
    return number;
}

/// The bytes of a file somebody may have edited can be what no program could store.
bool isValue(const unsigned char* data, const TypeDesc& type) {
    switch (type.kind) {
    case DescKind::Num: return std::isfinite(numberAt<float>(data));
    case DescKind::Dnum: return std::isfinite(numberAt<double>(data));
    case DescKind::Bool: return *data <= 1;
    case DescKind::String:
    case DescKind::Bytes: return numberAt<uint32_t>(data) <= type.size - sizeof(String::length);
    case DescKind::Array:
        for (uint32_t i = 0; i < type.count; ++i)
            if (!isValue(data + uint64_t{i} * type.fields[0]->size, *type.fields[0])) return false;
        return true;
    case DescKind::Record:
        for (uint32_t i = 0; i < type.count; ++i)
            if (!isValue(data + type.offsets[i], *type.fields[i])) return false;
        return true;
    default: return true;
    }
}

/// The keeper of the objects of a handle or an array of handles; null: none.
const StateKeepers::HandleKeeper* keeperOf(const TypeDesc& type, const StateKeepers& keepers) {
    const TypeDesc& element = type.kind == DescKind::Array ? *type.fields[0] : type;
    const auto found =
        element.kind == DescKind::Handle ? keepers.handles.find(element.baseName) : keepers.handles.end();
    return found == keepers.handles.end() ? nullptr : &found->second;
}

bool handlesToImage(const void* data, const TypeDesc& type, uint64_t count, const StateKeepers& keepers,
                    std::string& text) {
    const StateKeepers::HandleKeeper* keeper = keeperOf(type, keepers);
    if (keeper == nullptr) return false;
    nlohmann::json list = nlohmann::json::array();
    std::vector<Handle> handles(count * type.size / sizeof(Handle));
    std::memcpy(handles.data(), data, handles.size() * sizeof(Handle));
    for (const Handle handle : handles)
        list.push_back(keeper->textOf(handle));
    text = "@" + rapid::config::textOf(list);
    return true;
}

bool imageToHandles(const std::string& text, void* data, const TypeDesc& type, uint64_t count,
                    const StateKeepers& keepers) {
    const StateKeepers::HandleKeeper* keeper = keeperOf(type, keepers);
    if (keeper == nullptr || text.empty() || text.front() != '@') return false;
    std::vector<Handle> handles;
    try {
        for (const std::string& object :
             rapid::config::parseJson(text.substr(1)).get<std::vector<std::string>>()) {
            handles.push_back(object.empty() ? 0 : keeper->make(object));
            if (!object.empty() && handles.back() == 0) return false;
        }
    } catch (const std::exception&) {
        return false;
    }
    if (handles.size() * sizeof(Handle) != count * type.size) return false;
    std::memcpy(data, handles.data(), handles.size() * sizeof(Handle));
    return true;
}

/// Elements of an array whose dimensions are known at run time; 1 for anything else.
uint64_t elementsOf(const SteppingFrame& frame, uint32_t index) {
    uint64_t count = 1;
    for (uint32_t k = 0; k < frame.routine->locals[index].rank; ++k)
        count *= static_cast<uint64_t>(
            std::max<int32_t>(*static_cast<const int32_t*>(frame.addresses[index + 1 + k]), 0));
    return count;
}

std::string typeOf(const SteppingFrame& frame, uint32_t index) {
    const LocalDesc& desc = frame.routine->locals[index];
    std::string type;
    for (uint32_t k = 0; k < desc.rank; ++k)
        type += fmt::format("{}{}", k == 0 ? '[' : ',',
                            *static_cast<const int32_t*>(frame.addresses[index + 1 + k]));
    return type + (desc.rank > 0 ? "]" : "") + describeType(*desc.type);
}

/// The local of a routine in progress that lies at an address: "depth:index"; "" when there is none.
std::string localAt(const std::vector<Frame*>& frames, const char* address, uint64_t& offset) {
    for (std::size_t depth = 0; depth < frames.size(); ++depth) {
        const RoutineDesc& routine = *frames[depth]->routine;
        if (routine.stepping == 0) continue;
        const auto& frame = *static_cast<const SteppingFrame*>(frames[depth]);
        for (uint32_t i = 0; i < routine.localCount; i += 1U + routine.locals[i].rank) {
            if (routine.locals[i].type == nullptr || routine.locals[i].kind == LocalDesc::Reference) continue;
            const auto* begin = static_cast<const char*>(frame.addresses[i]);
            if (address < begin || address >= begin + routine.locals[i].type->size) continue;
            offset = static_cast<uint64_t>(address - begin);
            return fmt::format("{}:{}", depth, i);
        }
    }
    return {};
}

SavedFrame takeFrame(const std::vector<Frame*>& frames, std::size_t depth, const TaskData& data) {
    const auto& frame = *static_cast<const SteppingFrame*>(frames[depth]);
    const RoutineDesc& routine = *frame.routine;
    SavedFrame saved{routine.module, routine.name, routine.textHash, frame.statement, -1, {}};
    const StmtDesc* statement = statementOf(frame);
    if (statement != nullptr && (statement->flags & kStmtInHandler) != 0) saved.failed = frame.failed;
    for (uint32_t i = 0; i < routine.localCount; i += 1U + routine.locals[i].rank)
        if (routine.locals[i].type != nullptr) saved.locals.push_back(takeLocal(frame, i, frames, data));
    return saved;
}

/// Its data get their initial values, which nothing else notices; no statement has been executed.
bool isAmongDeclarations(const Frame& frame) {
    const RoutineDesc& routine = *frame.routine;
    for (uint32_t s = 0; s < routine.statementCount; ++s)
        if (routine.statements[s].canStart != kCannotStart) return frame.statement < static_cast<int32_t>(s);
    return true;
}

std::string refusalOf(const Frame& frame) {
    const RoutineDesc& routine = *frame.routine;
    if (&routine == &kTrapBoundary) return "an interrupt routine was at work";
    if (&routine == &kEventBoundary) return "an event routine was at work";
    if (routine.stepping == 0) return "the program was not compiled for the stepping profile (--stepping)";
    if (routine.isDetachedHandler != 0) return "an error handler of RaiseToUser \\Continue was at work";
    if (frame.reserved == kFrameInUndo) return "an UNDO handler was at work";
    const StmtDesc* statement = statementOf(frame);
    if (statement != nullptr && (statement->flags & kStmtInBackward) != 0) return "it was executed backwards";
    return {};
}

/// Why execution cannot begin again with the statement of the innermost frame.
std::string refusalAt(const StmtDesc& statement, Standing standing) {
    const bool repeatable = (statement.flags & kStmtRepeatable) != 0;
    switch (standing) {
    case Standing::Between: return fmt::format("the instruction in line {} was half done", statement.line);
    case Standing::InWait:
        if (!repeatable)
            return fmt::format("the instruction in line {} waited after it had called a routine",
                               statement.line);
        break;
    case Standing::AtStatement:
    case Standing::AfterStop:
    case Standing::AtError: break;
    }
    if (statement.canStart == kStartsEarlier && !repeatable)
        return fmt::format("the conditions before line {} call a routine", statement.line);
    return {};
}

} // namespace

// ---- Data index ----------------------------------------------------------------------------------------------------

void DataIndex::add(const GlobalDesc& data, std::string key) {
    rows_.push_back({static_cast<const char*>(data.address), data.type->size, std::move(key)});
}

void DataIndex::sort() {
    const auto order = [](const Row& row) { return std::tie(row.begin, row.key); };
    std::sort(rows_.begin(), rows_.end(),
              [&order](const Row& a, const Row& b) { return order(a) < order(b); });
}

const std::string* DataIndex::find(const void* address, uint64_t& offset) const {
    const auto* at = static_cast<const char*>(address);
    auto next = std::upper_bound(rows_.begin(), rows_.end(), at,
                                 [](const char* a, const Row& row) { return a < row.begin; });
    if (next == rows_.begin()) return nullptr;
    const Row& row = *--next;
    offset = static_cast<uint64_t>(at - row.begin);
    return offset < row.size ? &row.key : nullptr;
}

// ---- Values --------------------------------------------------------------------------------------------------------

bool valueToImage(const void* data, const TypeDesc& type, uint64_t count, const StateKeepers& keepers,
                  std::string& text) {
    if (hasHandles(type)) return handlesToImage(data, type, count, keepers, text);
    if (count == 1 && valueToSource(data, type, text)) return true;
    text = "#";
    const auto* bytes = static_cast<const unsigned char*>(data);
    for (uint64_t i = 0; i < count * type.size; ++i)
        text += fmt::format("{:02x}", bytes[i]);
    return true;
}

bool imageToValue(const std::string& text, void* data, const TypeDesc& type, uint64_t count,
                  const StateKeepers& keepers) {
    if (hasHandles(type)) return imageToHandles(text, data, type, count, keepers);
    if (text.empty() || text.front() != '#') return count == 1 && sourceToValue(text, data, type);
    if (text.size() != 1 + 2 * count * type.size) return false;
    std::vector<unsigned char> bytes(count * type.size);
    for (std::size_t i = 0; i < bytes.size(); ++i) {
        const char* at = text.data() + 1 + 2 * i;
        if (std::from_chars(at, at + 2, bytes[i], 16).ptr != at + 2) return false;
    }
    for (uint64_t i = 0; i < count; ++i)
        if (!isValue(bytes.data() + i * type.size, type)) return false;
    std::memcpy(data, bytes.data(), bytes.size());
    return true;
}

// ---- Chain ---------------------------------------------------------------------------------------------------------

SavedLocal takeLocal(const SteppingFrame& frame, uint32_t index, const std::vector<Frame*>& frames,
                     const TaskData& data) {
    const LocalDesc& desc = frame.routine->locals[index];
    SavedLocal saved;
    saved.type = typeOf(frame, index);
    void* address = frame.addresses[index];
    const bool reference = desc.kind == LocalDesc::Reference;
    if (reference) address = *static_cast<void**>(address);
    if (address == nullptr) {
        saved.kind = SavedLocal::Kind::Absent;
        return saved;
    }
    if (reference) {
        saved.kind = SavedLocal::Kind::Object;
        if (const std::string* key = data.index.find(address, saved.offset))
            saved.object = *key;
        else if (data.task.ownsAddress(address))
            saved.object = localAt(frames, static_cast<const char*>(address), saved.offset);
        if (!saved.object.empty()) return saved;
        saved.offset = 0;
        saved.kind = SavedLocal::Kind::Copy;
    }
    if (!valueToImage(address, *desc.type, elementsOf(frame, index), data.keepers, saved.value))
        saved.kind = SavedLocal::Kind::Fresh;
    return saved;
}

std::string takeChain(const TaskData& data, CallChain& chain) {
    const Task& task = data.task;
    if (task.isUnwinding()) return "the program pointer was being moved";
    std::vector<Frame*> frames = task.frames();
    for (const Frame* frame : frames)
        if (std::string why = refusalOf(*frame); !why.empty()) return why;
    Standing standing = task.standing();
    if (!frames.empty() && isAmongDeclarations(*frames.back())) {
        frames.pop_back(); // called again by the statement further out
        standing = Standing::AtStatement;
        if (!frames.empty() && (statementOf(*frames.back())->flags & kStmtReenterable) == 0)
            return fmt::format("the instruction in line {} was half done", statementOf(*frames.back())->line);
    }
    for (std::size_t depth = 0; depth < frames.size(); ++depth) {
        const StmtDesc* statement = statementOf(*frames[depth]);
        if (statement == nullptr || statement->canStart == kCannotStart)
            return "it stood between two instructions";
        const bool innermost = depth + 1 == frames.size();
        if (!innermost && (statement->flags & kStmtReenterable) == 0)
            return fmt::format(
                "the instruction in line {} of {} calls more than the routine it had come to, or needs "
                "data that others may have changed",
                statement->line, frames[depth]->routine->name);
        if (!innermost) continue;
        if (std::string why = refusalAt(*statement, standing); !why.empty()) return why;
    }
    for (std::size_t depth = 0; depth < frames.size(); ++depth)
        chain.frames.push_back(takeFrame(frames, depth, data));
    chain.afterStop = standing == Standing::AfterStop;
    chain.errors = task.errorMemory();
    return {};
}

} // namespace rt

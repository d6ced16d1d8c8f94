#include "runtime/debug/reentry.h"

#include "runtime/base/text_util.h"
#include "runtime/debug/state_keepers.h"
#include "runtime/log/event_log.h"

#include <fmt/format.h>

namespace rt {

const RoutineEntry* Reentry::find(const SavedFrame& frame, const Task& task) const {
    for (const RoutineEntry* entry : host_.tables().routines())
        if ((entry->task < 0 || entry->task == static_cast<int32_t>(task.index())) &&
            sameName(entry->desc->module, frame.module) && sameName(entry->desc->name, frame.routine))
            return entry;
    return nullptr;
}

std::string Reentry::begin(Task& task) {
    for (const SavedFrame& frame : chain_.frames) {
        const RoutineEntry* entry = find(frame, task);
        if (entry == nullptr || entry->desc == nullptr)
            return fmt::format("there is no routine {}:{}", frame.module, frame.routine);
        const RoutineDesc& routine = *entry->desc;
        if (routine.stepping == 0) return "the program is not compiled for the stepping profile now";
        if (routine.textHash != frame.textHash)
            return fmt::format("routine {} has been changed", frame.routine);
        if (frame.statement < 0 || static_cast<uint32_t>(frame.statement) >= routine.statementCount ||
            routine.statements[frame.statement].canStart == kCannotStart)
            return fmt::format("routine {} has no such instruction", frame.routine);
        const bool handling = (routine.statements[frame.statement].flags & kStmtInHandler) != 0;
        const bool named = frame.failed >= 0 && static_cast<uint32_t>(frame.failed) < routine.statementCount;
        if (handling && !(named && routine.statements[frame.failed].handled != 0))
            return fmt::format("routine {} has no such instruction", frame.routine);
    }
    EntryFunction entry = nullptr; // main
    if (!chain_.frames.empty() && !sameName(chain_.frames[0].routine, "main")) {
        const RoutineEntry* outermost = find(chain_.frames[0], task);
        if (outermost->desc->callable == 0 || outermost->address == nullptr)
            return fmt::format("routine {} cannot be called by itself", chain_.frames[0].routine);
        entry = reinterpret_cast<EntryFunction>(outermost->address);
    }
    task.reenter(*this, entry);
    return {};
}

int32_t Reentry::beforeStatement(Task& task, Frame* at) {
    const int32_t here = at->statement;
    if (chain_.frames.empty()) { // before the first statement
        task.finishReentry(chain_.errors, chain_.afterStop);
        return here;
    }
    if (at == current_) {
        const int32_t target = chain_.frames[depth_ - 1].statement;
        const StmtDesc& statement = at->routine->statements[here];
        // The statement sent to; or, for a further condition of an IF, those before it.
        if (std::exchange(jumped_, false)) {
            reached_ = here == target;
            return here;
        }
        if (reached_ || statement.canStart != kStartsEarlier || here > target)
            return giveUp(task,
                          fmt::format("the instruction in line {} did not call {} again",
                                      at->routine->statements[target].line, chain_.frames[depth_].routine));
        reached_ = here == target;
        return here;
    }
    if (const std::string why = entered(task, at); !why.empty()) return giveUp(task, why);
    const int32_t target = chain_.frames[depth_ - 1].statement;
    reached_ = here == target;
    jumped_ = !reached_;
    at->statement = target;
    if (depth_ == chain_.frames.size()) task.finishReentry(chain_.errors, chain_.afterStop);
    return target;
}

/// The next routine of the chain has been called: its data get their values.
std::string Reentry::entered(Task& task, Frame* at) {
    const RoutineDesc& routine = *at->routine;
    const SavedFrame& saved = chain_.frames[depth_];
    if (at->caller != current_ || !sameName(routine.module, saved.module) ||
        !sameName(routine.name, saved.routine) || routine.textHash != saved.textHash)
        return fmt::format("{} was called instead of {}", routine.name, saved.routine);
    auto& frame = *static_cast<SteppingFrame*>(at);
    std::size_t next = 0;
    for (uint32_t i = 0; i < routine.localCount; i += 1U + routine.locals[i].rank) {
        if (routine.locals[i].type == nullptr) continue;
        if (next >= saved.locals.size()) return fmt::format("routine {} has more data now", routine.name);
        if (std::string why = restoreLocal(frame, i, saved.locals[next++], task); !why.empty()) return why;
    }
    frame.failed = saved.failed;
    current_ = at;
    ++depth_;
    return {};
}

std::string Reentry::restoreLocal(const SteppingFrame& frame, uint32_t index, const SavedLocal& saved,
                                  const Task& task) {
    const LocalDesc& desc = frame.routine->locals[index];
    const StateKeepers& keepers = host_.stateKeepers();
    const SavedLocal now = takeLocal(frame, index, task.frames(), {task, data_, keepers});
    const auto differs = [&desc](const char* how) { return fmt::format("'{}' {}", desc.name, how); };
    if (now.type != saved.type) return differs("has a different type or size");
    if (now.kind != saved.kind) return differs("is not what it was");
    switch (saved.kind) {
    case SavedLocal::Kind::Absent:
    case SavedLocal::Kind::Fresh: return {};
    case SavedLocal::Kind::Object:
        if (now.object == saved.object && now.offset == saved.offset) return {};
        return differs("refers to other data");
    case SavedLocal::Kind::Copy:
    case SavedLocal::Kind::Value: break;
    }
    if (now.value == saved.value) return {};
    void* address = frame.addresses[index];
    if (desc.kind == LocalDesc::Reference) address = *static_cast<void**>(address);
    if (!task.ownsAddress(address)) return differs("has another value"); // a constant
    uint64_t elements = 1;
    for (uint32_t k = 0; k < desc.rank; ++k)
        elements *= static_cast<uint64_t>(*static_cast<const int32_t*>(frame.addresses[index + 1 + k]));
    return imageToValue(saved.value, address, *desc.type, elements, keepers) ? ""
                                                                             : differs("has no such value");
}

Status Reentry::failed(Task& task) {
    return giveUp(task, "an instruction that had called a routine failed");
}

Status Reentry::giveUp(Task& task, const std::string& why) {
    host_.log().write(EventId::PointerLost, &task, {task.name(), place_, why});
    return task.abandonReentry();
}

} // namespace rt

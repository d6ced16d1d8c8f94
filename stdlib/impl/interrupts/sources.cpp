// Manual 1.11: interrupts from persistents and from the event log, and what a trap can ask about its cause.

#include "runtime/abi/support_natives.h"
#include "stdlib/impl/interrupts/ordering.h"
#include "stdlib/impl/support/data_names.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/support/utf8.h"

#include "natives/interrupts.h"
#include "stdlib_constants.h"

#include <array>
#include <cstring>
#include <memory>
#include <optional>
#include <vector>

using namespace rt;

namespace {

constexpr int kNumbersPerDomain = 10'000; // event number = domain * 10000 + number

/// A persistent and the value it had when it was looked at last.
class WatchedData {
  public:
    WatchedData(const void* data, const TypeDesc* type)
        : data_(data), type_(type),
          last_(static_cast<const char*>(data), static_cast<const char*>(data) + type->size) {}

    /// True when the value is another one since the last call. Equal bytes are an equal value; other bytes may be one
    /// too (what follows the end of a string).
    bool changed() {
        if (std::memcmp(data_, last_.data(), last_.size()) == 0) return false;
        const bool other = !rt_anyEqual(data_, last_.data(), type_);
        std::memcpy(last_.data(), data_, last_.size());
        return other;
    }

  private:
    const void* data_;
    const TypeDesc* type_;
    std::vector<char> last_;
};

int domainOf(const Event& event) {
    return event.number / kNumbersPerDomain;
}

struct ErrorFilter {
    float domain = k::COMMON_ERR; ///< COMMON_ERR: all
    float type = k::TYPE_ALL;     ///< TYPE_ALL: all
    std::optional<float> number;  ///< within the domain

    bool takes(const Event& event) const {
        return (domain == k::COMMON_ERR || domain == static_cast<float>(domainOf(event))) &&
               (type == k::TYPE_ALL || type == static_cast<float>(event.type)) &&
               (!number || *number == static_cast<float>(event.number % kNumbersPerDomain));
    }
};

InterruptOrder persistentOrder(const Task& task, const void* data) {
    std::string name = lib::nameOfData(task.controller(), data);
    if (name.empty()) return {};
    return {lib::kPersistentOrder, std::move(name), {}};
}

void assignCut(String* text, std::string_view value) {
    if (text != nullptr) text->assign(lib::cutToString(value));
}

} // namespace

extern "C" {

Status rt_IPers(TaskCore* core, bool Single, bool SingleSafe, void* Name, const TypeDesc* NameType,
                float* Interrupt) {
    Task& task = taskOf(core);
    Scheduler& scheduler = task.scheduler();
    Status status = kOk;
    const int number = lib::numberToOrder(core, Interrupt, status);
    if (status != kOk) return status;
    // Of a part the whole persistent is watched: any change of it counts.
    const GlobalDesc* data = lib::dataAt(task.controller(), Name);
    const auto watched = data != nullptr ? std::make_shared<WatchedData>(data->address, data->type)
                                         : std::make_shared<WatchedData>(Name, NameType);
    const EventToken watch = scheduler.watchData([&task, number, watched] {
        if (watched->changed()) task.interrupts().post(number);
    });
    return lib::orderInterrupt(
        core, number, {Single, SingleSafe}, [&scheduler, watch] { scheduler.unwatchData(watch); },
        persistentOrder(task, data != nullptr ? data->address : Name));
}

Status rt_IError(TaskCore* core, float ErrorDomain, const float* ErrorId, float ErrorType, float* Interrupt) {
    Task& task = taskOf(core);
    EventLog& log = task.controller().log();
    if (!(ErrorType >= k::TYPE_ALL && ErrorType <= k::TYPE_ERR))
        return lib::fail(core, err::ERR_ARGVALERR,
                         "the type must be TYPE_ALL, TYPE_STATE, TYPE_WARN or TYPE_ERR");
    ErrorFilter filter{ErrorDomain, ErrorType, {}};
    if (ErrorId != nullptr) filter.number = *ErrorId;
    Status status = kOk;
    const int number = lib::numberToOrder(core, Interrupt, status);
    if (status != kOk) return status;
    const uint64_t listener = log.addListener([&task, number, filter](const Event& event) {
        if (filter.takes(event)) task.interrupts().post(number, std::make_shared<const Event>(event));
    });
    return lib::orderInterrupt(
        core, number, {}, [&log, listener] { log.removeListener(listener); },
        {lib::kErrorOrder,
         {},
         {ErrorDomain, ErrorType, filter.number ? 1.0 : 0.0, filter.number.value_or(0)}});
}

/// A trapdata holds the sequence number of the event; -1 when something else caused the trap.
Status rt_GetTrapData(TaskCore* core, Handle* TrapEvent) {
    const InterruptTable& interrupts = taskOf(core).interrupts();
    if (!interrupts.inTrap())
        return lib::fail(core, err::ERR_ARGVALERR, "GetTrapData can be used in a trap routine only");
    const auto event = std::static_pointer_cast<const Event>(interrupts.cause());
    *TrapEvent = event ? static_cast<Handle>(event->sequence) : -1;
    return kOk;
}

Status rt_ReadErrData(TaskCore* core, Handle* TrapEvent, float* ErrorDomain, float* ErrorId, float* ErrorType,
                      String* Title, String* Str1, String* Str2, String* Str3, String* Str4, String* Str5) {
    if (*TrapEvent == 0)
        return lib::fail(core, err::ERR_ARGVALERR,
                         "the trapdata variable is empty; call GetTrapData in the trap routine first");
    const Event* event =
        *TrapEvent < 0 ? nullptr : taskOf(core).controller().log().find(static_cast<uint64_t>(*TrapEvent));
    if (event == nullptr)
        return lib::fail(core, err::ERR_ARGVALERR,
                         *TrapEvent < 0
                             ? "this trap was not caused by an event; only IError orders such interrupts"
                             : "the event is not kept in the event log any more");
    *ErrorDomain = static_cast<float>(domainOf(*event));
    *ErrorId = static_cast<float>(event->number % kNumbersPerDomain);
    *ErrorType = static_cast<float>(event->type);
    assignCut(Title, event->title);
    const std::array<String*, 5> texts = {Str1, Str2, Str3, Str4, Str5};
    for (std::size_t i = 0; i < texts.size(); ++i)
        assignCut(texts[i], i < event->arguments.size() ? std::string_view(event->arguments[i]) : "");
    return kOk;
}
}

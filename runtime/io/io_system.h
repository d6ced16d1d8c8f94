#pragma once
// IoSystem: the signals of the controller (manual 1.9, 2.10) with their limits, cross connections, delays and
// pulses. Inputs change by stimulus and cross connections only. A signal's handle in a program is its id + 1.

#include "runtime/abi/rt_abi.h"
#include "runtime/base/time.h"
#include "runtime/io/cfg_parser.h"
#include "runtime/io/io_devices.h"
#include "runtime/sched/wait_queue.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace rt {

class Scheduler;

enum class SignalType : uint8_t { DI, DO, AI, AO, GI, GO };
const char* signalTypeName(SignalType type); ///< "DI"
inline bool isInput(SignalType type) {
    return type == SignalType::DI || type == SignalType::AI || type == SignalType::GI;
}
inline bool isDigital(SignalType type) {
    return type == SignalType::DI || type == SignalType::DO;
}
inline bool isAnalog(SignalType type) {
    return type == SignalType::AI || type == SignalType::AO;
}
inline bool isGroup(SignalType type) {
    return type == SignalType::GI || type == SignalType::GO;
}

/// A signal as configured (EIO_SIGNAL).
struct SignalConfig {
    std::string name;
    SignalType type = SignalType::DI;
    std::string device;    ///< "" = virtual
    std::string deviceMap; ///< as written: "7", "0-15"
    std::string label, category, access = "Default";
    uint32_t bits = 1; ///< width of a group, from DeviceMap; 1 for digital
    double defaultValue = 0;
    double minValue = 0, maxValue = 1; ///< logical limits; analog without MaxLog: no limits
    bool store = false;                ///< keeps its value over a power failure (Store)
    bool writable = true;              ///< a RAPID program may set it (Access, EIO_ACCESS)
    std::string file;
    uint32_t line = 0;
};

using SignalId = int32_t; ///< from 0; -1 = none

enum class IoResult : uint8_t {
    Ok,
    NoSignal,      ///< a variable not connected with AliasIO, or a signal that no configuration defines
    OutOfRange,    ///< value outside the logical limits (ERR_AO_LIM, ERR_GO_LIM), nothing was changed
    NotWritable,   ///< an input, or Access does not let RAPID write
    BadTime,       ///< delay or pulse length outside what is allowed (ERR_ARGVALERR)
    TooManyDelays, ///< 20 signals are delayed already
    DeviceOff,     ///< its I/O device is deactivated or without contact (ERR_NORUNUNIT)
    NotValid,      ///< the network does not vouch for its value (ERR_SIG_NOT_VALID)
};

enum class CrossOperator : uint8_t { And, Or };
struct CrossActor {
    SignalId signal = -1;
    bool inverted = false;
};
/// Result := actor1 op1 actor2 op2 ... from left to right.
struct CrossConnection {
    std::string name;
    SignalId result = -1;
    std::vector<CrossActor> actors;
    std::vector<CrossOperator> operators; ///< one less than actors
};

class IoSystem {
  public:
    static constexpr std::size_t kMaxDelays = 20;
    /// Longest delay and pulse accepted by setDelayed and pulse: 0.001 to 2000 s.
    static constexpr Time kMinSpan = kMillisecond;
    static constexpr Time kMaxSpan = 2000 * kSecond;

    explicit IoSystem(Scheduler& scheduler);
    ~IoSystem();
    IoSystem(const IoSystem&) = delete;
    IoSystem& operator=(const IoSystem&) = delete;

    // ---- Configuration ------------------------------------------------------------------------------------
    /// Takes the signals, access levels and cross connections of files of domain EIO. A signal defined again
    /// replaces the earlier one of the same name and type. Cross connections are resolved by the call to
    /// finishConfiguration.
    void configure(const CfgFile& file, std::vector<CfgProblem>& problems);
    /// Resolves and checks cross connections (unknown signals, loops), sets their results once.
    void finishConfiguration(std::vector<CfgProblem>& problems);
    /// Adds one signal; -1 when the name is taken.
    SignalId addSignal(SignalConfig config);
    /// Adds one connection between existing signals; false (and nothing added) when it would make a loop.
    bool addCrossConnection(CrossConnection connection);

    // ---- Names and handles --------------------------------------------------------------------------------
    /// Without regard to case; -1 when unknown.
    SignalId find(std::string_view name) const;
    std::size_t size() const { return signals_.size(); }
    const SignalConfig& config(SignalId id) const;
    static Handle handleOf(SignalId id) { return id + 1; }
    /// -1 for a handle that is not a signal.
    SignalId idOf(Handle handle) const;
    /// The handle of a signal that the program names and no configuration defines: each use of it fails.
    Handle undefinedHandle(const std::string& name);
    /// The name of such a signal; empty for other handles.
    std::string undefinedName(Handle handle) const;

    // ---- Values -------------------------------------------------------------------------------------------
    /// The logical value; digital 0 or 1, group an integer. The id must be valid.
    double value(SignalId id) const;
    /// Value by handle; 0 and result NoSignal for a bad handle.
    double read(Handle handle, IoResult& result) const;
    /// Whether the signal can have this value; `forOutput`: and a program may set it.
    IoResult check(Handle handle, double value, bool forOutput) const;
    /// A RAPID program sets an output now. Cancels a pending delayed change and a running pulse of it.
    /// Digital: every value but 0 acts as 1.
    IoResult set(Handle handle, double value);
    /// SetDO \SDelay and the like: the value is set `delay` later; the program continues.
    IoResult setDelayed(Handle handle, double value, Time delay);
    /// PulseDO: inverted (or high, with `high`) for `length`; the program continues.
    IoResult pulse(Handle handle, Time length, bool high);
    /// InvertDO.
    IoResult invert(Handle handle);
    /// Power has returned (manual 2.10): outputs get their start value, except those with Store; delays and pulses are gone.
    void powerOn();
    /// Stimulus, client, test bench: any signal, limits checked, access not. Cancels pending changes as set
    /// does.
    IoResult force(SignalId id, double value);

    /// A person or client simulates the signal. The value of a simulated input is that of setByClient() alone; what the plant
    /// says meanwhile (stimulus, cross connections) is kept, and is its value when the simulation ends. An output keeps
    /// following the program: on a controller its device does not receive it, and a virtual controller has none.
    void simulate(SignalId id, bool on);
    bool isSimulated(SignalId id) const;
    /// As force(), but a simulated input takes the value, too.
    IoResult setByClient(SignalId id, double value);

    /// The devices that the signals belong to. Programs can neither read nor set signals of a device that is deactivated or has
    /// lost contact; their values stay.
    IoDevices& devices() { return devices_; }
    const IoDevices& devices() const { return devices_; }
    /// Programs can neither read nor set a signal that is not valid; its value stays.
    void setValid(SignalId id, bool valid);
    /// Ok when a program may read the signal now.
    IoResult access(Handle handle) const;

    // ---- Changes ------------------------------------------------------------------------------------------
    /// Notified after each change of the signal's value, and of whether programs may read it.
    WaitQueue& changed(SignalId id);
    using Listener = std::function<void(SignalId, double oldValue, double newValue)>;
    /// Called at each change of this signal (all signals: id -1), at the virtual time of the change. Returns
    /// a number for removeListener, which may be called from within a listener.
    uint64_t addListener(SignalId id, Listener listener);
    void removeListener(uint64_t number);

  private:
    struct Signal;
    struct ListenerEntry {
        uint64_t number = 0; ///< 0: removed while listeners were being called
        SignalId signal = -1;
        Listener call;
    };
    struct PendingConnection {
        CfgInstance instance;
        std::string file;
    };

    Signal* byHandle(Handle handle);
    /// Brings a value to the form the signal has; OutOfRange when it has no such value.
    static IoResult normalise(const SignalConfig& config, double& value);
    IoResult checkWrite(Handle handle, double& value, Signal*& signal);
    void cancelPending(Signal& signal);
    void setReachable(std::string_view device, bool reachable);
    void change(SignalId id, double value, bool propagate);
    void assign(SignalId id, double value, bool propagate);
    void propagateFrom(SignalId id);
    double evaluate(const CrossConnection& connection) const;
    bool reaches(SignalId from, SignalId to) const;
    void configureSignal(const CfgInstance& instance, const std::string& file,
                         std::vector<CfgProblem>& problems);
    void resolveConnection(const PendingConnection& pending, std::vector<CfgProblem>& problems);
    SignalId crossSignal(const PendingConnection& pending, const std::string& attribute,
                         std::vector<CfgProblem>& problems) const;

    Scheduler& scheduler_;
    IoDevices devices_{[this](std::string_view device, bool reachable) { setReachable(device, reachable); }};
    std::vector<std::unique_ptr<Signal>> signals_;
    std::unordered_map<std::string, SignalId> names_; // upper case
    std::vector<std::string> undefined_;              // of handle -1, -2, ...
    std::vector<CrossConnection> connections_;
    std::vector<PendingConnection> pendingConnections_;
    std::unordered_map<std::string, bool> accessLevels_; // upper case -> RAPID may write
    std::vector<ListenerEntry> listeners_;
    uint64_t lastListener_ = 0;
    int calling_ = 0; // depth of listener calls
    std::size_t delayed_ = 0;
};

} // namespace rt

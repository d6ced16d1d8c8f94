// Sensor Interface: SenDevice, ReadVar, WriteVar and their like; IVarValue; SCWrite.

#include "stdlib/impl/interrupts/ordering.h"
#include "stdlib/impl/sensors/simulated_sensor.h"
#include "stdlib/impl/support/fail.h"
#include "stdlib/impl/system/whole_file.h"

#include "runtime/base/text_util.h"
#include "runtime/sim/surroundings.h"

#include "natives/sensors.h"
#include "stdlib_constants.h"

#include <fmt/format.h>

#include <cmath>
#include <optional>

using namespace rt;
using lib::SimulatedSensor;

namespace {

constexpr Time kExchange = 10 * kMillisecond; // a question and its answer
constexpr Time kSilence = kSecond;            // until an answer is given up
constexpr float kMostVariable = 65535;
constexpr int32_t kMostAtOnce = 6;

/// The connected sensor; null and SEN_UNKNOWN in `status` when there is none.
SimulatedSensor* connected(TaskCore* task, const String* device, Status& status) {
    SimulatedSensor* sensor = taskOf(task).controller().service<lib::SimulatedSensors>().find(device->view());
    if (sensor == nullptr)
        status =
            lib::fail(task, err::SEN_UNKNOWN,
                      fmt::format("\"{}\" is not a sensor that SenDevice has connected", device->view()));
    return sensor;
}

/// A message to the sensor and its answer: takes time, and may be refused by a fault.
SimulatedSensor* exchange(TaskCore* task, const String* device, Status& status) {
    SimulatedSensor* sensor = connected(task, device, status);
    if (sensor == nullptr) return nullptr;
    const Status fault = sensor->fault();
    if ((status = taskOf(task).sleepFor(fault == err::SEN_TIMEOUT ? kSilence : kExchange)) != kOk)
        return nullptr;
    if (fault == kOk) return sensor;
    status = lib::fail(task, fault,
                       fault == err::SEN_TIMEOUT ? sensor->device() + " does not answer"
                                                 : sensor->device() + " answers with a fault");
    return nullptr;
}

Status checkNumber(TaskCore* task, float number, const char* what) {
    if (number >= 0 && number <= kMostVariable && number == std::floor(number)) return kOk;
    return lib::fail(task, err::SEN_VALUE,
                     fmt::format("{} has numbers from 0 to {}", what, static_cast<int>(kMostVariable)));
}

Status readOne(TaskCore* task, const SimulatedSensor& sensor, float number, float& value) {
    if (const Status status = checkNumber(task, number, "a sensor variable")) return status;
    const std::optional<double> found = sensor.variable(static_cast<int>(number));
    if (!found)
        return lib::fail(
            task, err::SEN_NO_MEAS,
            fmt::format("{} has not measured variable {}: give it a value in the stimulus ({}.variable_{})",
                        sensor.device(), number, sensor.device(), number));
    value = static_cast<float>(*found);
    return kOk;
}

/// Scale of a sensorvardata; 0, which a program does not fill in, counts as 1.
float scaleOf(const data::Sensorvardata& variable) {
    return variable.unit == 0 ? 1 : variable.unit;
}

SimulatedSensor* exchangeArray(TaskCore* task, const String* device, int32_t count, Status& status) {
    if (count <= kMostAtOnce) return exchange(task, device, status);
    status = lib::fail(task, err::SEN_VALUE,
                       fmt::format("at most {} variables can be exchanged at once", kMostAtOnce));
    return nullptr;
}

/// An order of IVarValue.
struct VariableWatch {
    SimulatedSensor* sensor = nullptr;
    int number = 0, interrupt = 0;
    float* value = nullptr;
    double unit = 1, deadBand = 0;
    std::optional<double> reported;

    void look(Task& task) {
        const std::optional<double> now = sensor->variable(number);
        if (!now || sensor->fault() != kOk) return;
        if (reported && !(std::abs(*now - *reported) > deadBand)) return;
        reported = now;
        *value = static_cast<float>(*now * unit);
        task.scheduler().lookAtData();
        task.interrupts().post(interrupt);
    }
};

} // namespace

extern "C" {

Status rt_SenDevice(TaskCore* task, const String* device) {
    Controller& controller = taskOf(task).controller();
    if (controller.service<lib::SimulatedSensors>().connect(controller, device->view()))
        return taskOf(task).sleepFor(kExchange);
    return lib::fail(task, err::ERR_COMM_INIT_FAILED,
                     fmt::format("SIO.cfg has no COM_TRP named \"{}\" for a sensor", device->view()));
}

Status rt_ReadVar(TaskCore* task, float* result, const String* device, float VarNo, const String*) {
    Status status = kOk;
    const SimulatedSensor* sensor = exchange(task, device, status);
    return sensor == nullptr ? status : readOne(task, *sensor, VarNo, *result);
}

Status rt_WriteVar(TaskCore* task, const String* device, float VarNo, float VarData, const String*) {
    Status status = kOk;
    SimulatedSensor* sensor = exchange(task, device, status);
    if (sensor == nullptr) return status;
    if ((status = checkNumber(task, VarNo, "a sensor variable")) != kOk) return status;
    sensor->setVariable(static_cast<int>(VarNo), VarData);
    return kOk;
}

/// All or none: a variable without a value leaves the others as they are.
Status rt_ReadVarArr(TaskCore* task, const String* Device, data::Sensorvardata* Data, int32_t DataDim1,
                     const String*) {
    Status status = kOk;
    const SimulatedSensor* sensor = exchangeArray(task, Device, DataDim1, status);
    if (sensor == nullptr) return status;
    float values[kMostAtOnce] = {};
    for (int32_t i = 0; i < DataDim1; ++i)
        if ((status = readOne(task, *sensor, Data[i].varNumber, values[i])) != kOk) return status;
    for (int32_t i = 0; i < DataDim1; ++i)
        Data[i].value = values[i] * scaleOf(Data[i]);
    return kOk;
}

Status rt_WriteVarArr(TaskCore* task, const String* Device, data::Sensorvardata* Data, int32_t DataDim1,
                      const String*) {
    Status status = kOk;
    SimulatedSensor* sensor = exchangeArray(task, Device, DataDim1, status);
    if (sensor == nullptr) return status;
    for (int32_t i = 0; i < DataDim1; ++i)
        if ((status = checkNumber(task, Data[i].varNumber, "a sensor variable")) != kOk) return status;
    for (int32_t i = 0; i < DataDim1; ++i)
        sensor->setVariable(static_cast<int>(Data[i].varNumber), Data[i].value / scaleOf(Data[i]));
    return kOk;
}

/// A block that no program has written is not there.
Status rt_ReadBlock(TaskCore* task, const String* device, float BlockNo, const String* FileName,
                    const String*) {
    Status status = kOk;
    const SimulatedSensor* sensor = exchange(task, device, status);
    if (sensor == nullptr) return status;
    if ((status = checkNumber(task, BlockNo, "a data block")) != kOk) return status;
    const std::string* block = sensor->block(static_cast<int>(BlockNo));
    if (block == nullptr)
        return lib::fail(
            task, err::SEN_UNKNOWN,
            fmt::format("{} has no data block {}: WriteBlock makes one", sensor->device(), BlockNo));
    const std::string problem = lib::writeWhole(taskOf(task).controller(), FileName->view(), *block);
    return problem.empty() ? kOk : lib::fail(task, err::ERR_FILEACC, problem);
}

Status rt_WriteBlock(TaskCore* task, const String* device, float BlockNo, const String* FileName,
                     const String*) {
    Status status = kOk;
    SimulatedSensor* sensor = exchange(task, device, status);
    if (sensor == nullptr) return status;
    if ((status = checkNumber(task, BlockNo, "a data block")) != kOk) return status;
    std::string bytes;
    const std::string problem = lib::readWhole(taskOf(task).controller(), FileName->view(), bytes);
    if (!problem.empty()) return lib::fail(task, err::ERR_FILEACC, problem);
    sensor->setBlock(static_cast<int>(BlockNo), std::move(bytes));
    return kOk;
}

/// \ReportAtTool, \SpeedAdapt and \APTR concern the way between sensor and tool, which is not simulated.
Status rt_IVarValue(TaskCore* core, const String* device, float VarNo, float* Value, float* Interrupt,
                    const float* Unit, const float* DeadBand, bool, const float*, bool) {
    Status status = kOk;
    SimulatedSensor* sensor = connected(core, device, status);
    if (sensor == nullptr) return status;
    if ((status = checkNumber(core, VarNo, "a sensor variable")) != kOk) return status;
    if (DeadBand != nullptr && !(*DeadBand >= 0))
        return lib::fail(core, err::ERR_ARGVALERR, "IVarValue: \\DeadBand must not be negative");
    Task& task = taskOf(core);
    const int number = lib::numberToOrder(core, Interrupt, status);
    if (status != kOk) return status;
    const auto watch = std::make_shared<VariableWatch>();
    *watch = {sensor,
              static_cast<int>(VarNo),
              number,
              Value,
              Unit != nullptr ? static_cast<double>(*Unit) : 1.0,
              DeadBand != nullptr ? static_cast<double>(*DeadBand) : 0.0,
              sensor->variable(static_cast<int>(VarNo))};
    auto& around = task.controller().service<Surroundings>();
    const uint64_t listener = around.addListener([&task, watch](const Surroundings::Name& name, double) {
        if (sameName(name.unit, watch->sensor->device())) watch->look(task);
    });
    return lib::orderInterrupt(core, number, {}, [&around, listener] { around.removeListener(listener); },
                               {});
}

/// There is no superior computer to send to.
Status rt_SCWrite(TaskCore* task, const String* ToNode, const void*, const TypeDesc*) {
    return lib::fail(
        task, err::ERR_SC_WRITE,
        ToNode != nullptr
            ? fmt::format("no external computer \"{}\" is connected with this controller", ToNode->view())
            : std::string("no external computer is connected with this controller"));
}
}

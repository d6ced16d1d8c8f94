#pragma once
// RapidExchange: signals and data of a program that travel with the messages of EGM (\DOToSensor, \DIFromSensor, \DataToSensor,
// \DataFromSensor).

#include "stdlib/impl/guided_motion/partner.h"

#include "runtime/host/controller.h"

#include <cstdint>
#include <string>

namespace rt::lib {

/// Persistents are kept by name, so that those of a module that is unloaded are left out.
struct RapidExchange {
    SignalId output = -1, input = -1; ///< -1: none
    std::string sent, received;       ///< "Main:numbers", an array of dnum; "": none

    /// Adds what is sent.
    void send(const Task& task, RobotData& data) const;
    /// Takes over what has come; what does not concern RAPID stays.
    void receive(const Task& task, const SensorData& data) const;
};

} // namespace rt::lib

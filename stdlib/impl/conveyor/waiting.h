#pragma once
// Waiting for objects of conveyors and sensors, and dropping them.

#include "runtime/host/conveyors.h"
#include "runtime/sched/task.h"

namespace rt::lib {

/// Arguments of WaitWObj and WaitSensor; null: not given.
struct ObjectWait {
    const float* distance = nullptr; ///< mm from the origin that the object has to have come
    const float* maxTime = nullptr;  ///< s
    bool* flag = nullptr;            ///< becomes TRUE at a time-out
    double leadTime = 0;             ///< s before the object is there
};

/// Connects the first object in the start window, waiting for one. Raises ERR_CNV_NOT_ACT, ERR_CNV_CONNECT, ERR_CNV_DROPPED,
/// ERR_WAIT_MAXTIME.
Status waitForObject(TaskCore* task, Conveyor& conveyor, const ObjectWait& wait);
/// ERR_CNV_NOT_ACT. A robot that follows the object stops on its path.
Status dropObject(TaskCore* task, Conveyor& conveyor);

} // namespace rt::lib

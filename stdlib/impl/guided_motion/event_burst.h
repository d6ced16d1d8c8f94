#pragma once
// EventBurst: one event for many faults that follow each other closely.

#include "runtime/base/time.h"

namespace rt::lib {

class EventBurst {
  public:
    /// A fault at this time: true when it begins a burst, so that it is to be reported.
    bool begins(Time now) {
        const bool isFirst = last_ == kNever || (isOver_ && now - last_ >= kPause) || now - last_ >= kSilence;
        last_ = now;
        isOver_ = false;
        return isFirst;
    }
    /// Something without fault has come.
    void note() { isOver_ = true; }

  private:
    static constexpr Time kPause = 100 * kMillisecond; // faults and good ones may alternate
    static constexpr Time kSilence = kSecond;
    Time last_ = kNever;
    bool isOver_ = false;
};

} // namespace rt::lib

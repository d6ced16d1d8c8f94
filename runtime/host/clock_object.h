#pragma once
// ClockObject: RAPID's clock, a stop-watch on virtual time (manual 1.14).

#include "runtime/base/time.h"

namespace rt {

class ClockObject {
  public:
    /// Starting a running clock changes nothing.
    void start(Time now) {
        if (!running_) started_ = now;
        running_ = true;
    }
    void stop(Time now) {
        if (running_) kept_ += now - started_;
        running_ = false;
    }
    /// To zero; a running clock continues from there.
    void reset(Time now) {
        kept_ = 0;
        started_ = now;
    }
    Time elapsed(Time now) const { return kept_ + (running_ ? now - started_ : 0); }
    bool running() const { return running_; }
    /// The clock of an earlier process: no time passes in between.
    void restore(Time elapsed, bool running, Time now) {
        kept_ = elapsed;
        started_ = now;
        running_ = running;
    }

  private:
    Time kept_ = 0, started_ = 0;
    bool running_ = false;
};

} // namespace rt

#pragma once
// SystemSignals: system inputs and system outputs of EIO.cfg.

#include "runtime/host/system_inputs.h"
#include "runtime/host/system_outputs.h"

namespace rt {

struct SystemSignals {
    explicit SystemSignals(Controller& controller) : inputs(controller), outputs(controller) {}

    void configure(const CfgFile& file, std::vector<CfgProblem>& problems) {
        inputs.configure(file, problems);
        outputs.configure(file, problems);
    }

    SystemInputs inputs;
    SystemOutputs outputs;
};

} // namespace rt

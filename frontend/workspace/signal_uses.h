#pragma once
// Signals that a program uses and no configuration defines: their types and widths from the instructions, functions and
// signal types they are used with. Written as EIO parameters by `rapidc signals` and assumed by --assume-signals.

#include "frontend/sema/checked.h"

#include <string>
#include <vector>

namespace rapid::workspace {

struct UsedSignal {
    std::string name;
    std::string type;          ///< "DI", "DO", "AI", "AO", "GI", "GO"
    unsigned bits = 0;         ///< of a group: 8, 16 or 32
    std::string contradiction; ///< "GO in task 'T_BG'": another task uses it as this; else empty
};

/// In the order of their names; `configured` ones are left out. The widths need the facts about the inside of routines (CheckOptions::onlyDiagnostics).
std::vector<UsedSignal> usedSignals(const sema::CheckedProgram& program,
                                    const std::vector<sema::SignalInfo>& configured);

/// An EIO.cfg that defines them as signals without a device.
std::string writeSignals(const std::vector<UsedSignal>& signals);

/// "3 signals are assumed: 2 DI, 1 GO".
std::string describeSignals(const std::vector<UsedSignal>& signals);

} // namespace rapid::workspace

#pragma once
// How clients name the kinds of the operator's dialogs, and which numbers they may answer.

#include "runtime/sim/operator_panel.h"

#include <cmath>

namespace rapidc::service {

inline const char* nameOf(rt::DialogKind kind) {
    switch (kind) {
    case rt::DialogKind::Choice: return "choice";
    case rt::DialogKind::Number: return "number";
    case rt::DialogKind::Text: return "text";
    case rt::DialogKind::List: break;
    }
    return "list";
}

/// Whether the dialog takes that number: it is within the limits, and whole where it must be.
inline bool takesNumber(const rt::Dialog& dialog, double value) {
    const auto stored = [&dialog](double each) {
        return dialog.isDnum ? each : static_cast<double>(static_cast<float>(each));
    };
    const double entered = stored(value);
    if (!std::isfinite(entered) || (dialog.isWhole && std::trunc(entered) != entered)) return false;
    return !(dialog.least && entered < stored(*dialog.least)) &&
           !(dialog.most && entered > stored(*dialog.most));
}

} // namespace rapidc::service

#pragma once
// How clients name the kinds of the operator's dialogs, and which numbers, items and buttons they may answer.

#include "runtime/sim/operator_panel.h"

#include <cmath>
#include <string>
#include <vector>

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

/// Whether the place from 1 is one of those shown: an empty text is not.
inline bool isShown(const std::vector<std::string>& texts, std::size_t place) {
    return place >= 1 && place <= texts.size() && !texts[place - 1].empty();
}

/// Whether the list shows that item, from 1.
inline bool showsItem(const rt::Dialog& dialog, std::size_t item) {
    return isShown(dialog.items, item);
}

/// Whether the dialog shows that button, from 1.
inline bool showsButton(const rt::Dialog& dialog, std::size_t button) {
    return isShown(dialog.choices, button);
}

} // namespace rapidc::service

#pragma once
// How clients name the kinds of the operator's dialogs.

#include "runtime/sim/operator_panel.h"

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

} // namespace rapidc::service

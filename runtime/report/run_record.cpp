#include "runtime/report/run_record.h"

#include <algorithm>
#include <fmt/format.h>

namespace rt::report {

const Move* RobotRecord::find(uint64_t number) const {
    const auto found = std::lower_bound(moves.begin(), moves.end(), number,
                                        [](const Move& move, uint64_t n) { return move.number < n; });
    return found != moves.end() && found->number == number ? &*found : nullptr;
}

std::string placeName(const Move& move) {
    if (move.place.line == 0) return fmt::format("movement {}", move.number);
    return fmt::format("{}:{}", move.place.module, move.place.line);
}

std::string pointName(const Move& move) {
    if (move.text.isName) return move.text.target;
    if (move.place.line != 0) return fmt::format("line {}", move.place.line);
    return fmt::format("movement {}", move.number);
}

std::string instructionName(const Move& move) {
    if (!move.text.instruction.empty()) return move.text.instruction + " " + move.text.target;
    switch (move.kind) {
    case motion::MoveKind::AbsJoint: return "to axis angles";
    case motion::MoveKind::Joint: return "axis by axis";
    case motion::MoveKind::Linear: return "line";
    case motion::MoveKind::Circular: return "circle";
    }
    return {};
}

} // namespace rt::report

#include "frontend/syntax/recovery/strategy.h"

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/grammar/parts.h"

namespace rapid::syntax {

std::optional<Repair> RecoveryStrategy::nearest(TokenIndex i, std::initializer_list<K> words) const {
    Proposal best;
    for (const K word : words) {
        const unsigned edits = typos().editsTo(i, word);
        if (edits != 0 && (!best || edits < best->cost)) best = keyword(i, i, word, edits);
    }
    return best;
}

Repair RecoveryStrategy::sign(K as, diag::Message<2> message, std::string shown, std::string expected,
                              std::string text) const {
    return {.first = pos(),
            .last = pos(),
            .as = as,
            .next = pos(),
            .code = message.code,
            .range = range(pos()),
            .args = {std::move(shown), std::move(expected)},
            .edit = TextEdit{range(pos()), std::move(text)}};
}

Repair RecoveryStrategy::leaveOutAs(TokenIndex next, diag::Code code, std::vector<std::string> args,
                                    SourceRange text) const {
    return {.first = pos(),
            .last = next - 1,
            .next = next,
            .code = code,
            .range = range(pos()),
            .args = std::move(args),
            .edit = TextEdit{text, ""}};
}

const Repair* Recovery::repair(const Situation& at) {
    if (!table_) {
        table_ = std::make_unique<StrategyTable>();
        addWordStrategies(*table_, parser());
        addListWordStrategies(*table_, parser());
        addStrayWordStrategies(*table_, parser());
        addBlockStrategies(*table_, parser());
        addSignStrategies(*table_, parser());
    }
    std::optional<Repair> best;
    for (const auto& strategy : table_->at(at.place)) {
        if (best && best->cost <= 1) break;
        std::optional<Repair> proposal = strategy->propose(at);
        if (proposal && (!best || proposal->cost < best->cost)) best = std::move(proposal);
    }
    if (!best) return nullptr;
    apply(*best);
    applied_ = std::move(best);
    return &*applied_;
}

void Recovery::apply(const Repair& repair) {
    if (repair.code == diag::say::MisspeltKeyword.code && repair.args.empty() && !repair.silent) {
        moveTo(repair.first);
        typos().readAsKeyword(repair.first, repair.last, repair.as);
    } else if (!repair.silent) {
        diag::Diagnostic* diagnostic = reports().reportCode(repair.code, repair.range, repair.args);
        if (diagnostic && repair.edit && repair.unclear)
            diagnostic->fix(repair.edit->range, repair.edit->replacement, repair.certain);
        else if (repair.edit)
            fix(diagnostic, repair.edit->range, repair.edit->replacement, repair.certain);
        note(diagnostic, repair.noteAt, repair.note);
        if (repair.as != K::Error) readAs(repair.last, repair.as);
    }
    if (repair.mark) mark(*repair.mark, repair.marked == kNoToken ? repair.first : repair.marked);
    if (repair.unclear) reports().noteUnclear(repair.range.begin);
    moveTo(repair.next);
}

} // namespace rapid::syntax

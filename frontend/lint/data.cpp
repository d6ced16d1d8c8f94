// Reading and writing of variables.

#include "frontend/diag/messages/warnings.h"
#include "frontend/lint/walker.h"

namespace rapid::lint {

using namespace syntax;
using sema::DataSymbol;
using sema::TypeKind;

namespace {

const char* initialValue(const sema::DataType& type) {
    if (type.rank > 0) return "zero in all elements";
    switch (type.type->kind) {
    case TypeKind::Bool: return "FALSE";
    case TypeKind::String: return "an empty text";
    case TypeKind::Record: return "zero in all components";
    default: return "0";
    }
}

} // namespace

const DataSymbol* Walker::rootOf(const Expr& place) const {
    const Expr* e = &place;
    while (e->kind == NodeKind::Index || e->kind == NodeKind::Component)
        e = e->kind == NodeKind::Index ? as<IndexExpr>(*e).base : as<ComponentExpr>(*e).base;
    if (e->kind != NodeKind::Name) return nullptr;
    const sema::Symbol* symbol = info(*e).symbol;
    return symbol && symbol->kind == sema::SymbolKind::Data ? static_cast<const DataSymbol*>(symbol)
                                                            : nullptr;
}

void Walker::read(const Expr& name) {
    const DataSymbol* data = rootOf(name);
    if (!data || !isOwn(*data)) return;
    access_[data->index] |= kRead;
    access_[data->index] &= static_cast<uint8_t>(~kUpdated);
    const int16_t slot = slots_[data->index];
    if (slot < 0 || assigned_[static_cast<size_t>(slot)]) return;
    assigned_.set(static_cast<size_t>(slot)); // said once
    pending_.push_back({data, &name, &name == copied_});
}

/// A place that is looked at, but whose value does not matter.
void Walker::mention(const Expr& e) {
    subscripts(e);
    const DataSymbol* data = rootOf(e);
    if (data && isOwn(*data)) access_[data->index] |= kMentioned;
}

/// The expressions inside a place: its indexes.
void Walker::subscripts(const Expr& place) {
    if (place.kind == NodeKind::Component) subscripts(*as<ComponentExpr>(place).base);
    if (place.kind != NodeKind::Index) return;
    const auto& index = as<IndexExpr>(place);
    subscripts(*index.base);
    for (const Expr* i : index.indices)
        expr(*i);
}

// `n := n + 1`, `p.trans.z := 0` and `IF n < 0 n := 0;` whose result is used later make a copy to work with; without that
// they were meant for the caller.
void Walker::inParameter(const DataSymbol& param, const Expr& place, bool fromItself) {
    uint8_t& access = access_[param.index];
    if ((access & kReported) != 0) return;
    if (handlerResumes_ && (access & kRead) != 0) return; // RETRY: the body reads the new value
    const bool seen = fromItself || (access & kRead) != 0;
    if (seen || branchDepth_ > 0) {
        if (seen && loopDepth_ > 0) return; // the next round reads it
        if ((access & kUpdated) == 0) updates_[param.index] = &place;
        access |= kUpdated;
        return;
    }
    access |= kReported;
    access &= static_cast<uint8_t>(~kUpdated);
    report(say::ParameterAssigned, range(place), {param.name});
}

void Walker::write(const Expr& place, uint8_t access, bool fromItself) {
    const DataSymbol* data = rootOf(place);
    if (!data) return;
    writes_.push_back(data);
    if (!isOwn(*data)) return;
    access_[data->index] |= access;
    const bool assignment = (access & (kAssigned | kFromCall)) != 0;
    if (assignment && data->storage == sema::Storage::Parameter && data->mode == ParamMode::In)
        inParameter(*data, place, fromItself || place.kind == NodeKind::Component);
    else
        access_[data->index] &= static_cast<uint8_t>(~kUpdated); // passed on
    const int16_t slot = slots_[data->index];
    if (slot < 0) return;
    assigned_.set(static_cast<size_t>(slot));
    written_.set(static_cast<size_t>(slot));
}

void Walker::usedTooEarly(const DataSymbol& data, const Expr& e) {
    if ((access_[data.index] & kReported) != 0) return;
    access_[data.index] |= kReported;
    if (diag::Diagnostic* d =
            report(say::UsedBeforeAssignment, range(e), {data.name, initialValue(data.type)}))
        d->notes.push_back(
            {tree_->source, tree_->range(data.nameToken), "'" + data.name + "' is declared here"});
}

} // namespace rapid::lint

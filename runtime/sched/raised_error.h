#pragma once
// RaisedError: an error and where it was raised, described only when something asks. A program may raise and handle millions;
// most of them leave no trace.

#include "runtime/abi/rt_abi.h"
#include "runtime/base/source_place.h"

#include <memory>
#include <optional>
#include <string>

namespace rt {

class EventLog;

class RaisedError {
  public:
    /// None yet: no text, no place.
    RaisedError() = default;
    /// At the statement in progress of `at`, which may be null. `detail`: why; "" takes the meaning of the number. Only the
    /// descriptor of the routine is kept, not the frame record: descriptors stay when their module leaves memory, because
    /// the code of a unit is never given back (UnitLoader).
    RaisedError(int number, const Frame* at, const std::string& detail) { set(number, at, detail); }
    /// From now on it is that error. In place: an object that is made and moved costs more than all the rest of a raise.
    void set(int number, const Frame* at, const std::string& detail) {
        routine_ = at != nullptr ? at->routine : nullptr;
        statement_ = at != nullptr ? at->statement : -1;
        number_ = number;
        if (note_ != nullptr || !detail.empty()) setDetail(detail);
    }
    /// The part of it that an earlier process kept.
    static RaisedError described(std::string text, SourcePlace place);

    /// From now on it is another error at the same place.
    void renumber(int number, const std::string& detail);

    /// "ERR_DIVZERO (1003): division by zero."
    std::string text(const EventLog& log) const;
    SourcePlace place() const;

    /// Both have the same text and place; false when that takes long to find out.
    bool isLike(const RaisedError& other) const {
        return routine_ == other.routine_ && statement_ == other.statement_ && number_ == other.number_ &&
               hasNoteLike(other);
    }

  private:
    void setDetail(const std::string& detail);
    /// The part that few errors have.
    struct Note {
        std::string text;                 ///< the detail, or all of it
        std::optional<SourcePlace> place; ///< instead of the routine's
        bool isWhole;
    };
    bool hasNoteLike(const RaisedError& other) const {
        if (note_ == nullptr || other.note_ == nullptr) return note_ == other.note_;
        return !note_->place && !other.note_->place && note_->text == other.note_->text;
    }
    static constexpr int kNone = -1; // numbers of errors are not negative

    const RoutineDesc* routine_ = nullptr;
    int32_t statement_ = -1;
    int number_ = kNone;
    std::shared_ptr<const Note> note_; ///< null: only what the number means
};

} // namespace rt

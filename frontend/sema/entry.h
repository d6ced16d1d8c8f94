#pragma once
// Finds the routine that a task begins with.

#include "frontend/sema/part.h"

namespace rapid::sema {

class EntryCheck : CheckerPart {
  public:
    EntryCheck(State& state, const Parts& parts);
    /// Sets Task::entryRoutine, or says why there is none.
    void checkEntry(Task& task);

  private:
    const Symbol* localEntry(const Task& task, NameId name);

    UnknownNames& unknown_;
};

} // namespace rapid::sema

#pragma once
// SourceRequests: modules in program memory, their files, and texts that lie in rapidc itself.

#include "tools/rapidc/dap/context.h"

namespace rapidc::dap {

class SourceRequests {
  public:
    explicit SourceRequests(Context& context) : context_(context) {}
    void addTo(Handlers& handlers);

  private:
    Json source(const Arguments& arguments);
    Json loadedSources(const Arguments& arguments);
    Json modules(const Arguments& arguments);

    Context& context_;
};

/// Number of a text of the standard library by its name, from 1; 0: there is none.
int64_t libraryReference(std::string_view name);

} // namespace rapidc::dap

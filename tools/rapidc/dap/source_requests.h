#pragma once
// SourceRequests: modules in program memory, their files, and texts that lie in rapidc itself.

#include "tools/rapidc/dap/context.h"

#include <set>
#include <string>

namespace rapidc::dap {

class SourceRequests {
  public:
    explicit SourceRequests(Context& context) : context_(context) {}
    void addTo(Handlers& handlers);
    /// A program was made: its sources are known from the answer to loadedSources.
    void programMade();
    /// Quick: a different number of modules than at the last look() is in memory.
    bool hasOtherCount() const;
    /// Sends the event loadedSource for each file that has come into memory or left it since the last call.
    void look();

  private:
    Json source(const Arguments& arguments);
    Json loadedSources(const Arguments& arguments);
    Json modules(const Arguments& arguments);

    std::set<std::string> files() const;

    Context& context_;
    std::set<std::string> known_;
    std::size_t count_ = 0; ///< modules in memory at the last look
};

/// Number of a text of the standard library by its name, from 1; 0: there is none.
int64_t libraryReference(std::string_view name);

} // namespace rapidc::dap

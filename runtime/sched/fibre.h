#pragma once
// Fibre: a call stack of its own on which a task runs (Boost.Context). Suspends and resumes explicitly; never throws across.

#include <cstddef>
#include <functional>
#include <memory>

namespace rt {

class Fibre {
  public:
    /// `body` runs at the first resume(). The stack has a guard page; memory is used as it is touched. Aborts when the
    /// address space for it is not there.
    Fibre(std::size_t stackBytes, std::function<void()> body);
    /// The body must have returned or never have begun; otherwise its stack is left alone (leaked), since unwinding it
    /// would need exceptions through compiled code.
    ~Fibre();
    Fibre(const Fibre&) = delete;
    Fibre& operator=(const Fibre&) = delete;

    /// From outside: runs the body until it suspends or returns.
    void resume();
    /// From within the body: back to whoever resumed.
    void suspend();
    bool started() const;
    bool finished() const;
    /// Lowest address that compiled routines may use: a reserve for natives lies below.
    char* stackLimit() const;
    /// The address lies on this stack.
    bool owns(const void* address) const;

  private:
    struct Impl;
    std::unique_ptr<Impl> impl_;
};

} // namespace rt

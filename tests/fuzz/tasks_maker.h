#pragma once
// Makes programs of two or three tasks from bytes: prints, waits, signals, traps, error and UNDO handlers, movements, persistents,
// semaphores. They print the same in every profile, with the same events and signals at the same times: a task is interrupted
// where time passes or where it calls the system, which is at the same statement in all profiles. Some have two robots, which move
// together between SyncMoveOn and SyncMoveOff. Left out is what differs as
// documented: recursion without end, and errors that a trap routine raises in the interrupted program.

#include "tests/fuzz/program_maker.h"
#include "tests/fuzz/program_runner.h"

#include <string>
#include <vector>

namespace rapid::fuzz {

class TasksMaker {
  public:
    TasksMaker(const uint8_t* data, size_t size) : choose_(data, size) {}
    /// The modules of T_ROB1 and of one or two other tasks.
    TaskTexts make();
    /// How many of them have a robot; two move together now and then. Known after make().
    size_t robots() const { return robots_; }

  private:
    enum class Part : uint8_t { Body, Error, Undo, Trap };

    std::string module(size_t task);
    void writeTrap(size_t number);
    void writeProcedure(size_t number);
    void writeFunction();
    void writeMain();
    void errorHandler(size_t number);

    void statements(size_t count, int depth);
    void statement(int depth);
    void compute();
    void print();
    void wait();
    void waitForTasks();
    void signal();
    void share();
    void critical(int depth);
    void interrupt();
    void fail();
    void call();
    void loop(int depth);
    void branch(int depth);
    void move();
    void stopAndStart();
    void planSections();
    void section(size_t number);
    void moveTogether(int id, bool isStop);
    std::string target();
    void line(const std::string& text);
    void begin(const std::string& head);
    void end(const char* last);

    std::string number();
    std::string value();
    std::string condition();
    std::string seconds();
    std::string digital() { return "do" + std::to_string(1 + choose_.below(2)); }
    std::string local() { return std::string(1, static_cast<char>('a' + choose_.below(3))); }
    std::string shared() { return "shared" + std::to_string(1 + choose_.below(3)); }

    Choices choose_;
    std::string text_;
    std::string counters_;    ///< declarations of the routine that is being written
    size_t declarations_ = 0; ///< their place in text_
    size_t task_ = 0, tasks_ = 0, robots_ = 1, level_ = 0, loops_ = 0;
    std::vector<size_t> sections_; ///< synchronised movements of each section, the same for all robots
    int indent_ = 0, budget_ = 0;
    Part part_ = Part::Body;
};

} // namespace rapid::fuzz

#pragma once
// /rw/rapid/tasks/T/program: name and entry point, loading and saving whole programs (.pgf), breakpoints.

#include "tools/rws/access.h"
#include "tools/rws/router.h"
#include "tools/service/virtual_controller.h"

#include <map>
#include <string>
#include <vector>

namespace rapidc::rws {

class Programs {
  public:
    Programs(service::VirtualController& controller, const Access& access);
    ~Programs();
    Programs(const Programs&) = delete;
    Programs& operator=(const Programs&) = delete;

    void addTo(Router& router);
    /// Whether breakpoints stop the program (stopatbp of a start).
    void setStopping(bool stopping) { stopping_ = stopping; }

  private:
    struct Break {
        std::string task, module;
        uint32_t line = 0, column = 0;
        int id = 0; ///< of the debugger
    };
    void addBreakpoints(Router& router);
    Reply show(const Request& request);
    Reply load(const Request& request);
    Reply save(const Request& request);
    Reply unload(const Request& request);
    Reply setName(const Request& request);
    Reply setEntry(const Request& request);
    Reply listBreaks(const Request& request);
    Reply setBreak(const Request& request);
    Reply removeBreak(const Request& request);
    std::string nameOf(const rt::Task& task) const;
    std::string entryOf(const rt::Task& task) const;
    std::vector<std::string> programModules(const rt::Task& task);
    rt::Breakpoint setInDebugger(const std::string& task, const std::string& module, uint32_t line);
    /// Breakpoints stay when the controller is restarted or the program replaced.
    void setAgain();

    service::VirtualController& controller_;
    const Access& access_;
    service::Observers::Token observer_ = 0;
    std::map<std::string, std::string> names_; ///< that clients gave, by task
    std::vector<Break> breaks_;
    bool stopping_ = true;
};

} // namespace rapidc::rws

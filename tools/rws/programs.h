#pragma once
// /rw/rapid/tasks/T/program: name and entry point, loading and saving whole programs (.pgf), breakpoints.

#include "tools/rws/access.h"
#include "tools/rws/router.h"
#include "tools/service/breakpoint_list.h"

#include <map>
#include <string>
#include <vector>

namespace rapidc::rws {

class Programs {
  public:
    /// All of them must outlive the routes.
    Programs(service::VirtualController& controller, const Access& access,
             service::BreakpointList& breakpoints)
        : controller_(controller), access_(access), breakpoints_(breakpoints) {}
    Programs(const Programs&) = delete;
    Programs& operator=(const Programs&) = delete;

    void addTo(Router& router);

  private:
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

    service::VirtualController& controller_;
    const Access& access_;
    service::BreakpointList& breakpoints_;
    std::map<std::string, std::string> names_; ///< that clients gave, by task
};

} // namespace rapidc::rws

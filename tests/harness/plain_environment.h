#pragma once
// A workspace without a controller: it is given the declarations of the standard library, and nothing else.

#include "frontend/workspace/environment.h"
#include "stdlib/stdlib_text.h"

namespace rapid::testing {

class PlainEnvironment : public workspace::Environment {
  public:
    std::vector<sema::LibraryText> library(bool documented) const override {
        std::vector<sema::LibraryText> texts;
        for (const stdlib::StdlibSource& source : stdlib::sources())
            texts.push_back({source.name, documented ? source.text : source.declarations});
        return texts;
    }
    std::vector<std::string_view> declaredOnly() const override { return {}; }
    std::string robotProblem(const std::string&) const override { return {}; }
    std::string reach(const std::string&, const workspace::TargetNumbers&) const override { return {}; }
    void judgeSignals(std::vector<config::CfgProblem>&, const std::vector<std::string>&,
                      const std::vector<std::string>&) const override {}
    bool isConveyor(std::string_view) const override { return false; }
    workspace::ConveyorNames conveyor(const std::string&) const override { return {}; }
};

} // namespace rapid::testing

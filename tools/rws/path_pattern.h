#pragma once
// PathPattern: "/rw/rapid/tasks/{task}/pcp", compiled. The paths of Robot Web Services consist of few fixed words; letter case makes no
// difference for them.

#include "config/text_util.h"

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rapidc::rws {

using Parameters = std::map<std::string, std::string, std::less<>>;

using rapid::config::splitPath;

class PathPattern {
  public:
    /// {name} takes one segment, {name*} one or more, joined by '/'. At most one {name*}, anywhere in the pattern.
    explicit PathPattern(std::string_view pattern);

    bool matches(const std::vector<std::string>& segments) const;
    /// The parameters of segments that match.
    Parameters parametersOf(const std::vector<std::string>& segments) const;
    /// Fixed segments win over parameters, those over {name*}.
    bool isMoreSpecificThan(const PathPattern& other) const;
    /// The same fixed segments and kinds of parameters, whatever their names.
    bool isSameAs(const PathPattern& other) const;

  private:
    enum class Kind : uint8_t { Fixed, One, Many };
    struct Part {
        Kind kind;
        std::string text; ///< the segment or the name of the parameter
    };
    std::size_t fixedParts() const;
    bool hasMany() const;

    std::vector<Part> parts_;
};

} // namespace rapidc::rws

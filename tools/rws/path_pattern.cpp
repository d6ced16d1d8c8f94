#include "tools/rws/path_pattern.h"

#include "config/letter_case.h"

#include <algorithm>

namespace rapidc::rws {

PathPattern::PathPattern(std::string_view pattern) {
    for (const std::string& segment : splitPath(pattern)) {
        const bool isParameter = segment.size() > 2 && segment.front() == '{' && segment.back() == '}';
        if (!isParameter) {
            parts_.push_back({Kind::Fixed, segment});
        } else if (segment[segment.size() - 2] == '*') {
            parts_.push_back({Kind::Many, segment.substr(1, segment.size() - 3)});
        } else {
            parts_.push_back({Kind::One, segment.substr(1, segment.size() - 2)});
        }
    }
}

bool PathPattern::hasMany() const {
    return std::any_of(parts_.begin(), parts_.end(),
                       [](const Part& part) { return part.kind == Kind::Many; });
}

std::size_t PathPattern::fixedParts() const {
    return static_cast<std::size_t>(std::count_if(parts_.begin(), parts_.end(),
                                                  [](const Part& part) { return part.kind == Kind::Fixed; }));
}

bool PathPattern::matches(const std::vector<std::string>& segments) const {
    if (hasMany() ? segments.size() < parts_.size() : segments.size() != parts_.size()) return false;
    std::size_t at = 0;
    for (const Part& part : parts_) {
        if (part.kind == Kind::Fixed && !rapid::config::sameName(segments[at], part.text)) return false;
        at += part.kind == Kind::Many ? segments.size() - parts_.size() + 1 : 1;
    }
    return true;
}

Parameters PathPattern::parametersOf(const std::vector<std::string>& segments) const {
    Parameters parameters;
    std::size_t at = 0;
    for (const Part& part : parts_) {
        std::size_t end = at + (part.kind == Kind::Many ? segments.size() - parts_.size() + 1 : 1);
        if (part.kind == Kind::Fixed) {
            at = end;
            continue;
        }
        std::string& value = parameters[part.text];
        for (bool first = true; at < end; ++at, first = false)
            value += (first ? "" : "/") + segments[at];
    }
    return parameters;
}

bool PathPattern::isMoreSpecificThan(const PathPattern& other) const {
    if (fixedParts() != other.fixedParts()) return fixedParts() > other.fixedParts();
    if (hasMany() != other.hasMany()) return !hasMany();
    const auto kindLess = [](const Part& a, const Part& b) { return a.kind < b.kind; };
    return std::lexicographical_compare(parts_.begin(), parts_.end(), other.parts_.begin(),
                                        other.parts_.end(), kindLess);
}

bool PathPattern::isSameAs(const PathPattern& other) const {
    return std::equal(parts_.begin(), parts_.end(), other.parts_.begin(), other.parts_.end(),
                      [](const Part& a, const Part& b) {
                          return a.kind == b.kind &&
                                 (a.kind != Kind::Fixed || rapid::config::sameName(a.text, b.text));
                      });
}

} // namespace rapidc::rws

#include "frontend/query/optional_names.h"

#include <algorithm>

namespace rapid::query {

using namespace sema;

std::vector<const DataSymbol*> optionalChoices(const CallContext& call) {
    std::vector<const DataSymbol*> all, inOrder;
    if (!call.routine) return all;
    const auto& params = call.routine->params;
    std::vector<int> given = call.given;
    given.insert(given.end(), call.later.begin(), call.later.end());
    const auto isGiven = [&](size_t i) {
        return std::find(given.begin(), given.end(), static_cast<int>(i)) != given.end();
    };
    const auto isExcluded = [&](size_t i) {
        return std::any_of(given.begin(), given.end(), [&](int other) {
            const DataSymbol& param = *params[static_cast<size_t>(other)];
            return param.optional && param.group == params[i]->group;
        });
    };
    const int last = call.given.empty() ? -1 : *std::max_element(call.given.begin(), call.given.end());
    bool requiredSince = false;
    for (size_t i = 0; i < params.size(); ++i) {
        if (!params[i]->optional) {
            if (static_cast<int>(i) > last) requiredSince = true;
            continue;
        }
        if (isGiven(i) || isExcluded(i)) continue;
        all.push_back(params[i]);
        if (static_cast<int>(i) > last && !requiredSince) inOrder.push_back(params[i]);
    }
    return inOrder.empty() ? all : inOrder;
}

} // namespace rapid::query

#include "ir/passes/passes.h"
#include "ir/verify/verify.h"

namespace ir {
namespace {

std::vector<std::string> verifyAfter(const Module& module, std::string_view pass) {
    std::vector<std::string> findings = verify(module);
    for (std::string& finding : findings)
        finding = std::string(pass) + ": " + finding;
    return findings;
}

} // namespace

std::vector<std::string> runPasses(Module& module, const PassOptions& options) {
    return runPasses(module, options,
                     // Checks first: they decide which places TRYNEXT and RETRY can lead to.
                     {"check-overflow", "simplify-cfg", "fold-constants", "simplify-cfg", "merge-checks",
                      "place-safepoints"});
}

std::vector<std::string> runPasses(Module& module, const PassOptions& options,
                                   const std::vector<std::string_view>& names) {
    if (auto findings = verifyAfter(module, "input"); !findings.empty()) return findings;
    if (!options.overflowChecks) module.overflowError = 0;
    for (std::string_view name : names) {
        if (name == "simplify-cfg")
            simplifyCfg(module);
        else if (name == "fold-constants")
            foldConstants(module);
        else if (name == "check-overflow")
            checkOverflow(module);
        else if (name == "merge-checks")
            mergeChecks(module);
        else if (name == "place-safepoints")
            placeSafepoints(module, options.profile);
        else
            return {"there is no pass '" + std::string(name) + "'"};
        if (auto findings = verifyAfter(module, name); !findings.empty()) return findings;
    }
    return {};
}

} // namespace ir

#include "ir/passes/passes.h"
#include "ir/verify/verify.h"

namespace ir {
namespace {

using Findings = std::vector<std::string>;

// Checks first: they decide which places TRYNEXT and RETRY can lead to.
const std::vector<std::string_view> kAllPasses = {"check-overflow", "simplify-cfg", "fold-constants",
                                                  "simplify-cfg",   "merge-checks", "place-safepoints"};

Findings prefixed(Findings findings, std::string_view pass) {
    for (std::string& finding : findings)
        finding = std::string(pass) + ": " + finding;
    return findings;
}

/// Instructions of a routine from which on it is verified before the passes and after the last one only, because each time costs
/// as much as a pass, and its checks stay where they are: it is interpreted, and values kept for one check later would each
/// need a place on the stack.
constexpr size_t kHuge = 60'000;

/// False for an unknown name.
bool runPass(std::string_view name, const Module& module, Routine& routine, const PassOptions& options) {
    if (name == "simplify-cfg")
        simplifyCfg(module, routine);
    else if (name == "fold-constants")
        foldConstants(routine);
    else if (name == "check-overflow" && options.overflowChecks)
        checkOverflow(module, routine);
    else if (name == "merge-checks" && routine.insts.size() < kHuge)
        mergeChecks(module, routine);
    else if (name == "place-safepoints")
        placeSafepoints(module, routine, options.profile);
    else
        return name == "check-overflow" || name == "merge-checks";
    return true;
}

Findings runPasses(Module& module, uint32_t index, const PassOptions& options,
                   const std::vector<std::string_view>& names) {
    Routine& routine = module.routines[index];
    if (auto findings = verifyRoutine(module, index); !findings.empty()) return prefixed(findings, "input");
    for (const std::string_view name : names) {
        if (!runPass(name, module, routine, options)) return {"there is no pass '" + std::string(name) + "'"};
        if (routine.insts.size() >= kHuge && &name != &names.back()) continue;
        if (auto findings = verifyRoutine(module, index); !findings.empty()) return prefixed(findings, name);
    }
    return {};
}

} // namespace

std::vector<std::string> runPasses(Module& module, const PassOptions& options) {
    return runPasses(module, options, kAllPasses);
}

std::vector<std::string> runPasses(Module& module, uint32_t routine, const PassOptions& options) {
    return runPasses(module, routine, options, kAllPasses);
}

std::vector<std::string> runPasses(Module& module, const PassOptions& options,
                                   const std::vector<std::string_view>& names) {
    if (auto findings = verifyTables(module); !findings.empty()) return prefixed(findings, "input");
    for (uint32_t i = 0; i < module.routines.size(); ++i)
        if (auto findings = runPasses(module, i, options, names); !findings.empty()) return findings;
    return {};
}

} // namespace ir

#include "frontend/query/refactoring.h"

#include "frontend/query/refactor_parts.h"

#include <algorithm>

namespace rapid::query {

std::vector<Refactoring> refactoringsAt(const Snapshot& snapshot, const FileView& file, SourceRange selection,
                                        const Cancel* cancel) {
    const auto size = static_cast<uint32_t>(file.text().size());
    selection.begin = std::min(selection.begin, size);
    selection.end = std::clamp(selection.end, selection.begin, size);
    std::vector<Refactoring> out;
    if (file.isLibrary()) return out;
    const RefactorPlace place(snapshot, file, selection, cancel);
    for (const auto& part : {createRoutine, declareData, insertArguments, extractRoutine, teachValue,
                             inlineConstant, convertData, sortTargets, addHandlers}) {
        if (isCancelled(cancel)) break;
        part(place, out);
    }
    for (Refactoring& refactoring : out)
        std::sort(refactoring.edits.begin(), refactoring.edits.end(),
                  [](const TextEdit& a, const TextEdit& b) { return a.range.begin < b.range.begin; });
    return out;
}

} // namespace rapid::query

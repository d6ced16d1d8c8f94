#include "tools/program/module_store.h"

#include "config/atomic_file.h"
#include "config/temporary.h"
#include "frontend/diag/diagnostic.h"
#include "frontend/edit/save_values.h"
#include "frontend/syntax/parser.h"
#include "frontend/workspace/module_files.h"

#include <fmt/format.h>

namespace rapidc {

namespace edit = rapid::edit;

rt::StoreResult SourceStore::store(const rt::ModuleText& text) {
    rt::StoreResult result;
    const auto file = rapid::workspace::readModuleFile(text.source, result.problem);
    if (!file) {
        result.problem = fmt::format("'{}' {}", text.source, result.problem);
        return result;
    }
    rapid::diag::Sink ignored; // mistakes elsewhere in the file do not matter
    const auto tree = rapid::syntax::parse(file, ignored);
    std::vector<edit::DataValue> values;
    for (const rt::SavedValue& value : text.values)
        values.push_back({value.module, value.name, value.text});
    edit::SavedModule saved = edit::saveValues(*tree, values);
    result.problem = std::move(saved.problem);
    if (!result.problem.empty()) return result;
    result.notes = std::move(saved.notes);
    const bool same = text.destination == text.source && saved.bytes == file->bytes();
    rapid::config::removeLeftoversBeside({text.destination});
    if (!same) result.problem = rapid::config::replaceFile(text.destination, saved.bytes);
    return result;
}

} // namespace rapidc

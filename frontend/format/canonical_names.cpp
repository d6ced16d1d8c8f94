#include "frontend/format/canonical_names.h"

#include "config/letter_case.h"

namespace rapid::format {

using namespace rapid::syntax;

namespace {

TokenIndex nameOf(const Decl& decl) {
    switch (decl.kind) {
    case NodeKind::Record: return as<RecordDecl>(decl).name;
    case NodeKind::Alias: return as<AliasDecl>(decl).name;
    case NodeKind::Data: return as<DataDecl>(decl).name;
    case NodeKind::Routine: return as<RoutineDecl>(decl).name;
    default: return kNoToken;
    }
}

} // namespace

void addDeclaredNames(const SyntaxTree& tree, NameTable& names) {
    for (const ModuleDecl* module : tree.modules)
        for (const Decl* decl : module->decls) {
            const std::string_view name = tree.text(nameOf(*decl));
            if (!name.empty()) names.emplace(config::lowerCase(name), name);
        }
}

} // namespace rapid::format

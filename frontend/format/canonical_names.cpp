#include "frontend/format/canonical_names.h"

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

std::string lowerCase(std::string_view text) {
    std::string out(text);
    for (char& c : out)
        if (c >= 'A' && c <= 'Z') c = static_cast<char>(c + 32);
    return out;
}

void addDeclaredNames(const SyntaxTree& tree, NameTable& names) {
    for (const ModuleDecl* module : tree.modules)
        for (const Decl* decl : module->decls) {
            const std::string_view name = tree.text(nameOf(*decl));
            if (!name.empty()) names.emplace(lowerCase(name), name);
        }
}

} // namespace rapid::format

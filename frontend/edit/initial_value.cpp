#include "frontend/edit/initial_value.h"

#include "frontend/diag/diagnostic.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/parser.h"

#include <fmt/format.h>

namespace rapid::edit {

using namespace syntax;

namespace {

EditSet refuse(std::string problem) {
    EditSet set;
    set.problem = std::move(problem);
    return set;
}

std::string_view trimmed(std::string_view text) {
    const size_t begin = text.find_first_not_of(" \t");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t") - begin + 1);
}

/// Why `value` is not allowed after `:=`; empty when it is.
std::string findMistake(std::string_view value) {
    if (value.empty()) return "the value is empty: expected an expression such as 5 or [1,0,0,0]";
    if (value.find_first_of("\r\n") != std::string_view::npos)
        return "the value has several lines: expected one";
    diag::Sink sink;
    const auto source = std::make_shared<const SourceFile>("value.modx", std::string(value));
    const ParsedExpr parsed = parseExpression(source, sink);
    if (sink.all().empty() && !parsed.tree->tokens.empty()) {
        const size_t last = parsed.tree->tokens.size() - 1;
        const bool comment =
            last == 0 ||
            parsed.tree->tokens[last - 1].offset + parsed.tree->tokens[last - 1].length < value.size();
        return comment ? "the value ends with a comment: expected an expression alone" : "";
    }
    return fmt::format("'{}' is not a value: {}", value,
                       sink.all().empty() ? "" : sink.all().front().message);
}

struct Found {
    const ModuleDecl* module = nullptr;
    const DataDecl* data = nullptr;
};

/// Data with the path DATA or MODULE.DATA.
std::vector<Found> findData(const SyntaxTree& tree, std::string_view path) {
    const std::string wanted = sema::foldName(path);
    std::vector<Found> found;
    for (const ModuleDecl* module : tree.modules)
        for (const Decl* decl : module->decls) {
            if (decl->kind != NodeKind::Data) continue;
            const auto& data = as<DataDecl>(*decl);
            const std::string name = sema::foldName(tree.text(data.name));
            if (name == wanted || sema::foldName(tree.text(module->name)) + "." + name == wanted)
                found.push_back({module, &data});
        }
    return found;
}

} // namespace

bool declaresData(const SyntaxTree& tree, std::string_view path) {
    return !findData(tree, path).empty();
}

EditSet setInitialValue(const SyntaxTree& tree, std::string_view path, std::string_view value) {
    value = trimmed(value);
    if (std::string mistake = findMistake(value); !mistake.empty()) return refuse(std::move(mistake));
    const std::vector<Found> found = findData(tree, path);
    if (found.empty()) return refuse(fmt::format("'{}' declares no data '{}'", tree.source->path(), path));
    if (found.size() > 1)
        return refuse(fmt::format("'{}' declares '{}' more than once: name the module too, as in {}.{}",
                                  tree.source->path(), path, tree.text(found.front().module->name), path));

    const DataDecl& data = *found.front().data;
    TextEdit edit;
    if (data.init && data.init->first <= data.init->last) {
        edit = {tree.range(*data.init), std::string(value)};
        const SourceRange old = edit.range;
        if (tree.source->text().substr(old.begin, old.end - old.begin) == value) return {};
    } else if (tree.tokens[data.last].kind != TokenKind::Semicolon || data.init) {
        return refuse(fmt::format("the declaration of '{}' has a mistake: correct it first", path));
    } else {
        const uint32_t end = tree.range(data.last - 1).end;
        edit = {{end, end}, ":=" + std::string(value)};
    }
    EditSet set;
    set.files.push_back({tree.source, {std::move(edit)}});
    return set;
}

} // namespace rapid::edit

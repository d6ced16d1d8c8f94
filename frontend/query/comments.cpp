// Comments of declarations as documentation.

#include "frontend/query/describe.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/declaration_comment.h"
#include "frontend/syntax/tree_walk.h"

#include <algorithm>
#include <fmt/format.h>

namespace rapid::query {

using namespace sema;
using namespace syntax;

namespace {

std::string_view trimmed(std::string_view text) {
    const size_t begin = text.find_first_not_of(" \t\r");
    if (begin == std::string_view::npos) return {};
    return text.substr(begin, text.find_last_not_of(" \t\r") - begin + 1);
}

/// A comment line without its marks; lines that only draw a frame become empty.
std::string_view withoutMarks(std::string_view line) {
    while (line.starts_with('!'))
        line.remove_prefix(1);
    if (line.find_first_not_of("*-=+_#~!/ \t\r") == std::string_view::npos) return {};
    if (line.starts_with(' ')) line.remove_prefix(1);
    while (!line.empty() && (line.back() == ' ' || line.back() == '\t' || line.back() == '\r'))
        line.remove_suffix(1);
    return line;
}

std::vector<std::string_view> linesOf(std::string_view text) {
    std::vector<std::string_view> lines;
    while (true) {
        const size_t end = text.find('\n');
        lines.push_back(text.substr(0, end));
        if (end == std::string_view::npos) return lines;
        text.remove_prefix(end + 1);
    }
}

/// The comment lines that end directly above a declaration.
std::string aboveDeclaration(std::string_view trivia) {
    std::vector<std::string_view> lines = linesOf(trivia);
    if (!lines.empty()) lines.pop_back(); // the indentation of the declaration
    std::vector<std::string_view> found;
    while (!lines.empty() && trimmed(lines.back()).starts_with('!')) {
        found.push_back(withoutMarks(trimmed(lines.back())));
        lines.pop_back();
    }
    while (!found.empty() && found.back().empty())
        found.pop_back();
    while (!found.empty() && found.front().empty())
        found.erase(found.begin());
    std::string text;
    for (size_t i = found.size(); i-- > 0;)
        text += std::string(found[i]) + (i ? "\n" : "");
    return text;
}

/// The comment that follows a declaration on its line.
std::string afterDeclaration(const SyntaxTree& tree, const Node& node) {
    const std::string_view text = tree.source->text();
    const SourceRange range = tree.range(node);
    std::string_view rest = text.substr(std::min<size_t>(range.end, text.size()));
    rest = trimmed(rest.substr(0, rest.find_first_of("\r\n")));
    if (rest.starts_with(';')) rest = trimmed(rest.substr(1));
    return rest.starts_with('!') ? std::string(withoutMarks(rest)) : "";
}

struct Declaration {
    const SyntaxTree* tree = nullptr;
    const Node* node = nullptr;
    bool library = false;
};

Declaration nodeOf(const Snapshot& snapshot, const Meaning& meaning) {
    if (meaning.symbol) {
        const Symbol& symbol = *meaning.symbol;
        if (!symbol.module || !symbol.decl) return {};
        return {symbol.module->tree, symbol.decl, symbol.predefined};
    }
    if (meaning.module) return {meaning.module->tree, meaning.module->decl, meaning.module->predefined};
    const TypeSymbol* type = meaning.record ? snapshot.symbolOf(*meaning.record) : nullptr;
    if (!type || !type->decl || type->decl->kind != NodeKind::Record) return {};
    const std::string name =
        foldName(meaning.record->components[static_cast<size_t>(meaning.component)].name);
    for (const RecordComponent* component : as<RecordDecl>(*type->decl).components)
        if (component->name != kNoToken && foldName(type->module->tree->text(component->name)) == name)
            return {type->module->tree, component, type->predefined};
    return {};
}

/// Lines that begin with '@' become lists and code.
std::string markdown(std::string_view text) {
    std::string out, example;
    bool inExample = false;
    for (const std::string_view line : linesOf(text)) {
        if (line.starts_with("@example")) {
            inExample = true;
            example += std::string(trimmed(line.substr(8))) + "\n";
        } else if (line.starts_with('@')) {
            inExample = false;
            const size_t space = line.find(' ');
            const std::string_view key = line.substr(1, space == std::string_view::npos ? space : space - 1);
            std::string_view rest = space == std::string_view::npos ? "" : trimmed(line.substr(space));
            if (key == "param" || key == "error") {
                const size_t end = rest.find(' ');
                const std::string_view name = rest.substr(0, end);
                rest = end == std::string_view::npos ? "" : trimmed(rest.substr(end));
                out += fmt::format("\n- {}`{}`: {}", key == "error" ? "error " : "", name, rest);
            } else {
                out += fmt::format("\n- {}: {}", key, rest);
            }
        } else if (inExample) {
            example += std::string(trimmed(line)) + "\n";
        } else {
            out += (out.empty() ? "" : "\n") + std::string(line);
        }
    }
    if (!example.empty()) out += "\n\n```rapid\n" + example + "```";
    return out;
}

Meaning meaningOfSymbol(const Symbol& symbol) {
    Meaning meaning;
    meaning.symbol = &symbol;
    return meaning;
}

} // namespace

std::string commentOf(const Snapshot& snapshot, const Meaning& meaning) {
    const DataSymbol* data = dataOf(meaning.symbol);
    if (data && data->storage == Storage::Parameter) return parameterDocumentation(snapshot, *data);
    const Declaration decl = nodeOf(snapshot, meaning);
    if (!decl.node || decl.node->first == kNoToken) return {};
    const std::string_view trivia = leadingTrivia(*decl.tree, *decl.node);
    if (decl.library) return readDeclarationComment(trivia).text;
    std::string text = aboveDeclaration(trivia);
    const bool plain = decl.node->kind == NodeKind::Data || decl.node->kind == NodeKind::RecordComponent ||
                       decl.node->kind == NodeKind::Alias;
    return text.empty() && plain ? afterDeclaration(*decl.tree, *decl.node) : text;
}

std::string commentOf(const Snapshot& snapshot, const Symbol& symbol) {
    return commentOf(snapshot, meaningOfSymbol(symbol));
}

std::string documentationOf(const Snapshot& snapshot, const Meaning& meaning) {
    std::string text = markdown(commentOf(snapshot, meaning));
    if (const RoutineSymbol* routine = routineOf(meaning.symbol)) {
        if (!routine->option.empty()) text += "\n\nNeeds the option " + routine->option + ".";
        if (routine->predefined && !routine->raisedErrors.empty() &&
            text.find("error `") == std::string::npos)
            text += "\n\nErrors: " + routine->raisedErrors;
    }
    return text;
}

std::string documentationOf(const Snapshot& snapshot, const Symbol& symbol) {
    return documentationOf(snapshot, meaningOfSymbol(symbol));
}

std::string parameterDocumentation(const Snapshot& snapshot, const DataSymbol& parameter) {
    if (!parameter.routine) return {};
    const std::string text = commentOf(snapshot, *parameter.routine);
    const std::string wanted = foldName(parameter.name);
    std::string found;
    bool inside = false;
    for (const std::string_view line : linesOf(text)) {
        if (line.starts_with("@param")) {
            const std::string_view rest = trimmed(line.substr(6));
            inside = foldName(rest.substr(0, rest.find(' '))) == wanted;
            if (inside && rest.size() > wanted.size()) found = trimmed(rest.substr(wanted.size()));
        } else if (line.empty() || line.starts_with('@')) {
            inside = false;
        } else if (inside) { // continues the line before
            found += " " + std::string(trimmed(line));
        }
    }
    return found;
}

} // namespace rapid::query

// rapidc builtins: everything predefined and whether it is implemented.

#include "runtime/host/command_line.h"
#include "tools/program/pipeline.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/usage.h"

#include "config/nearest.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/tree_walk.h"
#include "runtime/host/run_options.h"
#include "stdlib/native_table.h"

#include <algorithm>
#include <cstdio>
#include <fmt/format.h>

namespace rapidc {

namespace {

/// Good as long as the program it is taken from.
struct BuiltinRow {
    std::string_view name, kind, chapter, status;
};

/// The value of a key such as `manual:` in the `!@` lines above a declaration of the library; "-" without it.
std::string_view attributeOf(const rapid::sema::Module& module, const rapid::syntax::Node* decl,
                             std::string_view key) {
    if (!decl) return "-";
    const std::string_view gap = rapid::syntax::gapBefore(*module.tree, decl->first);
    const size_t at = gap.rfind(key);
    if (at == std::string_view::npos) return "-";
    std::string_view rest = gap.substr(at + key.size());
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    const size_t stop = std::min({rest.find("   "), rest.find('\n'), rest.size()});
    return rest.substr(0, stop);
}

std::vector<BuiltinRow> collect(const rapid::sema::CheckedProgram& program) {
    std::vector<BuiltinRow> rows;
    for (const rt::NativeEntry& entry : rt::nativeTable())
        rows.push_back({entry.name, entry.kind == rt::NativeKind::Function ? "function" : "instruction",
                        entry.chapter, entry.isImplemented() ? "implemented" : "declared only"});
    for (const rapid::sema::Module* module : program.predefinedModules) {
        for (const auto* type : module->types)
            rows.push_back(
                {type->name, "datatype", attributeOf(*module, type->decl, "manual:"), "implemented"});
        for (const auto* data : module->data) {
            const bool constant = data->dataKind == rapid::syntax::DataKind::Const;
            rows.push_back({data->name, constant ? "constant" : "systemdata",
                            attributeOf(*module, data->decl, "manual:"), "implemented"});
        }
    }
    std::sort(rows.begin(), rows.end(), [](const BuiltinRow& a, const BuiltinRow& b) {
        const int order = a.kind.compare(b.kind);
        return order != 0 ? order < 0 : a.name < b.name;
    });
    return rows;
}

void printTsv(const std::vector<BuiltinRow>& rows) {
    fmt::print("name\tkind\tchapter\tstatus\n");
    for (const BuiltinRow& row : rows)
        fmt::print("{}\t{}\t{}\t{}\n", row.name, row.kind, row.chapter, row.status);
}

void printRows(const std::vector<BuiltinRow>& rows) {
    size_t done = 0;
    std::string text;
    const auto column = [&text](std::string_view word, size_t width) {
        text += word;
        text.append(word.size() < width ? width - word.size() : 0, ' ');
        text += ' ';
    };
    for (const BuiltinRow& row : rows) {
        done += row.status == "implemented" ? 1u : 0u;
        column(row.name, 28);
        column(row.kind, 12);
        column(row.chapter, 8);
        text += row.status;
        text += '\n';
    }
    fmt::print("{}\n{} of {} implemented\n", text, done, rows.size());
}

bool isPattern(const std::string& name) {
    return name.find_first_of("*?") != std::string::npos;
}

/// '*' matches any letters, '?' one; both in lower case.
bool matches(std::string_view pattern, std::string_view name) {
    size_t p = 0, n = 0, star = std::string_view::npos, resume = 0;
    while (n < name.size()) {
        if (p < pattern.size() && (pattern[p] == '?' || pattern[p] == name[n])) {
            ++p, ++n;
        } else if (p < pattern.size() && pattern[p] == '*') {
            star = p++;
            resume = n;
        } else if (star != std::string_view::npos) {
            p = star + 1;
            n = ++resume;
        } else {
            return false;
        }
    }
    return pattern.find_first_not_of('*', p) == std::string_view::npos;
}

/// Prints the lines of a text as `shown` gives them; nothing for those it answers by nullopt.
template <class Shown> void printLines(std::string_view text, Shown&& shown) {
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        if (const std::optional<std::string_view> line = shown(text.substr(0, end)))
            fmt::print("{}\n", *line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

/// Without the spaces before it, but for those beyond `most`.
std::string_view outdented(std::string_view line, size_t most) {
    return line.substr(std::min({line.find_first_not_of(' '), line.size(), most}));
}

std::optional<std::string_view> documentationLine(std::string_view line) {
    line = outdented(line, line.size());
    return line.starts_with("!! ") ? std::optional(line.substr(3)) : std::nullopt;
}

std::optional<std::string_view> declarationLine(std::string_view line) {
    constexpr size_t kIndent = 3; // of the library
    return outdented(line, kIndent);
}

const rapid::syntax::Node* findDeclaration(const rapid::sema::Module& module, std::string_view folded) {
    const auto is = [&](const auto* symbol) { return rapid::sema::foldName(symbol->name) == folded; };
    for (const auto* type : module.types)
        if (is(type)) return type->decl;
    for (const auto* data : module.data)
        if (is(data)) return data->decl;
    for (const auto* routine : module.routines)
        if (is(routine)) return routine->decl;
    return nullptr;
}

/// Prints the option that the declaration belongs to, and how sure its form is.
void printOrigin(const rapid::sema::Module& module, const rapid::syntax::Node* decl) {
    const std::string_view option = attributeOf(module, decl, "option:");
    if (option != "-") fmt::print("Option: {}.\n", option);
    const std::string_view confidence = attributeOf(module, decl, "confidence:");
    if (confidence == "medium") fmt::print("The form is not confirmed in every detail.\n");
    if (confidence == "low") fmt::print("The form is not confirmed.\n");
}

/// Its kind, its state and its declaration.
void describe(const rapid::sema::CheckedProgram& program, const BuiltinRow& row) {
    fmt::print("{}: {}, {}{}\n", row.name, row.kind, row.status,
               row.chapter == "-" ? std::string() : fmt::format(", manual {}", row.chapter));
    for (const rapid::sema::Module* module : program.predefinedModules) {
        const rapid::syntax::Node* decl = findDeclaration(*module, rapid::sema::foldName(row.name));
        if (!decl) continue;
        printLines(rapid::syntax::gapBefore(*module->tree, decl->first), documentationLine);
        printOrigin(*module, decl);
        const rapid::SourceRange where = module->tree->range(*decl);
        printLines(module->tree->source->text().substr(where.begin, where.end - where.begin),
                   declarationLine);
    }
}

std::string nearest(const std::vector<BuiltinRow>& rows, const std::string& name) {
    std::vector<std::string> names;
    for (const BuiltinRow& row : rows)
        names.emplace_back(row.name);
    std::vector<std::string> near = rapid::config::nearestNames(name, names);
    if (near.empty()) return {};
    near.resize(std::min<size_t>(near.size(), 3));
    return fmt::format("; did you mean {}?", fmt::join(near, " or "));
}

/// The rows that the names and patterns mean, each once, in the order of the names. False with a message for one that
/// means nothing.
bool select(const std::vector<BuiltinRow>& rows, const std::vector<std::string>& names,
            std::vector<BuiltinRow>& selected) {
    for (const std::string& name : names) {
        const std::string folded = rapid::sema::foldName(name);
        bool any = false;
        for (const BuiltinRow& row : rows) {
            const std::string other = rapid::sema::foldName(row.name);
            if (isPattern(name) ? !matches(folded, other) : folded != other) continue;
            any = true;
            const bool known = std::any_of(selected.begin(), selected.end(),
                                           [&](const BuiltinRow& one) { return one.name == row.name; });
            if (!known) selected.push_back(row);
            if (!isPattern(name)) break;
        }
        if (any) continue;
        fmt::print(stderr, "rapidc builtins: nothing predefined {} '{}'{}\n",
                   isPattern(name) ? "matches" : "has the name", name,
                   isPattern(name) ? std::string() : nearest(rows, name));
        return false;
    }
    return true;
}

/// Without names everything; names are described, patterns that mean several are listed.
int show(const std::string& format, const std::vector<std::string>& names) {
    Inputs inputs;
    inputs.documented = !names.empty();
    const auto compilation = checkInputs(inputs);
    const std::vector<BuiltinRow> rows = collect(*compilation->program);
    std::vector<BuiltinRow> selected;
    if (!select(rows, names, selected)) return kBadUsage;
    if (names.empty()) selected = rows;
    const bool listed =
        names.empty() || (std::any_of(names.begin(), names.end(), isPattern) && selected.size() > 1);
    if (format == "tsv")
        printTsv(selected);
    else if (listed)
        printRows(selected);
    else
        for (size_t i = 0; i < selected.size(); ++i) {
            if (i > 0) fmt::print("\n");
            describe(*compilation->program, selected[i]);
        }
    return 0;
}

} // namespace

void addBuiltinsCommand(rt::CommandLine& line) {
    auto format = std::make_shared<std::string>("human");
    auto names = std::make_shared<std::vector<std::string>>();
    const rt::Command command =
        line.addCommand("builtins", "List predefined names and whether they are implemented",
                        [=] { return show(*format, *names); });
    command.add("name", *names,
                "Describe these names with their declarations; 'Socket*' lists all that match (* and ?)");
    command.add("--format", *format, "human or tsv").oneOf({"human", "tsv"});
}

} // namespace rapidc

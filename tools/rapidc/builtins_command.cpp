// rapidc builtins: everything predefined and whether it is implemented.

#include "runtime/host/command_line.h"
#include "tools/program/pipeline.h"
#include "tools/rapidc/commands.h"
#include "tools/rapidc/usage.h"

#include "config/letter_case.h"
#include "config/nearest.h"
#include "frontend/sema/names.h"
#include "frontend/syntax/declaration_comment.h"
#include "frontend/syntax/tree_walk.h"
#include "runtime/host/run_options.h"
#include "stdlib/native_table.h"
#include "stdlib/stdlib_text.h"

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
    return rows;
}

void sort(std::vector<BuiltinRow>& rows) {
    std::sort(rows.begin(), rows.end(), [](const BuiltinRow& a, const BuiltinRow& b) {
        const int order = a.kind.compare(b.kind);
        return order != 0 ? order < 0 : a.name < b.name;
    });
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

/// Prints the lines of a declaration without the indentation of the library.
void printDeclaration(std::string_view text) {
    constexpr size_t kIndent = 3;
    while (!text.empty()) {
        const size_t end = std::min(text.find('\n'), text.size());
        const std::string_view line = text.substr(0, end);
        fmt::print("{}\n", line.substr(std::min({line.find_first_not_of(' '), line.size(), kIndent})));
        text.remove_prefix(std::min(end + 1, text.size()));
    }
}

const rapid::syntax::Node* findDeclaration(const rapid::sema::Module& module, std::string_view name) {
    const auto is = [&](const auto* symbol) { return rapid::config::sameName(symbol->name, name); };
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

/// Prints the documentation above a line of a module of the library. The module was read without it, in the same lines.
void printDocumentation(std::string_view module, uint32_t line) {
    const auto& sources = rapid::stdlib::sources();
    const auto source =
        std::find_if(sources.begin(), sources.end(),
                     [&](const rapid::stdlib::StdlibSource& one) { return one.name == module; });
    if (source == sources.end()) return;
    size_t above = 0; // bytes of the text above
    for (uint32_t number = 1; number < line; ++number)
        above = source->text.find('\n', above) + 1;
    const std::string text = rapid::syntax::readDeclarationComment(source->text.substr(0, above)).text;
    if (!text.empty()) fmt::print("{}\n", text);
}

/// Its kind, its state and its declaration.
void describe(const rapid::sema::CheckedProgram& program, const BuiltinRow& row) {
    fmt::print("{}: {}, {}{}\n", row.name, row.kind, row.status,
               row.chapter == "-" ? std::string() : fmt::format(", manual {}", row.chapter));
    for (const rapid::sema::Module* module : program.predefinedModules) {
        const rapid::syntax::Node* decl = findDeclaration(*module, row.name);
        if (!decl) continue;
        const rapid::SourceFile& source = *module->tree->source;
        const rapid::SourceRange where = module->tree->range(*decl);
        printDocumentation(source.path(), source.lineColumn(where.begin).line);
        printOrigin(*module, decl);
        printDeclaration(source.text().substr(where.begin, where.end - where.begin));
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
        const bool pattern = isPattern(name);
        const std::string folded = rapid::sema::foldName(name);
        bool any = false;
        for (const BuiltinRow& row : rows) {
            if (pattern ? !matches(folded, rapid::sema::foldName(row.name))
                        : !rapid::config::sameName(name, row.name))
                continue;
            any = true;
            const bool known = std::any_of(selected.begin(), selected.end(),
                                           [&](const BuiltinRow& one) { return one.name == row.name; });
            if (!known) selected.push_back(row);
            if (!pattern) break;
        }
        if (any) continue;
        fmt::print(stderr, "rapidc builtins: nothing predefined {} '{}'{}\n",
                   pattern ? "matches" : "has the name", name, pattern ? std::string() : nearest(rows, name));
        return false;
    }
    return true;
}

/// Without names everything; names are described, patterns that mean several are listed.
int show(const std::string& format, const std::vector<std::string>& names) {
    const auto compilation = checkInputs(Inputs());
    std::vector<BuiltinRow> rows = collect(*compilation->program);
    const bool several = names.empty() || std::any_of(names.begin(), names.end(), isPattern);
    if (several) sort(rows);
    std::vector<BuiltinRow> selected;
    if (!select(rows, names, selected)) return kBadUsage;
    if (names.empty()) selected = rows;
    const bool listed = names.empty() || (several && selected.size() > 1);
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

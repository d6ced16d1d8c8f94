// rapidc builtins: everything predefined and whether it is implemented.

#include "tools/rapidc/commands.h"
#include "tools/rapidc/pipeline.h"

#include "stdlib/native_table.h"

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <fmt/format.h>

namespace rapidc {

namespace {

struct Row {
    std::string name, kind, chapter, status;
};

/// `manual:` in the `!@` lines above a declaration of the library.
std::string chapterOf(const rapid::sema::Module& module, const rapid::syntax::Node* decl) {
    if (!decl) return "-";
    const auto& tree = *module.tree;
    const uint32_t end = tree.range(*decl).begin;
    const uint32_t begin = decl->first > 0 ? tree.range(decl->first - 1).end : 0;
    const std::string_view gap = tree.source->text().substr(begin, end - begin);
    const size_t at = gap.rfind("manual:");
    if (at == std::string_view::npos) return "-";
    std::string_view rest = gap.substr(at + 7);
    rest.remove_prefix(std::min(rest.find_first_not_of(' '), rest.size()));
    const size_t stop = std::min({rest.find("   "), rest.find('\n'), rest.size()});
    return std::string(rest.substr(0, stop));
}

std::vector<Row> collect() {
    std::vector<Row> rows;
    for (const rt::NativeEntry& entry : rt::nativeTable())
        rows.push_back({entry.name, entry.kind == rt::NativeKind::Function ? "function" : "instruction",
                        entry.chapter, entry.isImplemented() ? "implemented" : "declared only"});
    const auto compilation = checkInputs({});
    for (const rapid::sema::Module* module : compilation->program->predefinedModules) {
        for (const auto* type : module->types)
            rows.push_back({type->name, "datatype", chapterOf(*module, type->decl), "implemented"});
        for (const auto* data : module->data) {
            const bool constant = data->dataKind == rapid::syntax::DataKind::Const;
            rows.push_back({data->name, constant ? "constant" : "systemdata", chapterOf(*module, data->decl),
                            "implemented"});
        }
    }
    std::sort(rows.begin(), rows.end(),
              [](const Row& a, const Row& b) { return std::tie(a.kind, a.name) < std::tie(b.kind, b.name); });
    return rows;
}

int list(const std::string& format) {
    const std::vector<Row> rows = collect();
    if (format == "tsv") {
        fmt::print("name\tkind\tchapter\tstatus\n");
        for (const Row& row : rows)
            fmt::print("{}\t{}\t{}\t{}\n", row.name, row.kind, row.chapter, row.status);
        return 0;
    }
    size_t done = 0;
    for (const Row& row : rows) {
        done += row.status == "implemented" ? 1u : 0u;
        fmt::print("{:<28} {:<12} {:<8} {}\n", row.name, row.kind, row.chapter, row.status);
    }
    fmt::print("\n{} of {} implemented\n", done, rows.size());
    return 0;
}

} // namespace

void addBuiltinsCommand(CLI::App& app, int& status) {
    auto format = std::make_shared<std::string>("human");
    CLI::App* command =
        app.add_subcommand("builtins", "List everything predefined and what of it is implemented");
    command->add_option("--format", *format, "human or tsv")->check(CLI::IsMember({"human", "tsv"}));
    command->callback([format, &status] { status = list(*format); });
}

} // namespace rapidc

// stdlib_gen: writes every table of predefined names from their declarations. Files are touched only when
// their contents change, so that nothing is compiled again without need.

#include "stdlib/gen/emit.h"

#include <cstdio>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <system_error>

namespace fs = std::filesystem;

namespace {

bool writeIfChanged(const std::string& path, const std::string& text) {
    std::ifstream in(path, std::ios::binary);
    if (in) {
        std::stringstream old;
        old << in.rdbuf();
        if (old.str() == text) return true;
    }
    std::ofstream out(path, std::ios::binary | std::ios::trunc);
    out << text;
    out.close();
    if (!out) std::fprintf(stderr, "stdlib_gen: %s cannot be written\n", path.c_str());
    return static_cast<bool>(out);
}

int usage() {
    std::fputs(
        "usage: stdlib_gen --out FOLDER FILE.sysx...\n       stdlib_gen --reference FOLDER FILE.sysx...\n",
        stderr);
    return 3;
}

bool writeAll(const stdlibgen::Model& model, const std::string& folder) {
    bool ok = writeIfChanged(folder + "/stdlib_types.h", emitTypes(model));
    ok &= writeIfChanged(folder + "/layout_checks.cpp", emitLayoutChecks(model));
    ok &= writeIfChanged(folder + "/stdlib_constants.h", emitConstants(model));
    ok &= writeIfChanged(folder + "/native_table.cpp", emitNativeTable(model));
    ok &= writeIfChanged(folder + "/constant_calls.cpp", emitConstantCalls(model));
    ok &= writeIfChanged(folder + "/error_table.cpp", emitErrorTable(model));
    ok &= writeIfChanged(folder + "/stdlib_sources.cpp", emitSources(model));
    ok &= writeIfChanged(folder + "/builtins.json", emitJson(model));
    for (const stdlibgen::SourceText& source : model.sources)
        if (source.name.starts_with("decl/"))
            ok &= writeIfChanged(folder + "/natives/" + fs::path(source.name).stem().string() + ".h",
                                 emitNatives(model, source));
    return ok;
}

bool writeReference(const stdlibgen::Model& model, const std::string& folder) {
    bool ok = true;
    for (const stdlibgen::Page& page : emitReference(model))
        ok &= writeIfChanged(folder + "/" + page.file, page.text);
    return ok;
}

} // namespace

int main(int argc, char** argv) {
    if (argc < 4) return usage();
    const std::string mode = argv[1];
    const std::string target = argv[2];
    if (mode != "--out" && mode != "--reference") return usage();
    const stdlibgen::Model model = stdlibgen::readDeclarations({argv + 3, argv + argc});
    const std::vector<std::string> problems =
        model.errors.empty() ? stdlibgen::brokenRules(model) : model.errors;
    for (const std::string& problem : problems)
        std::fprintf(stderr, "%s\n", problem.c_str());
    if (!problems.empty()) return 2;
    std::error_code code;
    fs::create_directories(mode == "--out" ? target + "/natives" : target,
                           code); // a failure shows when a file is written
    const bool ok = mode == "--out" ? writeAll(model, target) : writeReference(model, target);
    return ok ? 0 : 1;
}

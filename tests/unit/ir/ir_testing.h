#pragma once
// The common part of the tests of IR and code generation: reading the corpus of tests/ir.

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "ir/text/text.h"

namespace ir_testing {

inline std::filesystem::path corpusFolder() {
    return std::filesystem::path(RAPIDC_SOURCE_DIR) / "tests/ir";
}

inline std::string readText(const std::filesystem::path& path) {
    std::ifstream in(path, std::ios::binary);
    REQUIRE(in.good());
    std::stringstream text;
    text << in.rdbuf();
    return text.str();
}

/// The .rir files of a folder in the order of their names.
inline std::vector<std::filesystem::path> rirFiles(const std::filesystem::path& folder) {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.path().extension() == ".rir") files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    REQUIRE_FALSE(files.empty());
    return files;
}

inline ir::Module parse(const std::string& text) {
    ir::Module module;
    std::string error;
    bool ok = ir::parseModule(text, module, error);
    INFO(error);
    REQUIRE(ok);
    return module;
}

inline ir::Module corpusModule(const std::string& name) {
    return parse(readText(corpusFolder() / name));
}

/// Text of one routine of a module, after the line that names it.
inline const ir::Routine& routine(const ir::Module& module, const std::string& name) {
    uint32_t index = module.findRoutine(name);
    REQUIRE(index != ir::kNone);
    return module.routines[index];
}

} // namespace ir_testing

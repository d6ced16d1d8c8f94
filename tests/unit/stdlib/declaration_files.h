#pragma once
// The declarations of the project itself, for tests of what the generator makes of them.

#include "stdlib/gen/model.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <filesystem>

inline stdlibgen::Model projectDeclarations() {
    namespace fs = std::filesystem;
    std::vector<std::string> files;
    for (const char* folder : {"decl", "data"})
        for (const auto& entry : fs::directory_iterator(fs::path(RAPIDC_SOURCE_DIR) / "stdlib" / folder))
            if (entry.path().extension() == ".sysx") files.push_back(entry.path().string());
    std::sort(files.begin(), files.end());
    stdlibgen::Model model = stdlibgen::readDeclarations(files);
    REQUIRE(model.errors.empty());
    return model;
}

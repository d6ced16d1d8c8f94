#pragma once
// A folder of its own for a test; the tests run side by side in many processes.

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <string>

struct TemporaryFolder {
    std::filesystem::path path;

    TemporaryFolder() {
        std::string name = (std::filesystem::temp_directory_path() / "rapidc_test_XXXXXX").string();
        if (const char* made = mkdtemp(name.data())) path = made;
    }
    ~TemporaryFolder() {
        std::error_code ignored;
        std::filesystem::remove_all(path, ignored);
    }
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    void write(const std::string& file, const std::string& text) const { std::ofstream(path / file) << text; }
};

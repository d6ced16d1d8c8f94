#pragma once
// The common part of mutators of RAPID texts: the programs of the tests as seeds, and the loop of changes.

#include <algorithm>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

namespace rapid::fuzz {

using Random = std::mt19937;

/// 0 to n - 1; 0 when n is 0.
inline size_t below(Random& random, size_t n) {
    return n == 0 ? 0 : random() % n;
}

inline std::string readAll(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    return {std::istreambuf_iterator<char>(file), {}};
}

/// Paths of the modules in folders of the sources ("/tests/golden"), in order.
inline std::vector<std::filesystem::path> modulePaths(const std::vector<std::string>& folders) {
    std::vector<std::filesystem::path> paths;
    for (const std::string& folder : folders)
        for (const auto& entry : std::filesystem::recursive_directory_iterator(RAPIDC_SOURCE_DIR + folder))
            if (entry.path().extension() == ".modx") paths.push_back(entry.path());
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// The texts of these modules.
inline std::vector<std::string> modulesOf(const std::vector<std::string>& folders) {
    std::vector<std::string> texts;
    for (const auto& path : modulePaths(folders))
        texts.push_back(readAll(path));
    return texts;
}

/// LLVMFuzzerCustomMutator: changes the input, or one of the seeds, one to `most` times. A text that becomes too long is cut.
template <class Change>
size_t mutate(uint8_t* data, size_t size, size_t maxSize, unsigned seed,
              const std::vector<std::string>& seeds, size_t most, const Change& change) {
    Random random(seed);
    std::string text(reinterpret_cast<const char*>(data), size);
    if (size < 20 || below(random, 50) == 0) text = seeds[below(random, seeds.size())];
    for (size_t n = 1 + below(random, most); n > 0; --n)
        change(text, random);
    text.resize(std::min(text.size(), maxSize));
    std::memcpy(data, text.data(), text.size());
    return text.size();
}

} // namespace rapid::fuzz

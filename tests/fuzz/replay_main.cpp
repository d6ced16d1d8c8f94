// Runs one fuzz target over kept inputs, as a test does it: without libFuzzer, so that the ordinary build has it. A broken
// promise ends the process; the name of the input stands before it.
//
//   rapidc_replay_format tests/fuzz/corpus/format

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);

namespace {

void replay(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    std::fprintf(stderr, "%s\n", path.c_str());
    LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

} // namespace

int main(int count, char** arguments) {
    size_t replayed = 0;
    try {
        for (int i = 1; i < count; ++i)
            for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments[i])) {
                if (!entry.is_regular_file()) continue;
                replay(entry.path());
                ++replayed;
            }
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
    std::printf("%zu inputs replayed\n", replayed);
    return replayed > 0 ? 0 : 1;
}

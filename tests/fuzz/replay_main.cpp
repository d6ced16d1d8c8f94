// Runs one fuzz target over kept inputs, as a test does it: without libFuzzer, so that the ordinary build has it. A broken
// promise ends the process; the name of the input is printed before it.
//
//   rapidc_replay_format tests/fuzz/corpus/format
//
// `-random=COUNT` and `-random=COUNT,SEED` try as many inputs of random bytes instead.

#include <cstdint>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <string>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size);
/// Only targets with inputs of a form of their own have one.
extern "C" __attribute__((weak)) size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize,
                                                                unsigned seed);

namespace {

void replay(const std::filesystem::path& path) {
    std::ifstream file(path, std::ios::binary);
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    std::fprintf(stderr, "%s\n", path.c_str());
    LLVMFuzzerTestOneInput(reinterpret_cast<const uint8_t*>(bytes.data()), bytes.size());
}

/// One input after the other, each of its own seed: that of a finding is last in the output.
size_t tryRandom(const std::string& order) {
    const size_t count = std::stoul(order);
    const size_t comma = order.find(',');
    const size_t first = comma == std::string::npos ? 1 : std::stoul(order.substr(comma + 1));
    for (size_t seed = first; seed < first + count; ++seed) {
        std::mt19937_64 random(seed);
        std::vector<uint8_t> bytes(20 + random() % 4000);
        for (uint8_t& byte : bytes)
            byte = static_cast<uint8_t>(random());
        if (LLVMFuzzerCustomMutator != nullptr) {
            constexpr size_t kMost = 20000;
            bytes.resize(kMost);
            bytes.resize(LLVMFuzzerCustomMutator(bytes.data(), 0, kMost, static_cast<unsigned>(seed)));
        }
        std::fprintf(stderr, "seed %zu\n", seed);
        LLVMFuzzerTestOneInput(bytes.data(), bytes.size());
    }
    return count;
}

} // namespace

int main(int count, char** arguments) {
    size_t replayed = 0;
    try {
        for (int i = 1; i < count; ++i) {
            const std::string argument = arguments[i];
            if (argument.starts_with("-random=")) {
                replayed += tryRandom(argument.substr(8));
                continue;
            }
            for (const auto& entry : std::filesystem::recursive_directory_iterator(arguments[i])) {
                if (!entry.is_regular_file()) continue;
                replay(entry.path());
                ++replayed;
            }
        }
    } catch (const std::exception& problem) {
        std::fprintf(stderr, "%s\n", problem.what());
        return 1;
    }
    std::printf("%zu inputs replayed\n", replayed);
    return replayed > 0 ? 0 : 1;
}

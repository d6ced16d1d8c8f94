// libFuzzer target: any texts as the modules of two tasks go through the whole front end. Modules are divided by a line
// with FF, tasks by one with FE. A part of the standard library is known. Must not crash or hang; diagnostics must lie
// within their files, and be the same for who only wants diagnostics.

#include "frontend/sema/checker.h"
#include "fuzz_support.h"

#include <fstream>
#include <sstream>
#include <vector>

namespace {

using namespace rapid;

/// Some of the predefined names, so that calls, modes and types of all kinds can be made while a run stays short.
const std::vector<sema::LibraryText>& library() {
    static std::vector<std::string> texts;
    static const std::vector<sema::LibraryText> parts = [] {
        std::vector<sema::LibraryText> made;
        static const char* const kNames[] = {"various", "waiting", "interrupts", "io_signals",
                                             "program_flow"};
        for (const char* name : kNames) {
            std::ifstream file(std::string(RAPIDC_SOURCE_DIR "/stdlib/decl/") + name + ".sysx",
                               std::ios::binary);
            std::ostringstream text;
            text << file.rdbuf();
            fuzz::require(!text.str().empty(), "a declaration file of the standard library is missing");
            texts.push_back(text.str());
        }
        for (size_t i = 0; i < texts.size(); ++i)
            made.push_back({kNames[i], texts[i]});
        return made;
    }();
    return parts;
}

std::vector<sema::TaskInput> tasksOf(const std::string& bytes) {
    std::vector<sema::TaskInput> tasks(1);
    std::string module;
    int number = 0;
    const auto finish = [&] {
        ++number;
        const std::string name = "m" + std::to_string(number) + (number % 2 ? ".modx" : ".mod");
        tasks.back().files.push_back(std::make_shared<const SourceFile>(name, std::exchange(module, {})));
    };
    for (const char c : bytes) {
        const auto byte = static_cast<unsigned char>(c);
        if (byte < 0xFE) {
            module += c;
            continue;
        }
        finish();
        if (byte == 0xFE && tasks.size() < 3) {
            tasks.emplace_back();
            tasks.back().name = "T_" + std::to_string(tasks.size());
            tasks.back().type = "STATIC";
            tasks.back().missingModules = {"secret.sys"};
            tasks.back().incomplete = tasks.back().optional = true;
        }
    }
    finish();
    return tasks;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    const std::string bytes = fuzz::bytesOf(data, size);
    sema::CheckOptions options;
    options.library = library();
    options.requireMain = size % 2 != 0;
    options.configurationKnown = size % 3 == 0;
    options.signals = {{"di1", "signaldi"}, {"do1", "signaldo"}, {"go1", "signalgo"}};
    std::string shown[2];
    for (const bool only : {false, true}) {
        options.onlyDiagnostics = only;
        diag::Sink sink;
        const auto program = sema::check(tasksOf(bytes), options, sink);
        fuzz::require(program != nullptr, "no program");
        fuzz::checkDiagnostics(sink);
        for (const diag::Diagnostic& d : sink.sorted())
            shown[only] += renderText(d, false);
    }
    fuzz::require(shown[0] == shown[1], "other diagnostics for who only wants them");
    return 0;
}

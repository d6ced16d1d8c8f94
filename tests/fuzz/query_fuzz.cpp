// libFuzzer target: an editor asks everything at places of a changed program of the tests. Answers lie within the texts. The input is the
// text of a module; its bytes choose the places. A part of the standard library is known.
//
//   rapidc_fuzz_query -dict=tests/fuzz/dictionaries/rapid.dict <own corpus folder> tests/fuzz/corpus/query

#include "frontend/sema/checker.h"
#include "fuzz_support.h"
#include "tests/unit/query/every_query.h"
#include "text_mutator.h"

#include <algorithm>

namespace {

using namespace rapid;
using fuzz::below;
using fuzz::Random;

const std::vector<sema::LibraryText>& library() {
    static std::vector<std::string> texts;
    static const std::vector<sema::LibraryText> parts = [] {
        std::vector<sema::LibraryText> made;
        static const char* const kNames[] = {"data/types_basic", "data/types_motion", "data/types_nonvalue",
                                             "data/symbols",     "data/system",       "data/speeds",
                                             "decl/move",        "decl/various",      "decl/io_signals",
                                             "decl/program_flow"};
        for (const char* name : kNames) {
            texts.push_back(fuzz::readAll(std::string(RAPIDC_SOURCE_DIR "/stdlib/") + name + ".sysx"));
            fuzz::require(!texts.back().empty(), "a declaration file of the standard library is missing");
        }
        for (size_t i = 0; i < texts.size(); ++i)
            made.push_back({kNames[i], texts[i]});
        return made;
    }();
    return parts;
}

const std::vector<std::string>& seeds() {
    static const std::vector<std::string> texts = fuzz::modulesOf({"/tests/golden", "/tests/diag"});
    return texts;
}

/// Changes of a text that is being written: pieces go, come twice, or are half there.
void change(std::string& text, Random& random) {
    static const char* const kPieces[] = {";", ",",     "\\",     ".",        ":=",      "(",       ")",
                                          "{", "}",     "[",      "]",        "%",       "\"",      "\n",
                                          " ", "IF ",   "MoveL ", "VAR num ", "ENDPROC", "PROC p(", "x",
                                          "!", "ERROR", "TRUE",   "1",        "+",       "\xFF"};
    const size_t at = below(random, text.size() + 1), length = std::min(below(random, 40), text.size() - at);
    switch (below(random, 5)) {
    case 0: text.erase(at, length); break;
    case 1: text.insert(at, kPieces[below(random, std::size(kPieces))]); break;
    case 2: text.insert(below(random, text.size() + 1), text.substr(at, length)); break;
    case 3:
        text.replace(at, std::min<size_t>(1, text.size() - at), kPieces[below(random, std::size(kPieces))]);
        break;
    default:
        if (below(random, 4) == 0) text.resize(at);
    }
}

} // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize, unsigned seed) {
    return fuzz::mutate(data, size, maxSize, seed, seeds(), 4, change);
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    sema::TaskInput task;
    task.files.push_back(std::make_shared<const SourceFile>("m.modx", fuzz::bytesOf(data, size)));
    sema::CheckOptions options;
    options.library = library();
    options.signals = {{"di1", "signaldi"}, {"do1", "signaldo"}};
    diag::Sink sink;
    const auto program = sema::check({task}, options, sink);
    const query::Snapshot snapshot(*program);
    const query::FileView* file = snapshot.file("m.modx");
    if (!file) return 0; // not a text
    query::testing::EveryQuery query(snapshot, *file);
    const auto require = [](const char* problem) {
        fuzz::require(problem == nullptr, problem ? problem : "");
    };
    require(query.whole());
    uint32_t place = size > 0 ? data[size / 2] : 0;
    for (int i = 0; i < 6; ++i) {
        place = place * 1664525 + 1013904223 + static_cast<uint32_t>(size);
        require(query.at(place % (static_cast<uint32_t>(file->text().size()) + 2)));
    }
    return 0;
}

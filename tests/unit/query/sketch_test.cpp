// An answer at the cursor while the rest of a changed file has not been checked (Session::sketch) is the one that a check of everything
// gives.

#include "query_testing.h"

#include "frontend/query/signature_help.h"
#include "frontend/sema/session.h"

#include <catch2/catch.hpp>

#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <filesystem>
#include <random>

using namespace rapid;
using namespace rapid::query;

namespace {

using Random = std::mt19937;

size_t below(Random& random, size_t bound) {
    return bound == 0 ? 0 : random() % bound;
}

std::vector<std::string> modules() {
    std::vector<std::string> paths;
    for (const char* folder : {"golden", "diag"})
        for (const auto& entry :
             std::filesystem::recursive_directory_iterator(std::string(RAPIDC_SOURCE_DIR "/tests/") + folder))
            if (entry.path().extension() == ".modx") paths.push_back(entry.path().string());
    std::sort(paths.begin(), paths.end());
    return paths;
}

/// In the order of labels. Left out is what depends on uses in other routines, which may have changed: how far up predefined routines
/// come, and signals that are known by their uses.
std::string show(const CompletionList& list) {
    std::vector<std::string> lines;
    for (const CompletionItem& item : list.items) {
        if (item.kind == ItemKind::Signal) continue;
        const bool ranked =
            item.symbol && item.symbol->predefined && item.symbol->kind == sema::SymbolKind::Routine;
        std::string& line = lines.emplace_back("\n" + item.label);
        for (const std::string& part :
             {std::to_string(static_cast<int>(item.kind)), item.detail, item.insertText, item.snippet,
              ranked ? "" : item.sortText, item.filterText, item.key})
            line += "|" + part;
        if (item.fits) line += "|fits";
        for (const TextEdit& edit : item.edits)
            line += "|" + std::to_string(edit.range.begin) + ":" + edit.replacement;
    }
    std::sort(lines.begin(), lines.end());
    std::string out = std::to_string(list.replace.begin) + "-" + std::to_string(list.replace.end) +
                      (list.incomplete ? " more" : "");
    for (const std::string& line : lines)
        out += line;
    return out;
}

std::string show(const std::optional<SignatureHelp>& help) {
    if (!help) return "none";
    std::string out = help->label + " " + std::to_string(help->active);
    for (const SignatureParameter& parameter : help->parameters)
        out += " " + std::to_string(parameter.begin) + "-" + std::to_string(parameter.end);
    return out;
}

/// Completion and signature help at `offset`.
std::string answers(const sema::Session& session, const std::string& path, uint32_t offset) {
    const Snapshot snapshot(session.program());
    const FileView& file = *snapshot.file(path);
    return show(completionAt(snapshot, file, offset)) + "\n" + show(signatureHelpAt(snapshot, file, offset));
}

/// A text into which something is typed, and the place after it.
std::pair<std::string, uint32_t> typed(Random& random, const std::string& text) {
    static const std::vector<std::string> kWords = {
        "Mo",       "r",   "\n    Mov", "x.",           "\\",   "(",
        ",",        " v1", ";\n",       ":=",           "{1}.", "\nENDPROC\n",
        "\nVAR nu", "IF ", "Offs(",     "\nPROC p()\n", "\"",   "%\""};
    const std::string& word = kWords[below(random, kWords.size())];
    size_t place = below(random, text.size());
    if (below(random, 2) == 0) place = std::min(text.find('\n', place), text.size());
    const size_t gone = below(random, 3) == 0 ? below(random, 6) : 0;
    std::string out = text.substr(0, place) + word + text.substr(std::min(place + gone, text.size()));
    return {std::move(out), static_cast<uint32_t>(place + word.size())};
}

std::string firstDifference(const std::string& one, const std::string& other) {
    const auto [a, b] = std::mismatch(one.begin(), one.end(), other.begin(), other.end());
    const auto lineOf = [](const std::string& text, std::string::const_iterator at) {
        const size_t place = static_cast<size_t>(at - text.begin());
        const size_t begin = place == 0 ? std::string::npos : text.rfind('\n', place - 1);
        return text.substr(begin == std::string::npos ? 0 : begin + 1,
                           text.find('\n', place) - (begin == std::string::npos ? 0 : begin + 1));
    };
    return "first:  " + lineOf(one, a) + "\nafter: " + lineOf(other, b);
}

void typeInto(const std::string& path, const std::string& other, Random& random, int edits,
              bool signalsKnown) {
    sema::CheckOptions options;
    options.library = sema::testing::library();
    options.configurationKnown = signalsKnown;
    std::string text = sema::testing::readFile(path);
    sema::TaskInput input;
    input.name = "T_ROB1";
    input.files = {std::make_shared<const SourceFile>(path, text),
                   std::make_shared<const SourceFile>(other, sema::testing::readFile(other))};
    sema::Session session(options);
    session.open({input});
    for (int i = 0; i < edits; ++i) {
        auto [now, offset] = typed(random, text);
        if (!session.sketch(std::make_shared<const SourceFile>(path, now), offset)) return;
        const std::string early = answers(session, path, offset);
        if (below(random, 2) == 0) session.complete(); // else the next letter comes before
        if (session.isComplete()) {
            const std::string late = answers(session, path, offset);
            INFO(path << ", offset " << offset << "\n" << now);
            INFO(firstDifference(early, late));
            REQUIRE((early == late));
        }
        if (below(random, 3) != 0) text = now;
    }
}

} // namespace

TEST_CASE("query: an answer at the cursor does not depend on the check of the rest", "[query][every]") {
    const std::vector<std::string> paths = modules();
    REQUIRE(paths.size() > 500);
    const char* const given = std::getenv("RAPIDC_SKETCH_STRIDE");
    const size_t stride = given ? static_cast<size_t>(std::max(1, std::atoi(given))) : 29;
    Random random(7);
    for (size_t i = 0; i < paths.size(); i += stride)
        for (const bool signalsKnown : {false, true})
            typeInto(paths[i], paths[(i + 400) % paths.size()], random, 12, signalsKnown);
}

namespace {

/// A session with a module that is typed in, in each of some tasks, beside another one.
struct Typing {
    static constexpr const char* kPath = "/cell/typed.modx";

    Typing(const std::string& text, size_t tasks, size_t largeFrom) : session(options()) {
        session.setLargeFrom(largeFrom);
        std::vector<sema::TaskInput> inputs(tasks);
        for (size_t i = 0; i < tasks; ++i) {
            inputs[i].name = "T_ROB" + std::to_string(i + 1);
            inputs[i].files = {std::make_shared<const SourceFile>(kPath, text),
                               std::make_shared<const SourceFile>(
                                   "/cell/other.modx", "MODULE other\n  VAR speeddata slow;\nENDMODULE\n")};
        }
        session.open(inputs);
    }
    static sema::CheckOptions options() {
        sema::CheckOptions options;
        options.library = sema::testing::library();
        return options;
    }
    /// The labels of what has the expected type at `$1`, with those that the library declares left out.
    std::string offered(const std::string& marked) {
        const auto place = static_cast<uint32_t>(marked.find("$1"));
        std::string text = marked;
        text.erase(place, 2);
        REQUIRE(session.sketch(std::make_shared<const SourceFile>(kPath, text), place));
        return offeredAt(place);
    }
    std::string offeredAt(uint32_t place) {
        const Snapshot snapshot(session.program());
        std::string labels;
        for (const CompletionItem& item : completionAt(snapshot, *snapshot.file(kPath), place).items)
            if (item.fits && item.symbol && !item.symbol->predefined) labels += item.label + " ";
        return labels;
    }

    sema::Session session;
};

} // namespace

// Decision 144: the declarations of the module and the routine at the cursor are those of the text as it is now, though other modules
// that can see them have not been checked.
TEST_CASE("query: declarations of a large program are offered as soon as they are typed", "[query]") {
    Typing typing("MODULE typed\nENDMODULE\n", 1, 0);
    CHECK(typing.offered("MODULE typed\n  VAR speeddata mine;\n  PROC go(speeddata given)\n"
                         "    VAR speeddata own;\n    MoveJ *,$1\n  ENDPROC\nENDMODULE\n") ==
          "given own mine slow ");
    CHECK(typing.session.isSlowToComplete());
    // A name with one more letter, a parameter whose type is different, and a variable that is gone.
    CHECK(typing.offered("MODULE typed\n  VAR speeddata mines;\n  PROC go(num given)\n"
                         "    MoveJ *,$1\n  ENDPROC\nENDMODULE\n") == "mines slow ");
    typing.session.complete();
    CHECK_FALSE(typing.session.isSlowToComplete());
    CHECK(typing.session.isComplete());
}

TEST_CASE("query: declarations of a small program are checked at once", "[query]") {
    Typing typing("MODULE typed\nENDMODULE\n", 1, SIZE_MAX);
    CHECK(typing.offered("MODULE typed\n  VAR speeddata mine;\n  PROC go()\n    MoveJ *,$1\n"
                         "  ENDPROC\nENDMODULE\n") == "mine slow ");
    CHECK(typing.session.isComplete());
}

TEST_CASE("query: a module of several tasks is sketched in the first", "[query]") {
    Typing typing("MODULE typed\n  PROC go()\n    MoveJ *,\n  ENDPROC\nENDMODULE\n", 3, SIZE_MAX);
    CHECK(typing.offered("MODULE typed\n  PROC go()\n    VAR speeddata own;\n    MoveJ *,$1\n"
                         "  ENDPROC\nENDMODULE\n") == "own slow ");
    CHECK_FALSE(typing.session.isComplete());
    CHECK(typing.offered("MODULE typed\n  PROC go()\n    VAR speeddata owns;\n    MoveJ *,$1\n"
                         "  ENDPROC\nENDMODULE\n") == "owns slow ");
    typing.session.complete();
    const Snapshot snapshot(typing.session.program());
    REQUIRE(snapshot.filesOf(Typing::kPath).size() == 3);
    for (const FileView* file : snapshot.filesOf(Typing::kPath))
        CHECK(file->text().find("owns") != std::string_view::npos);
}

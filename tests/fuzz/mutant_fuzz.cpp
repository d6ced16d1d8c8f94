// libFuzzer target: a program of the tests, changed word by word and line by line. What check accepts must come through to
// machine code and a bounded run, in both profiles. The input is the text of the module.

#include "frontend/syntax/lexer.h"
#include "fuzz_support.h"
#include "tests/fuzz/program_runner.h"
#include "text_mutator.h"

#include <algorithm>

namespace {

using namespace rapid;
using fuzz::below;
using fuzz::Random;

/// The programs of the tests that consist of one module.
const std::vector<std::string>& seeds() {
    static const std::vector<std::string> texts = [] {
        std::vector<std::string> modules = fuzz::modulesOf({"/tests/golden"});
        std::erase_if(modules,
                      [](const std::string& text) { return text.find("PROC main(") == std::string::npos; });
        return modules;
    }();
    return texts;
}

struct Word {
    syntax::TokenKind kind;
    std::string text;
    size_t at;
};

std::vector<Word> wordsOf(const std::string& text) {
    std::vector<Word> words;
    for (const syntax::Token& token : syntax::lex(text).tokens)
        if (token.length > 0)
            words.push_back({token.kind, text.substr(token.offset, token.length), token.offset});
    return words;
}

std::vector<std::string> linesOf(const std::string& text) {
    std::vector<std::string> lines;
    for (size_t from = 0; from < text.size();) {
        const size_t end = std::min(text.find('\n', from), text.size() - 1) + 1;
        lines.push_back(text.substr(from, end - from));
        from = end;
    }
    return lines;
}

std::string joined(const std::vector<std::string>& lines) {
    std::string text;
    for (const std::string& line : lines)
        text += line;
    return text;
}

/// One word becomes another of its kind.
std::string changeWord(std::string text, Random& random) {
    static const char* const kNumbers[] = {"0",    "1",          "2",          "-1",       "0.5",
                                           "3.7",  "1E10",       "1E38",       "16777216", "255",
                                           "1E-6", "4294967295", "2147483647", "80"};
    static const char* const kOperators[] = {
        "+", "-", "*", "/", "<", "<=", ">", ">=", "=", "<>", " DIV ", " MOD ", " AND ", " OR ", " XOR "};
    const std::vector<Word> words = wordsOf(text);
    if (words.empty()) return text;
    const Word& word = words[below(random, words.size())];
    std::string other;
    const bool isNumber = word.kind == syntax::TokenKind::NumLiteral;
    const bool isOperator = word.text.find_first_of("+-*/<>=") == 0 && word.text != ":=";
    if (isNumber && below(random, 2) == 0) {
        other = kNumbers[below(random, std::size(kNumbers))];
    } else if (isOperator) {
        other = kOperators[below(random, std::size(kOperators))];
    } else {
        const std::vector<Word> donors =
            below(random, 4) == 0 ? wordsOf(seeds()[below(random, seeds().size())]) : words;
        std::vector<const Word*> fitting;
        for (const Word& donor : donors)
            if (donor.kind == word.kind && donor.text != word.text) fitting.push_back(&donor);
        if (!fitting.empty()) other = fitting[below(random, fitting.size())]->text;
    }
    if (!other.empty()) text.replace(word.at, word.text.size(), other);
    return text;
}

std::string changeLines(const std::string& text, Random& random) {
    std::vector<std::string> lines = linesOf(text);
    if (lines.size() < 4) return text;
    const auto at = [&] { return static_cast<std::ptrdiff_t>(1 + below(random, lines.size() - 2)); };
    const auto from = at(), to = at();
    const std::string line = lines[static_cast<size_t>(from)];
    switch (below(random, 4)) {
    case 0: lines.erase(lines.begin() + from); break;
    case 1: lines.insert(lines.begin() + to, line); break;
    case 2: std::swap(lines[static_cast<size_t>(from)], lines[static_cast<size_t>(to)]); break;
    default: {
        const std::vector<std::string> donor = linesOf(seeds()[below(random, seeds().size())]);
        if (!donor.empty()) lines.insert(lines.begin() + to, donor[below(random, donor.size())]);
    }
    }
    return joined(lines);
}

/// Waits for people and other machines: nothing for a run without them.
bool isLeftOut(const std::string& text) {
    for (const Word& word : wordsOf(text)) {
        std::string folded = word.text;
        std::transform(folded.begin(), folded.end(), folded.begin(),
                       [](unsigned char c) { return std::tolower(c); });
        for (const char* begin :
             {"socket", "egm", "uialpha", "uimsg", "uinum", "uidnum", "uilist", "uimess", "tpread"})
            if (folded.starts_with(begin)) return true;
    }
    return false;
}

} // namespace

extern "C" size_t LLVMFuzzerCustomMutator(uint8_t* data, size_t size, size_t maxSize, unsigned seed) {
    return fuzz::mutate(data, size, maxSize, seed, seeds(), 3, [](std::string& text, Random& random) {
        text = below(random, 3) > 0 ? changeWord(std::move(text), random) : changeLines(text, random);
    });
}

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    static fuzz::ProgramRunner runner;
    const std::string text = fuzz::bytesOf(data, size);
    if (isLeftOut(text)) return 0;
    fuzz::tryProgram(runner, {{text}}, true, text.size() % 4 == 0);
    return 0;
}

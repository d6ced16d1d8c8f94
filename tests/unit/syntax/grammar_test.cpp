// Sentences derived from frontend/rapid.ebnf are RAPID; broken ones neither stop nor confuse the parser.

#include "ebnf.h"
#include "syntax_test.h"

#include "frontend/diag/messages/syntax.h"
#include "frontend/syntax/token_set.h"

#include <catch2/catch.hpp>

#include <fstream>
#include <iterator>

using namespace rapid;
using rapid::test::Grammar;

namespace {

const Grammar& grammar() {
    static const Grammar result = [] {
        std::ifstream file(RAPIDC_SOURCE_DIR "/frontend/rapid.ebnf", std::ios::binary);
        REQUIRE(file.good());
        const std::string text((std::istreambuf_iterator<char>(file)), {});
        return test::readGrammar(text);
    }();
    return result;
}

void collectWords(const Grammar::Part& part, std::vector<std::string>& words) {
    if (part.kind == Grammar::Kind::Terminal) words.push_back(part.text);
    for (const Grammar::Part& child : part.parts)
        collectWords(child, words);
}

} // namespace

TEST_CASE("the grammar uses every keyword and placeholder, and no other", "[syntax][grammar]") {
    std::vector<std::string> words;
    for (const auto& [name, rule] : grammar().rules)
        collectWords(rule.body, words);
    for (auto k = static_cast<int>(syntax::TokenKind::KwAlias);
         k <= static_cast<int>(syntax::TokenKind::PlaceId); ++k) {
        const auto kind = static_cast<syntax::TokenKind>(k);
        if (kind == syntax::TokenKind::FileHeader || kind == syntax::TokenKind::PlainAggregate) continue;
        INFO(syntax::tokenText(kind));
        CHECK(std::find(words.begin(), words.end(), syntax::tokenText(kind)) != words.end());
    }
    for (const std::string& word : words) {
        if (word.size() < 2 || !std::isupper(static_cast<unsigned char>(word[0])) ||
            word.find(':') != std::string::npos)
            continue;
        if (static_cast<unsigned char>(word[1]) >= 0x80) continue;
        INFO(word);
        CHECK((word == "TASK" || syntax::keywordKind(word) != syntax::TokenKind::Identifier));
    }
}

TEST_CASE("random sentences of the grammar parse without a diagnostic", "[syntax][grammar][slow]") {
    constexpr int kSentences = 3000;
    size_t tokens = 0;
    for (int seed = 0; seed < kSentences; ++seed) {
        std::mt19937 random(static_cast<uint32_t>(seed));
        const auto sentence =
            test::deriveSentence(grammar(), "file", 12 + static_cast<uint32_t>(seed % 24), random);
        tokens += sentence.size();
        const std::string text = test::layOut(sentence, random);
        const test::Parsed parsed = test::parseText(text);
        if (parsed.sink.all().empty() && syntax::printSource(*parsed.tree) == text) continue;
        INFO("seed " << seed << "\n" << text << "\n" << parsed.shown());
        for (const diag::Diagnostic& d : parsed.sink.all())
            REQUIRE(d.code == diag::say::CommentOutsideModule.code);
        REQUIRE(syntax::printSource(*parsed.tree) == text);
    }
    CHECK(tokens > 100u * kSentences / 10);
}

TEST_CASE("broken sentences are read without loss and reported within bounds", "[syntax][grammar]") {
    constexpr int kSentences = 2000;
    for (int seed = 0; seed < kSentences; ++seed) {
        std::mt19937 random(static_cast<uint32_t>(seed) + 1000000u);
        auto sentence =
            test::deriveSentence(grammar(), "file", 12 + static_cast<uint32_t>(seed % 24), random);
        for (uint32_t i = 0; i <= random() % 4 && sentence.size() > 2; ++i) {
            const size_t at = random() % sentence.size();
            switch (random() % 4) {
            case 0: sentence.erase(sentence.begin() + static_cast<std::ptrdiff_t>(at)); break;
            case 1: sentence[at] = sentence[random() % sentence.size()]; break;
            case 2: std::swap(sentence[at], sentence[random() % sentence.size()]); break;
            default: sentence.insert(sentence.begin() + static_cast<std::ptrdiff_t>(at), "#"); break;
            }
        }
        const std::string text = test::layOut(sentence, random);
        const test::Parsed parsed = test::parseText(text);
        INFO("seed " << seed << "\n" << text);
        REQUIRE(syntax::printSource(*parsed.tree) == text);
        REQUIRE(parsed.sink.errorCount() <= 200);
        syntax::printTree(*parsed.tree);
    }
}

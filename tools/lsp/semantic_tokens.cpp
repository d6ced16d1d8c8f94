#include "tools/lsp/semantic_tokens.h"

#include "config/json_text.h"
#include "frontend/query/semantic_tokens.h"
#include "tools/lsp/requests.h"

#include <algorithm>
#include <map>

namespace lsp {

namespace query = rapid::query;
using Numbers = std::vector<uint32_t>;

namespace {

/// In the order of query::TokenType and of the bits of query::TokenModifier.
const char* const kTypes[] = {"namespace", "type",    "function", "parameter", "variable", "property",
                              "label",     "keyword", "string",   "number",    "comment"};
const char* const kModifiers[] = {"declaration", "readonly", "defaultLibrary", "static"};

constexpr size_t kNumbersOfToken = 5;

Numbers encode(const PositionMap& positions, const std::vector<query::SemanticToken>& tokens) {
    Numbers numbers;
    numbers.reserve(tokens.size() * kNumbersOfToken);
    Position before;
    for (const query::SemanticToken& token : tokens) {
        const Position at = positions.at(token.offset);
        const uint32_t length = positions.units({token.offset, token.offset + token.length});
        const bool sameLine = at.line == before.line;
        numbers.insert(numbers.end(),
                       {at.line - before.line, sameLine ? at.character - before.character : at.character,
                        length, static_cast<uint32_t>(token.type), token.modifiers});
        before = at;
    }
    return numbers;
}

/// The state that the client has of a document: the last answer.
struct Kept {
    uint64_t number = 0;
    Numbers numbers;
};

Kept& kept(const std::string& path) {
    constexpr size_t kMostKept = 32;
    static std::map<std::string, Kept> all; // one thread works on requests
    if (all.size() > kMostKept && !all.contains(path)) all.clear();
    return all[path];
}

uint64_t nextNumber() {
    static uint64_t last = 0;
    return ++last;
}

Numbers numbersOf(const State& state, const Target& target) {
    if (!target.isModule()) return {};
    return encode(*target.positions, query::semanticTokens(*target.snapshot, *target.view, state.cancel));
}

/// The piece that differs.
Json edit(const Numbers& before, const Numbers& now) {
    const auto head = std::mismatch(before.begin(), before.end(), now.begin(), now.end());
    const auto same = static_cast<size_t>(head.first - before.begin());
    const size_t most = std::min(before.size(), now.size()) - same;
    size_t tail = 0;
    while (tail < most && before[before.size() - 1 - tail] == now[now.size() - 1 - tail])
        ++tail;
    const Numbers data(now.begin() + static_cast<std::ptrdiff_t>(same),
                       now.end() - static_cast<std::ptrdiff_t>(tail));
    return {{"start", same}, {"deleteCount", before.size() - same - tail}, {"data", data}};
}

} // namespace

Json semanticTokensProvider() {
    return {{"legend", {{"tokenTypes", kTypes}, {"tokenModifiers", kModifiers}}},
            {"full", {{"delta", true}}},
            {"range", true}};
}

Json semanticTokensFull(State& state, const Json& params) {
    const Target target = state.target(params);
    Kept& last = kept(target.path);
    last = {nextNumber(), numbersOf(state, target)};
    return {{"resultId", std::to_string(last.number)}, {"data", last.numbers}};
}

Json semanticTokensDelta(State& state, const Json& params) {
    const std::string previous = textField(params, "previousResultId");
    const Target target = state.target(params);
    Kept& last = kept(target.path);
    if (previous != std::to_string(last.number)) return semanticTokensFull(state, params);
    Numbers now = numbersOf(state, target);
    Json edits = Json::array();
    if (now != last.numbers) edits.push_back(edit(last.numbers, now));
    last = {nextNumber(), std::move(now)};
    return {{"resultId", std::to_string(last.number)}, {"edits", std::move(edits)}};
}

Json semanticTokensRange(State& state, const Json& params) {
    const Target target = state.target(params);
    const rapid::SourceRange range = target.positions->offsets(rangeOf(field(params, "range")));
    if (!target.isModule()) return {{"data", Json::array()}};
    std::vector<query::SemanticToken> tokens =
        query::semanticTokens(*target.snapshot, *target.view, range, false, state.cancel);
    std::erase_if(tokens, [&](const query::SemanticToken& token) {
        return token.offset + token.length <= range.begin || token.offset >= range.end;
    });
    return {{"data", encode(*target.positions, tokens)}};
}

} // namespace lsp

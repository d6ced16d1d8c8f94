#include "ebnf.h"

#include <algorithm>
#include <cctype>
#include <set>
#include <stdexcept>

namespace rapid::test {

namespace {

using Kind = Grammar::Kind;
using Part = Grammar::Part;

class Reader {
  public:
    explicit Reader(std::string_view text) : text_(text) {}

    Grammar read() {
        Grammar grammar;
        for (skip(); at_ < text_.size(); skip()) {
            const std::string name = word();
            skip();
            Grammar::Rule rule;
            rule.characters = accept("::=");
            if (!rule.characters) expect("=");
            rule.body = choice();
            expect(";");
            if (!grammar.rules.emplace(name, std::move(rule)).second) fail("second rule " + name);
        }
        for (const auto& [name, rule] : grammar.rules)
            verify(grammar, rule.body);
        return grammar;
    }

  private:
    [[noreturn]] void fail(const std::string& what) const {
        const auto line =
            std::count(text_.begin(), text_.begin() + static_cast<std::ptrdiff_t>(at_), '\n') + 1;
        throw std::runtime_error("rapid.ebnf:" + std::to_string(line) + ": " + what);
    }

    void skip() {
        for (;;) {
            while (at_ < text_.size() && std::isspace(static_cast<unsigned char>(text_[at_])))
                ++at_;
            if (text_.substr(at_, 2) != "(*") return;
            const size_t end = text_.find("*)", at_);
            if (end == std::string_view::npos) fail("comment without end");
            at_ = end + 2;
        }
    }

    bool accept(std::string_view s) {
        skip();
        if (text_.substr(at_, s.size()) != s) return false;
        at_ += s.size();
        return true;
    }
    void expect(std::string_view s) {
        if (!accept(s)) fail("expected " + std::string(s));
    }

    std::string word() {
        const size_t from = at_;
        while (at_ < text_.size() &&
               (std::isalnum(static_cast<unsigned char>(text_[at_])) || text_[at_] == '_'))
            ++at_;
        if (at_ == from) fail("expected a name");
        return std::string(text_.substr(from, at_ - from));
    }

    std::string terminal() {
        expect("'");
        const size_t end = text_.find('\'', at_);
        if (end == std::string_view::npos) fail("terminal without end");
        std::string result(text_.substr(at_, end - at_));
        at_ = end + 1;
        return result;
    }

    static uint32_t decode(const std::string& s) {
        const auto c = static_cast<unsigned char>(s[0]);
        uint32_t value = c < 0x80 ? c : c < 0xE0 ? c & 0x1Fu : c < 0xF0 ? c & 0x0Fu : c & 0x07u;
        for (size_t i = 1; i < s.size(); ++i)
            value = value << 6 | (static_cast<unsigned char>(s[i]) & 0x3Fu);
        return value;
    }

    Part choice() {
        Part result{Kind::Choice, {}, 0, 0, {}, 0};
        do
            result.parts.push_back(sequence());
        while (accept("|"));
        return result.parts.size() == 1 ? Part(result.parts[0]) : result;
    }

    Part sequence() {
        Part result{Kind::Sequence, {}, 0, 0, {}, 0};
        for (skip();
             at_ < text_.size() && std::string_view("|;)]}").find(text_[at_]) == std::string_view::npos;
             skip())
            result.parts.push_back(item());
        if (result.parts.empty()) fail("empty alternative");
        return result.parts.size() == 1 ? Part(result.parts[0]) : result;
    }

    Part item() {
        if (text_[at_] == '\'') {
            Part result{Kind::Terminal, terminal(), 0, 0, {}, 0};
            if (!accept("..")) return result;
            skip();
            result.kind = Kind::Range;
            result.low = decode(result.text);
            result.high = decode(terminal());
            return result;
        }
        if (accept("[")) return enclosed(Kind::Optional, "]");
        if (accept("{")) return enclosed(Kind::Repeat, "}");
        if (accept("(")) {
            Part result = choice();
            expect(")");
            return result;
        }
        return {Kind::Rule, word(), 0, 0, {}, 0};
    }

    Part enclosed(Kind kind, std::string_view closing) {
        Part result{kind, {}, 0, 0, {}, 0};
        result.parts.push_back(choice());
        expect(closing);
        return result;
    }

    void verify(const Grammar& grammar, const Part& part) {
        if (part.kind == Kind::Rule && !grammar.rules.contains(part.text))
            throw std::runtime_error("rapid.ebnf: no rule " + part.text);
        for (const Part& child : part.parts)
            verify(grammar, child);
    }

    std::string_view text_;
    size_t at_ = 0;
};

constexpr uint32_t kEndless = 1000000;

uint32_t depthOf(const Grammar& grammar, const Part& part) {
    switch (part.kind) {
    case Kind::Terminal:
    case Kind::Range:
    case Kind::Optional:
    case Kind::Repeat: return 0;
    case Kind::Rule: return grammar.rules.at(part.text).depth + 1;
    case Kind::Sequence:
    case Kind::Choice: break;
    }
    uint32_t result = part.kind == Kind::Choice ? kEndless : 0;
    for (const Part& child : part.parts) {
        const uint32_t depth = depthOf(grammar, child);
        result = part.kind == Kind::Choice ? std::min(result, depth) : std::max(result, depth);
    }
    return std::min(result, kEndless);
}

void store(const Grammar& grammar, Part& part) {
    part.depth = depthOf(grammar, part);
    for (Part& child : part.parts)
        store(grammar, child);
}

void computeDepths(Grammar& grammar) {
    for (auto& [name, rule] : grammar.rules)
        rule.depth = kEndless;
    for (bool changed = true; changed;) {
        changed = false;
        for (auto& [name, rule] : grammar.rules) {
            const uint32_t depth = depthOf(grammar, rule.body);
            changed |= depth < rule.depth;
            rule.depth = std::min(rule.depth, depth);
        }
    }
    for (auto& [name, rule] : grammar.rules) {
        if (rule.depth >= kEndless) throw std::runtime_error("rapid.ebnf: rule " + name + " never ends");
        store(grammar, rule.body);
    }
}

std::string encode(uint32_t c) {
    std::string out;
    if (c < 0x80) {
        out.push_back(static_cast<char>(c));
    } else {
        out.push_back(static_cast<char>(0xC0 | c >> 6));
        out.push_back(static_cast<char>(0x80 | (c & 0x3F)));
    }
    return out;
}

class Deriver {
  public:
    Deriver(const Grammar& grammar, std::mt19937& random) : grammar_(grammar), random_(random) {}

    void derive(const Part& part, uint32_t budget) {
        switch (part.kind) {
        case Kind::Terminal: return emit(part.text);
        case Kind::Range:
            return emit(encode(std::uniform_int_distribution<uint32_t>(part.low, part.high)(random_)));
        case Kind::Rule: return rule(part.text, budget);
        case Kind::Sequence:
            for (const Part& child : part.parts)
                derive(child, budget);
            return;
        case Kind::Choice: return choose(part, budget);
        case Kind::Optional:
            if (fits(part.parts[0], budget) && chance(50)) derive(part.parts[0], budget);
            return;
        case Kind::Repeat:
            for (int i = 0; i < 6 && fits(part.parts[0], budget) && chance(characters_ ? 60 : 45); ++i)
                derive(part.parts[0], budget);
            return;
        }
    }

    std::vector<std::string> tokens;

  private:
    bool chance(uint32_t percent) { return random_() % 100 < percent; }
    static bool fits(const Part& part, uint32_t budget) { return part.depth <= budget; }

    void choose(const Part& part, uint32_t budget) {
        std::vector<const Part*> possible;
        for (const Part& child : part.parts)
            if (fits(child, budget)) possible.push_back(&child);
        if (possible.empty()) {
            const auto least =
                std::min_element(part.parts.begin(), part.parts.end(),
                                 [](const Part& a, const Part& b) { return a.depth < b.depth; });
            possible.push_back(&*least);
        }
        derive(*possible[random_() % possible.size()], budget);
    }

    void rule(const std::string& name, uint32_t budget) {
        const Grammar::Rule& rule = grammar_.rules.at(name);
        const uint32_t rest = budget > 0 ? budget - 1 : 0;
        if (!rule.characters || characters_) return derive(rule.body, rest);
        for (;;) { // a token of characters; one that happens to be a word of the language does not count
            characters_ = true;
            word_.clear();
            derive(rule.body, 8);
            characters_ = false;
            if (word_.size() <= 32 && !isReserved(word_)) break;
        }
        tokens.push_back(word_);
    }

    bool isReserved(const std::string& word) const {
        std::string upper = word;
        std::transform(upper.begin(), upper.end(), upper.begin(),
                       [](unsigned char c) { return static_cast<char>(c < 0x80 ? std::toupper(c) : c); });
        static const std::set<std::string> kWords = {"DO",  "IF",  "OR",  "TO",  "MOD", "DIV",  "AND",
                                                     "NOT", "FOR", "VAR", "XOR", "REF", "TASK", "SWITCH"};
        return kWords.contains(upper);
    }

    void emit(const std::string& text) {
        if (characters_) {
            word_ += text;
        } else {
            tokens.push_back(text);
        }
    }

    const Grammar& grammar_;
    std::mt19937& random_;
    bool characters_ = false;
    std::string word_;
};

bool isWordByte(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) || c == '_' || c == '.' ||
           static_cast<unsigned char>(c) >= 0x80;
}

/// Must something stand between two tokens?
bool mustSeparate(const std::string& a, const std::string& b) {
    const char last = a.back(), first = b.front();
    if (isWordByte(last) && isWordByte(first)) return true;
    const std::string joined{last, first};
    static const std::set<std::string> kPairs = {":=", "<=", ">=", "<>", "\"\""};
    // A '<' before a name could begin a placeholder.
    return kPairs.contains(joined) || (last == '<' && isWordByte(first));
}

std::string randomCase(const std::string& token, std::mt19937& random) {
    if (!std::isupper(static_cast<unsigned char>(token[0]))) return token;
    std::string result = token;
    const uint32_t mode = random() % 4;
    for (char& c : result)
        if (mode == 0 || (mode == 1 && random() % 2))
            c = static_cast<char>(std::tolower(static_cast<unsigned char>(c)));
    return result;
}

} // namespace

Grammar readGrammar(std::string_view text) {
    Grammar grammar = Reader(text).read();
    computeDepths(grammar);
    return grammar;
}

std::vector<std::string> deriveSentence(const Grammar& grammar, const std::string& start, uint32_t depth,
                                        std::mt19937& random) {
    Deriver deriver(grammar, random);
    Part part;
    part.kind = Kind::Rule;
    part.text = start;
    deriver.derive(part, depth);
    return std::move(deriver.tokens);
}

std::string layOut(const std::vector<std::string>& tokens, std::mt19937& random) {
    static const std::set<std::string> kReserved = {"ENDMODULE", "ENDPROC", "ENDFUNC",  "ENDTRAP",
                                                    "ENDIF",     "ENDFOR",  "ENDWHILE", "ENDTEST",
                                                    "ENDRECORD", "THEN",    "DO",       "ELSE"};
    std::string out;
    for (size_t i = 0; i < tokens.size(); ++i) {
        out += randomCase(tokens[i], random);
        if (i + 1 == tokens.size()) break;
        const uint32_t choice = random() % 100;
        if (tokens[i] == ";" || kReserved.contains(tokens[i])) {
            out += choice < 10 ? " ! comment, ; \"text\nx" : choice < 20 ? "\r\n" : "\n";
            if (choice < 10) out.back() = '\n';
        } else if (choice < 5) {
            out += "\n        "; // the rest of an instruction is indented
        } else if (choice < 8) {
            out += " ! 中 comment\n        \t";
        } else if (choice < 50 || mustSeparate(tokens[i], tokens[i + 1])) {
            out += choice % 7 == 0 ? "\t " : " ";
        }
    }
    return out + "\n";
}

} // namespace rapid::test

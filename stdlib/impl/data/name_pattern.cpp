#include "stdlib/impl/data/name_pattern.h"

#include "config/letter_case.h"

#include <algorithm>

namespace rt::lib {
namespace {

constexpr std::size_t kLongest = 63; // positions in a name are bits of a word
constexpr int kDeepest = 40;         // nesting of parentheses; a pattern has at most 80 characters

unsigned char fold(char c) {
    return static_cast<unsigned char>(rapid::config::lowerLetter(c)); // patterns are matched byte by byte
}

} // namespace

class NamePattern::Reader {
  public:
    Reader(std::string_view text, std::vector<Node>& nodes) : text_(text), nodes_(nodes) {}

    bool whole(uint32_t& root) { return choice(root, 0) && at_ == text_.size(); }

  private:
    bool more() const { return at_ < text_.size(); }
    bool next(char c) const { return more() && text_[at_] == c; }
    uint32_t add(Node node) {
        nodes_.push_back(std::move(node));
        return static_cast<uint32_t>(nodes_.size() - 1);
    }

    bool choice(uint32_t& result, int depth) {
        Node node;
        node.kind = Kind::Choice;
        uint32_t part = 0;
        do {
            if (!sequence(part, depth)) return false;
            node.parts.push_back(part);
        } while (next('|') && ++at_ > 0);
        result = add(std::move(node));
        return true;
    }

    bool sequence(uint32_t& result, int depth) {
        Node node;
        while (more() && !next('|') && !next(')')) {
            uint32_t part = 0;
            if (!atom(part, depth)) return false;
            while (next('*') || next('+') || next('?')) {
                Node repeat;
                repeat.kind = Kind::Repeat;
                repeat.least1 = next('+');
                repeat.once = next('?');
                repeat.parts.push_back(part);
                part = add(std::move(repeat));
                ++at_;
            }
            node.parts.push_back(part);
        }
        result = add(std::move(node));
        return true;
    }

    bool atom(uint32_t& result, int depth) {
        const char c = text_[at_++];
        if (c == '*' || c == '+' || c == '?' || c == ']') return false; // nothing to repeat
        if (c == '(') {
            if (depth >= kDeepest || !choice(result, depth + 1) || !next(')')) return false;
            ++at_;
            return true;
        }
        Node node;
        node.kind = Kind::Set;
        if (c == '.') {
            std::fill(std::begin(node.any), std::end(node.any), true);
        } else if (c == '[') {
            if (!set(node)) return false;
        } else if (c == '\\') {
            if (!more()) return false;
            node.any[fold(text_[at_++])] = true;
        } else {
            node.any[fold(c)] = true;
        }
        result = add(std::move(node));
        return true;
    }

    bool set(Node& node) {
        const bool without = next('^');
        if (without) ++at_;
        bool empty = true;
        while (more() && !next(']')) {
            const unsigned char first = fold(text_[at_++]);
            unsigned char last = first;
            if (next('-') && at_ + 1 < text_.size() && text_[at_ + 1] != ']') {
                last = fold(text_[at_ + 1]);
                at_ += 2;
            }
            if (last < first) return false;
            std::fill(node.any + first, node.any + last + 1, true);
            empty = false;
        }
        if (!more() || empty) return false;
        ++at_;
        if (without)
            for (bool& any : node.any)
                any = !any;
        return true;
    }

    std::string_view text_;
    std::size_t at_ = 0;
    std::vector<Node>& nodes_;
};

bool NamePattern::parse(std::string_view text) {
    nodes_.clear();
    everything_ = false;
    if (Reader(text, nodes_).whole(root_)) return true;
    nodes_.clear();
    return false;
}

bool NamePattern::matches(std::string_view name) const {
    if (everything_) return true;
    if (nodes_.empty() || name.size() > kLongest) return false;
    return (step(root_, 1, name) >> name.size() & 1) != 0;
}

/// From each of a set of positions in the name to all positions where the node can end.
uint64_t NamePattern::step(uint32_t number, uint64_t from, std::string_view name) const {
    const Node& node = nodes_[number];
    uint64_t to = 0;
    switch (node.kind) {
    case Kind::Set:
        for (std::size_t i = 0; i < name.size(); ++i)
            if ((from >> i & 1) != 0 && node.any[fold(name[i])]) to |= uint64_t{2} << i;
        return to;
    case Kind::Sequence:
        to = from;
        for (const uint32_t part : node.parts)
            to = to == 0 ? 0 : step(part, to, name);
        return to;
    case Kind::Choice:
        for (const uint32_t part : node.parts)
            to |= step(part, from, name);
        return to;
    case Kind::Repeat:
        to = step(node.parts[0], from, name);
        for (uint64_t before = 0; !node.once && to != before;) {
            before = to;
            to |= step(node.parts[0], to, name);
        }
        return node.least1 ? to : to | from;
    }
    return 0;
}

} // namespace rt::lib

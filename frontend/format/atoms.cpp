#include "frontend/format/atoms.h"

#include <algorithm>

namespace rapid::format {

namespace {

class Collector {
  public:
    Collector(const syntax::SyntaxTree& tree, uint32_t tabWidth)
        : tree_(tree), text_(tree.source->text()), tabWidth_(tabWidth) {}

    std::vector<Atom> run() {
        atoms_.reserve(tree_.tokens.size() + tree_.tokens.size() / 8);
        for (syntax::TokenIndex t = 0; t < tree_.tokens.size(); ++t) {
            const syntax::Token& token = tree_.tokens[t];
            readGap(t, token.offset);
            add({.begin = token.offset, .end = token.offset + token.length, .token = t});
        }
        return std::move(atoms_);
    }

  private:
    void add(Atom atom) {
        atom.newlines = newlines_;
        atom.column = column_;
        const std::string_view text = text_.substr(atom.begin, atom.end - atom.begin);
        const size_t lastLine = text.find_last_of("\r\n"); // only a file header has several lines
        column_ = lastLine == std::string_view::npos ? column_ + displayWidth(text)
                                                     : displayWidth(text.substr(lastLine + 1));
        atom.endColumn = column_;
        newlines_ = 0;
        at_ = atom.end;
        atoms_.push_back(atom);
    }

    /// Comments and line ends between the atom before and the token that begins at `end`.
    void readGap(syntax::TokenIndex next, uint32_t end) {
        while (at_ < end) {
            const char c = text_[at_];
            if (c == '!') {
                readComment(next, end);
            } else if (c == '\n' || c == '\r') {
                if (c == '\r' && at_ + 1 < end && text_[at_ + 1] == '\n') ++at_;
                ++newlines_, ++at_;
                column_ = 0;
            } else {
                column_ = c == '\t' ? (column_ / tabWidth_ + 1) * tabWidth_ : column_ + 1;
                ++at_;
            }
        }
    }

    void readComment(syntax::TokenIndex next, uint32_t gapEnd) {
        const uint32_t begin = at_;
        uint32_t end = begin;
        while (end < gapEnd && text_[end] != '\n' && text_[end] != '\r')
            ++end;
        const uint32_t lineEnd = end;
        while (text_[end - 1] == ' ' || text_[end - 1] == '\t' || text_[end - 1] == '\f')
            --end;
        add({.begin = begin, .end = end, .token = next, .isComment = true});
        at_ = lineEnd;
    }

    const syntax::SyntaxTree& tree_;
    std::string_view text_;
    uint32_t tabWidth_;
    std::vector<Atom> atoms_;
    uint32_t at_ = 0;
    uint32_t column_ = 0;
    uint32_t newlines_ = 0;
};

} // namespace

uint32_t displayWidth(std::string_view text) {
    return static_cast<uint32_t>(std::count_if(
        text.begin(), text.end(), [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; }));
}

std::vector<Atom> collectAtoms(const syntax::SyntaxTree& tree, uint32_t tabWidth) {
    return Collector(tree, tabWidth).run();
}

} // namespace rapid::format

#include "tools/lsp/block_ends.h"

#include "config/text_util.h"

#include <array>
#include <cctype>
#include <string>
#include <string_view>

namespace lsp {

using rapid::SourceFile;
using rapid::TextEdit;

namespace {

struct Block {
    std::string_view begin, end;
    bool inRoutine; ///< else it is counted in the whole file
};

constexpr std::array<Block, 9> kBlocks = {{{"MODULE", "ENDMODULE", false},
                                           {"RECORD", "ENDRECORD", false},
                                           {"PROC", "ENDPROC", false},
                                           {"FUNC", "ENDFUNC", false},
                                           {"TRAP", "ENDTRAP", false},
                                           {"IF", "ENDIF", true},
                                           {"FOR", "ENDFOR", true},
                                           {"WHILE", "ENDWHILE", true},
                                           {"TEST", "ENDTEST", true}}};

/// The words of a line in upper case, without strings and comment.
std::vector<std::string> wordsOf(std::string_view line) {
    std::vector<std::string> words;
    for (size_t i = 0; i < line.size();) {
        if (line[i] == '!') break;
        if (line[i] == '"') {
            i = std::min(line.find('"', i + 1), line.size() - 1) + 1;
            continue;
        }
        size_t end = i;
        while (end < line.size() &&
               (std::isalnum(static_cast<unsigned char>(line[end])) != 0 || line[end] == '_'))
            ++end;
        if (end == i)
            ++i;
        else
            words.push_back(rapid::config::upperCase(line.substr(i, end - i)));
        i = std::max(i, end);
    }
    return words;
}

bool is(const std::string& word, std::string_view a, std::string_view b) {
    return word == a || word == b;
}

/// The block that a line begins; null if none.
const Block* begunBy(const std::vector<std::string>& words) {
    size_t first = 0;
    while (first < words.size() && is(words[first], "LOCAL", "TASK"))
        ++first;
    if (first >= words.size()) return nullptr;
    for (const Block& block : kBlocks) {
        if (words[first] != block.begin) continue;
        if (block.begin == "IF" && words.back() != "THEN") return nullptr; // compact, or continued
        if ((block.begin == "FOR" || block.begin == "WHILE") && words.back() != "DO") return nullptr;
        return words.size() > first + 1 ? &block : nullptr;
    }
    return nullptr;
}

bool isBorder(const std::vector<std::string>& words) {
    if (words.empty()) return false;
    const Block* begun = begunBy(words);
    return words[0] == "ENDPROC" || words[0] == "ENDFUNC" || words[0] == "ENDTRAP" ||
           words[0] == "ENDMODULE" || (begun && !begun->inRoutine);
}

/// Whether there are more beginnings than ends of such a block, in the routine around the line or in the file.
bool lacksEnd(const SourceFile& file, uint32_t line, const Block& block) {
    uint32_t first = 1, last = file.lineCount();
    if (block.inRoutine) {
        for (first = line; first > 1 && !isBorder(wordsOf(file.lineText(first))); --first) {
        }
        for (last = line + 1; last < file.lineCount() && !isBorder(wordsOf(file.lineText(last))); ++last) {
        }
    }
    int open = 0;
    for (uint32_t i = first; i <= last; ++i) {
        const auto words = wordsOf(file.lineText(i));
        if (words.empty()) continue;
        const Block* begun = begunBy(words);
        if (begun && begun->begin == block.begin) ++open;
        if (words[0] == block.end) --open;
    }
    return open > 0;
}

std::string indentOf(std::string_view line) {
    return std::string(line.substr(0, std::min(line.find_first_not_of(" \t"), line.size())));
}

/// By how much a line (from 1) is moved in from the one around it; `otherwise` when none is.
std::string stepOf(const SourceFile& file, uint32_t line, const std::string& otherwise) {
    constexpr uint32_t kFar = 1000; // lines
    const std::string own = indentOf(file.lineText(line));
    for (uint32_t above = line - 1; above > 0 && line - above < kFar; --above) {
        const std::string_view text = file.lineText(above);
        const std::string outer = indentOf(text);
        if (outer.size() == text.size() || outer.size() >= own.size() || !own.starts_with(outer)) continue;
        return own.substr(outer.size());
    }
    return otherwise;
}

} // namespace

std::optional<std::vector<TextEdit>> endOfBlock(const SourceFile& file, uint32_t line,
                                                const std::string& step) {
    if (line == 0 || line >= file.lineCount()) return {};
    const std::string_view above = file.lineText(line), here = file.lineText(line + 1);
    const Block* block = begunBy(wordsOf(above));
    if (!block || !rapid::config::trimmed(here).empty() || !lacksEnd(file, line, *block)) return {};
    const std::string indent = indentOf(above), inside = indent + stepOf(file, line, step);
    const uint32_t start = file.lineStart(line + 1), end = start + static_cast<uint32_t>(here.size());
    const std::string lineEnd = file.text().find("\r\n") == std::string_view::npos ? "\n" : "\r\n";
    std::vector<TextEdit> edits;
    if (here != inside) edits.push_back({{start, end}, inside});
    // On a line of its own below, so that the cursor stays where it is.
    if (line + 1 < file.lineCount()) {
        const uint32_t next = file.lineStart(line + 2);
        edits.push_back({{next, next}, indent + std::string(block->end) + lineEnd});
    } else {
        edits.push_back({{end, end}, lineEnd + indent + std::string(block->end)});
    }
    return edits;
}

} // namespace lsp

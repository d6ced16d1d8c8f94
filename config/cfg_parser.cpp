#include "config/cfg_parser.h"

#include "config/read_file.h"
#include "config/text_util.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <map>

namespace rapid::config {
namespace {

bool isLetter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}
bool isWordChar(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}
bool isBlank(char c) {
    return c == ' ' || c == '\t';
}

/// "one mistake", "99,950 mistakes"
std::string counted(std::size_t count) {
    std::string digits = std::to_string(count);
    for (std::size_t at = digits.size(); at > 3; at -= 3)
        digits.insert(at - 3, ",");
    return count == 1 ? "one more mistake" : digits + " more mistakes";
}

CfgProblem remainder(const std::string& file, uint32_t line, std::size_t count) {
    const std::string message = fmt::format("there {} {} in this file; correct those above first",
                                            count == 1 ? "is" : "are", counted(count));
    return {file, line, message, false, count};
}

class CfgReader {
  public:
    CfgReader(std::string_view text, CfgFile& file, std::vector<CfgProblem>& problems)
        : text_(text), file_(file), problems_(problems) {}

    void run() {
        readHeader();
        std::string_view line;
        while (nextLine(line))
            readLine(line);
        if (count_ > kMaxCfgProblems)
            problems_.push_back(remainder(file_.name, line_, count_ - kMaxCfgProblems));
    }

  private:
    void problem(uint32_t line, std::string message) {
        if (++count_ <= kMaxCfgProblems) problems_.push_back({file_.name, line, std::move(message)});
    }

    /// The part of a line that a message shows.
    static std::string_view shown(std::string_view text) {
        constexpr std::size_t kShown = 60;
        if (text.size() <= kShown) return text;
        std::size_t cut = kShown;
        while (cut > 0 && (static_cast<unsigned char>(text[cut]) & 0xC0u) == 0x80u)
            --cut;
        return text.substr(0, cut);
    }

    /// LF, CRLF and lone CR end a line: all three occur, mixed, in real files.
    bool nextLine(std::string_view& line) {
        if (at_ >= text_.size()) return false;
        const std::size_t end = text_.find_first_of("\r\n", at_);
        line = text_.substr(at_, end == std::string_view::npos ? end : end - at_);
        at_ = end == std::string_view::npos ? text_.size() : end + 1;
        if (end != std::string_view::npos && text_[end] == '\r' && at_ < text_.size() && text_[at_] == '\n')
            ++at_;
        ++line_;
        return true;
    }

    void readHeader() {
        std::string_view line;
        while (nextLine(line)) {
            const std::string_view header = trimmed(line);
            if (header.empty()) continue;
            const std::size_t colon = header.find(':');
            if (colon == 0 || colon == std::string_view::npos || header.find("CFG", colon) != colon + 1) {
                problem(line_, "the first line is not a configuration header; expected something like "
                               "'EIO:CFG_1.0:7:0::'");
                at_ = text_.size();
                return;
            }
            file_.domain = upperCase(header.substr(0, colon));
            file_.version = std::string(header.substr(colon + 1));
            return;
        }
        problem(1, "the file is empty");
    }

    void readLine(std::string_view line) {
        const std::string_view text = trimmed(line);
        if (text.empty()) return;
        if (text.front() == '#') { // alone: the section ends; otherwise a comment
            if (text.size() == 1) section_ = nullptr;
            return;
        }
        if (text.front() == '-') return readInstance(line);
        if (text.back() == ':') return openSection(text.substr(0, text.size() - 1));
        problem(line_,
                fmt::format("cannot read '{}'; expected '#', 'TYPE:' or '-Attribute value'", shown(text)));
    }

    void openSection(std::string_view text) {
        CfgSection section;
        section.line = line_;
        const std::size_t equals = text.find('=');
        section.type = std::string(trimmed(text.substr(0, equals)));
        if (equals != std::string_view::npos)
            section.baseType = std::string(trimmed(text.substr(equals + 1)));
        if (section.type.empty())
            return problem(line_, "':' without the name of a configuration type before it");
        for (const char c : section.type) {
            if (!isWordChar(c)) {
                return problem(
                    line_, fmt::format("'{}' is not the name of a configuration type", shown(section.type)));
            }
        }
        file_.sections.push_back(std::move(section));
        section_ = &file_.sections.back();
    }

    /// One instance: this line and those it is continued on by a backslash at the end.
    void readInstance(std::string_view line) {
        if (section_ == nullptr) {
            problem(line_, "attributes outside of a section; a line 'TYPE:' must come first");
            section_ = &ignored_;
        }
        CfgInstance instance;
        instance.line = line_;
        for (bool more = true; more;) {
            std::string_view part = trimmed(line);
            more = !part.empty() && part.back() == '\\';
            if (more) part.remove_suffix(1);
            readAttributes(part, instance);
            if (more && !nextLine(line)) {
                problem(line_, "the file ends after a continuation mark '\\'");
                more = false;
            }
        }
        section_->instances.push_back(std::move(instance));
    }

    void readAttributes(std::string_view text, CfgInstance& instance) {
        std::size_t i = 0;
        const auto skipBlanks = [&] {
            while (i < text.size() && isBlank(text[i]))
                ++i;
        };
        for (skipBlanks(); i < text.size(); skipBlanks()) {
            // A minus sign begins an attribute only before a letter; values may be negative.
            if (text[i] == '-' && i + 1 < text.size() && isLetter(text[i + 1])) {
                const std::size_t begin = ++i;
                while (i < text.size() && isWordChar(text[i]))
                    ++i;
                instance.attributes.push_back({std::string(text.substr(begin, i - begin)), {}, false, line_});
            } else if (instance.attributes.empty()) {
                problem(line_, fmt::format("expected '-Attribute' before '{}'", shown(text.substr(i))));
                return;
            } else if (!readValue(text, i, instance.attributes.back())) {
                return;
            }
        }
    }

    bool readValue(std::string_view text, std::size_t& i, CfgAttribute& attribute) {
        if (text[i] == '"') {
            const std::size_t close = text.find('"', i + 1);
            if (close == std::string_view::npos) {
                problem(line_, fmt::format("the text of attribute {} has no closing quotation mark",
                                           attribute.name));
                return false;
            }
            attribute.values.emplace_back(text.substr(i + 1, close - i - 1));
            attribute.quoted = true;
            i = close + 1;
            if (i < text.size() && text[i] == ',') ++i;
            return true;
        }
        const std::size_t begin = i;
        while (i < text.size() && !isBlank(text[i]) && text[i] != ',')
            ++i;
        attribute.values.emplace_back(text.substr(begin, i - begin));
        if (i < text.size() && text[i] == ',') ++i;
        return true;
    }

    std::string_view text_;
    CfgFile& file_;
    std::vector<CfgProblem>& problems_;
    std::size_t at_ = 0;
    std::size_t count_ = 0; ///< of problems
    uint32_t line_ = 0;
    CfgSection* section_ = nullptr;
    CfgSection ignored_;
};

} // namespace

const std::string& CfgAttribute::text() const {
    static const std::string empty;
    return values.empty() ? empty : values.front();
}

const CfgAttribute* CfgInstance::find(std::string_view name) const {
    for (const CfgAttribute& attribute : attributes) {
        if (sameName(attribute.name, name)) return &attribute;
    }
    return nullptr;
}

std::string CfgInstance::text(std::string_view name, std::string_view fallback) const {
    const CfgAttribute* attribute = find(name);
    return attribute != nullptr && !attribute->values.empty() ? attribute->text() : std::string(fallback);
}

bool CfgInstance::flag(std::string_view name) const {
    const CfgAttribute* attribute = find(name);
    if (attribute == nullptr) return false;
    if (attribute->values.empty()) return true;
    const std::string value = upperCase(attribute->text());
    return value != "FALSE" && value != "NO" && value != "0";
}

bool CfgInstance::number(std::string_view name, double& value) const {
    const CfgAttribute* attribute = find(name);
    return attribute != nullptr && parseNumber(attribute->text(), value);
}

std::vector<const CfgSection*> CfgFile::find(std::string_view type) const {
    std::vector<const CfgSection*> found;
    for (const CfgSection& section : sections) {
        if (sameName(section.type, type) || sameName(section.baseType, type)) found.push_back(&section);
    }
    return found;
}

std::string CfgProblem::text() const {
    return line == 0 ? fmt::format("{}: {}", file, message) : fmt::format("{}:{}: {}", file, line, message);
}

void limitProblems(std::vector<CfgProblem>& problems) {
    struct Rest {
        std::size_t shown = 0, hidden = 0;
        uint32_t line = 0;
        bool warning = true;
    };
    std::map<std::string, Rest> rests;
    std::vector<CfgProblem> kept;
    for (CfgProblem& problem : problems) {
        Rest& rest = rests[problem.file];
        rest.line = std::max(rest.line, problem.line);
        if (problem.more == 0 && rest.shown < kMaxCfgProblems) {
            ++rest.shown;
            kept.push_back(std::move(problem));
            continue;
        }
        rest.hidden += std::max<std::size_t>(problem.more, 1);
        rest.warning = rest.warning && problem.warning;
    }
    for (const auto& [file, rest] : rests) {
        if (rest.hidden == 0) continue;
        kept.push_back(remainder(file, rest.line, rest.hidden));
        kept.back().warning = rest.warning;
    }
    problems = std::move(kept);
}

CfgFile parseCfg(std::string_view text, std::string name, std::vector<CfgProblem>& problems) {
    CfgFile file;
    file.name = std::move(name);
    const std::string utf8 = toUtf8(text);
    CfgReader(utf8, file, problems).run();
    return file;
}

CfgFile readCfg(const std::string& path, std::vector<CfgProblem>& problems) {
    std::string text;
    if (std::string error = readFile(path, text); !error.empty()) {
        problems.push_back({path, 0, fmt::format("cannot be read: {}", error)});
        CfgFile file;
        file.name = path;
        return file;
    }
    return parseCfg(text, path, problems);
}

} // namespace rapid::config

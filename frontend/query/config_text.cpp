#include "frontend/query/config_text.h"

#include "frontend/sema/names.h"

namespace rapid::query {

namespace {

bool isBlank(char c) {
    return c == ' ' || c == '\t';
}
bool isWordChar(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
}
bool isLetter(char c) {
    return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z');
}

class Reader {
  public:
    explicit Reader(std::string_view text) : text_(text) {}

    ConfigText read() {
        while (at_ < text_.size())
            readLine();
        if (!out_.sections.empty()) out_.sections.back().end = static_cast<uint32_t>(text_.size());
        return std::move(out_);
    }

  private:
    /// The line at `at_`, which moves to the next one: begin and end without blanks around it.
    SourceRange nextLine() {
        size_t end = text_.find_first_of("\r\n", at_);
        if (end == std::string_view::npos) end = text_.size();
        size_t begin = at_;
        at_ = end < text_.size() ? end + 1 : end;
        if (end < text_.size() && text_[end] == '\r' && at_ < text_.size() && text_[at_] == '\n') ++at_;
        while (begin < end && isBlank(text_[begin]))
            ++begin;
        while (end > begin && isBlank(text_[end - 1]))
            --end;
        return {static_cast<uint32_t>(begin), static_cast<uint32_t>(end)};
    }

    void readLine() {
        const SourceRange line = nextLine();
        if (line.begin == line.end) return;
        const std::string_view text = text_.substr(line.begin, line.end - line.begin);
        if (out_.domain.empty() && out_.sections.empty() && text.find(":CFG") != std::string_view::npos) {
            out_.domain = std::string(text.substr(0, text.find(':')));
        } else if (text.front() == '#') {
            if (text.size() == 1) open_ = false;
        } else if (text.front() == '-') {
            readInstance(line);
        } else if (text.back() == ':') {
            if (!out_.sections.empty()) out_.sections.back().end = line.begin;
            const std::string_view type = text.substr(0, text.find_first_of("=: \t"));
            out_.sections.push_back({std::string(type),
                                     {line.begin, line.begin + static_cast<uint32_t>(type.size())},
                                     line.end,
                                     {}});
            open_ = true;
        }
    }

    void readInstance(SourceRange line) {
        ConfigInstance instance;
        instance.range = line;
        while (true) {
            const bool more = line.end > line.begin && text_[line.end - 1] == '\\';
            readAttributes(line.begin, more ? line.end - 1 : line.end, instance);
            instance.range.end = line.end;
            if (!more || at_ >= text_.size()) break;
            line = nextLine();
        }
        if (open_ && !out_.sections.empty()) out_.sections.back().instances.push_back(std::move(instance));
    }

    void readAttributes(uint32_t i, uint32_t end, ConfigInstance& instance) {
        while (i < end) {
            if (isBlank(text_[i]) || text_[i] == ',') {
                ++i;
            } else if (text_[i] == '-' && i + 1 < end && isLetter(text_[i + 1])) {
                const uint32_t begin = ++i;
                while (i < end && isWordChar(text_[i]))
                    ++i;
                instance.attributes.push_back(
                    {std::string(text_.substr(begin, i - begin)), {begin, i}, {}, {i, i}});
            } else {
                i = readValue(i, end, instance);
            }
        }
    }

    uint32_t readValue(uint32_t i, uint32_t end, ConfigInstance& instance) {
        const bool quoted = text_[i] == '"';
        const uint32_t begin = quoted ? i + 1 : i;
        i = begin;
        while (i < end && (quoted ? text_[i] != '"' : !isBlank(text_[i]) && text_[i] != ','))
            ++i;
        if (!instance.attributes.empty()) {
            ConfigAttribute& attribute = instance.attributes.back();
            if (attribute.valueRange.begin == attribute.valueRange.end) {
                attribute.value = std::string(text_.substr(begin, i - begin));
                attribute.valueRange = {begin, i};
            }
        }
        return quoted && i < end ? i + 1 : i > begin ? i : i + 1;
    }

    std::string_view text_;
    ConfigText out_;
    size_t at_ = 0;
    bool open_ = false;
};

} // namespace

const ConfigAttribute* ConfigInstance::find(std::string_view name) const {
    const std::string folded = sema::foldName(name);
    for (const ConfigAttribute& attribute : attributes)
        if (sema::foldName(attribute.name) == folded) return &attribute;
    return nullptr;
}

std::string ConfigInstance::text(std::string_view name) const {
    const ConfigAttribute* attribute = find(name);
    return attribute ? attribute->value : "";
}

ConfigText readConfigText(std::string_view text) {
    return Reader(text).read();
}

SignalDefinition findSignal(std::span<const std::shared_ptr<const SourceFile>> configuration,
                            std::string_view name) {
    const std::string folded = sema::foldName(name);
    for (const auto& file : configuration) {
        if (!file) continue;
        for (const ConfigSection& section : readConfigText(file->text()).sections) {
            if (section.type != "EIO_SIGNAL") continue;
            for (const ConfigInstance& instance : section.instances) {
                const ConfigAttribute* attribute = instance.find("Name");
                if (attribute && sema::foldName(attribute->value) == folded)
                    return {file, instance, attribute->valueRange};
            }
        }
    }
    return {};
}

} // namespace rapid::query

#include "frontend/project/backinfo.h"

#include "config/text_util.h"

#include <algorithm>
#include <cctype>

namespace rapid::project {

namespace {

using config::sameName;
using config::trimmed;

/// Lines without their ends; LF, CRLF and lone CR end one.
template <class F> void forEachLine(std::string_view text, F&& visit) {
    while (!text.empty()) {
        const size_t end = text.find_first_of("\r\n");
        visit(text.substr(0, end));
        if (end == std::string_view::npos) return;
        text.remove_prefix(end + 1);
    }
}

bool startsWithNoCase(std::string_view text, std::string_view prefix) {
    return text.size() >= prefix.size() && sameName(text.substr(0, prefix.size()), prefix);
}

/// `>>TASK1: (T_ROB1,ProgramName,)`
bool readTask(std::string_view line, ListedTask& task) {
    const size_t colon = line.find(':');
    if (colon == std::string_view::npos) return false;
    task.folder = std::string(trimmed(line.substr(2, colon - 2)));
    std::string_view rest = trimmed(line.substr(colon + 1));
    if (rest.starts_with('(')) rest.remove_prefix(1);
    if (const size_t close = rest.find(')'); close != std::string_view::npos) rest = rest.substr(0, close);
    const size_t comma = rest.find(',');
    task.name = std::string(trimmed(rest.substr(0, comma)));
    if (comma != std::string_view::npos) {
        rest.remove_prefix(comma + 1);
        task.program = std::string(trimmed(rest.substr(0, rest.find(','))));
    }
    return !task.folder.empty() && !task.name.empty();
}

/// `PROGMOD/main.mod @ main.mod`; the text after '@' repeats the name in lower case, or says HIDDEN.
bool readModule(std::string_view line, ListedModule& module) {
    const size_t mark = line.find('@');
    std::string path(trimmed(line.substr(0, mark)));
    module.hidden = mark != std::string_view::npos && trimmed(line.substr(mark + 1)).ends_with("HIDDEN");
    std::replace(path.begin(), path.end(), '\\', '/');
    const size_t slash = path.rfind('/');
    if (slash == std::string::npos || slash + 1 == path.size()) return false;
    module.folder = path.substr(0, slash);
    module.file = path.substr(slash + 1);
    return true;
}

class InfoReader {
  public:
    explicit InfoReader(BackupInfo& out) : out_(out) {}

    void readLine(std::string_view line) {
        const std::string_view text = trimmed(line);
        if (text.starts_with('#') || text.empty()) return;
        if (text.starts_with(">>")) return openSection(text);
        if (section_ == Section::System && out_.systemId.empty()) {
            out_.systemId = std::string(text);
        } else if (section_ == Section::Products) {
            readProduct(line, text);
        } else if (section_ == Section::Task) {
            ListedModule module;
            if (readModule(text, module)) out_.tasks.back().modules.push_back(std::move(module));
        }
    }

  private:
    enum class Section { Other, System, Products, Task };

    void openSection(std::string_view text) {
        section_ = Section::Other;
        const bool isTask = startsWithNoCase(text, ">>TASK") && text.size() > 6 &&
                            std::isdigit(static_cast<unsigned char>(text[6])) != 0;
        if (startsWithNoCase(text, ">>SYSTEM_ID:")) {
            section_ = Section::System;
        } else if (startsWithNoCase(text, ">>PRODUCTS_ID:")) {
            section_ = Section::Products;
        } else if (ListedTask task; isTask && readTask(text, task)) {
            out_.tasks.push_back(std::move(task));
            section_ = Section::Task;
        }
    }

    /// "Name Version: 1.2" at the margin is a product, an indented line is an option.
    void readProduct(std::string_view line, std::string_view text) {
        constexpr std::string_view kVersion = " Version:";
        const size_t at = text.find(kVersion);
        if (at == std::string_view::npos) {
            if (line.starts_with(' ') || line.starts_with('\t')) out_.options.emplace_back(text);
            return;
        }
        const std::string_view name = trimmed(text.substr(0, at));
        const std::string_view version = trimmed(text.substr(at + kVersion.size()));
        if (sameName(name, "RobotWare") || sameName(name, "RobotControl")) // RobotWare 7 has two parts
            out_.robotWare = std::string(version);
        else if (!sameName(name, "RobotOS"))
            out_.addIns.push_back(std::string(name) + " " + std::string(version));
    }

    BackupInfo& out_;
    Section section_ = Section::Other;
};

} // namespace

BackupInfo readBackupInfo(std::string_view text) {
    BackupInfo info;
    InfoReader reader(info);
    const std::string utf8 = config::toUtf8(text);
    forEachLine(utf8, [&](std::string_view line) { reader.readLine(line); });
    return info;
}

} // namespace rapid::project

#include "frontend/project/program_file.h"

#include <algorithm>
#include <cctype>

namespace rapid::project {

namespace {

std::string lower(std::string_view text) {
    std::string out(text);
    std::transform(out.begin(), out.end(), out.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return out;
}

std::string_view trim(std::string_view s) {
    const char* blank = " \t\r\n";
    const size_t begin = s.find_first_not_of(blank);
    if (begin == std::string_view::npos) return {};
    return s.substr(begin, s.find_last_not_of(blank) - begin + 1);
}

std::string decodeEntities(std::string_view text) {
    static constexpr std::pair<std::string_view, char> kEntities[] = {
        {"&amp;", '&'}, {"&lt;", '<'}, {"&gt;", '>'}, {"&quot;", '"'}, {"&apos;", '\''}};
    std::string out;
    while (!text.empty()) {
        const auto* hit = std::find_if(std::begin(kEntities), std::end(kEntities),
                                       [&](const auto& entity) { return text.starts_with(entity.first); });
        const bool found = hit != std::end(kEntities);
        out += found ? hit->second : text.front();
        text.remove_prefix(found ? hit->first.size() : 1);
    }
    return out;
}

template <class F> void forEachLine(std::string_view text, F&& visit) {
    while (!text.empty()) {
        const size_t end = text.find('\n');
        visit(trim(text.substr(0, end)));
        if (end == std::string_view::npos) return;
        text.remove_prefix(end + 1);
    }
}

/// Value of `-Name` in an instance: quoted or bare; empty if absent.
std::string attribute(std::string_view instance, std::string_view name) {
    const std::string folded = lower(instance);
    const std::string key = "-" + lower(name);
    for (size_t at = folded.find(key); at != std::string::npos; at = folded.find(key, at + 1)) {
        const size_t end = at + key.size();
        if ((at > 0 && folded[at - 1] != ' ') || (end < folded.size() && folded[end] != ' ')) continue;
        std::string_view value = trim(instance.substr(std::min(end, instance.size())));
        if (value.starts_with('"')) return std::string(value.substr(1, value.find('"', 1) - 1));
        return std::string(value.substr(0, value.find(' ')));
    }
    return {};
}

} // namespace

bool readProgramFile(std::string_view text, std::vector<std::string>& modules) {
    const std::string folded = lower(text);
    if (folded.find("<program") == std::string::npos) return false;
    size_t at = 0;
    while ((at = folded.find("<module", at)) != std::string::npos) {
        const size_t begin = folded.find('>', at);
        const size_t end = folded.find("</module", at);
        if (begin == std::string::npos || end == std::string::npos || begin > end) return false;
        std::string name = decodeEntities(trim(text.substr(begin + 1, end - begin - 1)));
        std::replace(name.begin(), name.end(), '\\', '/');
        if (!name.empty()) modules.push_back(std::move(name));
        at = end;
    }
    return true;
}

std::vector<BackupTask> readBackupTasks(std::string_view backinfo) {
    std::vector<BackupTask> tasks;
    forEachLine(backinfo, [&](std::string_view line) {
        if (!line.starts_with(">>TASK")) return;
        const size_t colon = line.find(':'), open = line.find('('), comma = line.find_first_of(",)", open);
        if (colon == std::string_view::npos || open == std::string_view::npos ||
            comma == std::string_view::npos)
            return;
        tasks.push_back({std::string(trim(line.substr(2, colon - 2))),
                         std::string(trim(line.substr(open + 1, comma - open - 1)))});
    });
    return tasks;
}

std::vector<ConfiguredTask> readConfiguredTasks(std::string_view text) {
    std::vector<ConfiguredTask> tasks;
    bool inside = false;
    std::string instance; // its lines joined; a line that ends in '\' goes on
    const auto finish = [&] {
        const std::string name = attribute(instance, "Name");
        if (inside && !name.empty()) {
            ConfiguredTask task;
            task.name = name;
            if (const std::string type = attribute(instance, "Type"); !type.empty()) task.type = type;
            if (const std::string entry = attribute(instance, "Entry"); !entry.empty()) task.entry = entry;
            tasks.push_back(std::move(task));
        }
        instance.clear();
    };
    forEachLine(text, [&](std::string_view line) {
        if (line == "#") {
            finish();
            inside = false;
        } else if (line.ends_with(':') && !line.starts_with('-')) {
            finish();
            inside = line == "CAB_TASKS:";
        } else if (line.empty()) {
            finish();
        } else {
            instance += line.ends_with('\\') ? line.substr(0, line.size() - 1) : line;
            instance += ' ';
        }
    });
    finish();
    return tasks;
}

} // namespace rapid::project

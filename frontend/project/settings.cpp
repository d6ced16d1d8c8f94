#include "frontend/project/settings.h"

#include "config/json_text.h"
#include "frontend/diag/messages/projects.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <fmt/format.h>

namespace rapid::project {

namespace fs = std::filesystem;
using Json = nlohmann::json;
namespace say = diag::say;

namespace {

constexpr std::array<std::string_view, 2> kSections = {"format", "warnings"};

/// The place of `"name"` as a key at or after `from`; an empty range at `from` if it is written in a different way.
SourceRange placeOf(std::string_view text, const std::string& name, size_t from) {
    const std::string key = '"' + name + '"';
    for (size_t at = text.find(key, from); at != std::string_view::npos; at = text.find(key, at + 1)) {
        const size_t next = text.find_first_not_of(" \t\r\n", at + key.size());
        if (next != std::string_view::npos && text[next] == ':')
            return {static_cast<uint32_t>(at), static_cast<uint32_t>(at + key.size())};
    }
    return {static_cast<uint32_t>(from), static_cast<uint32_t>(from)};
}

class Reader {
  public:
    Reader(Settings& out, diag::Sink& sink) : out_(out), sink_(sink) {}

    void read() {
        const std::string_view text = out_.file->text();
        Json json;
        try {
            json = config::parseJson(text, true);
        } catch (const Json::parse_error& problem) {
            reportSyntax(text, problem.byte);
            return;
        } catch (const Json::exception&) {
            report(say::BadProjectFile, {0, 0}, {"a number in it is too large"});
            return;
        }
        if (!json.is_object()) {
            report(say::BadProjectFile, {0, 0}, {"expected an object '{ ... }'"});
            return;
        }
        for (const auto& [name, section] : json.items())
            readSection(name, section);
    }

  private:
    // A whole line is named, so that a missing comma or quote is in sight.
    void reportSyntax(std::string_view text, size_t byte) {
        const auto at = static_cast<uint32_t>(std::min(byte > 0 ? byte - 1 : 0, text.size()));
        report(say::BadProjectFile, {at, at},
               {fmt::format("the text is not JSON at line {}", out_.file->lineColumn(at).line)});
    }

    void readSection(const std::string& name, const Json& section) {
        const SourceRange place = placeOf(out_.file->text(), name, 0);
        if (std::find(kSections.begin(), kSections.end(), name) == kSections.end()) {
            report(say::UnknownSetting, place, {name, "'format' or 'warnings'"});
            return;
        }
        if (!section.is_object()) {
            report(say::BadSetting, place, {name, "an object '{ ... }'"});
            return;
        }
        constexpr size_t kMostPlaces = 1000; // looking for them takes time, and more mistakes are not shown
        for (const auto& [key, value] : section.items()) {
            const bool sought = out_.entries.size() < kMostPlaces;
            Setting setting{name, key, false, sought ? placeOf(out_.file->text(), key, place.end) : place};
            if (value.is_boolean())
                setting.value = value.get<bool>();
            else if (value.is_number())
                setting.value = value.get<double>();
            else if (value.is_string())
                setting.value = value.get<std::string>();
            else {
                report(say::BadSetting, setting.range, {key, "text, a number, true or false"});
                continue;
            }
            out_.entries.push_back(std::move(setting));
        }
    }

    template <size_t N> void report(diag::Message<N> message, SourceRange where, diag::MessageArgs<N> args) {
        sink_.report(message, out_.file, where, args);
    }

    Settings& out_;
    diag::Sink& sink_;
};

} // namespace

std::string findSettings(const std::string& input) {
    std::error_code error;
    fs::path folder = fs::absolute(input, error);
    if (error) return {};
    if (!fs::is_directory(folder, error)) folder = folder.parent_path();
    for (;; folder = folder.parent_path()) {
        const fs::path candidate = folder / kSettingsFile;
        if (fs::exists(candidate, error)) return candidate.string(); // of whatever kind: reading it shows
        if (folder == folder.parent_path()) return {};
    }
}

Settings readSettings(std::shared_ptr<const SourceFile> file, diag::Sink& sink) {
    Settings settings;
    settings.file = std::move(file);
    Reader(settings, sink).read();
    return settings;
}

Settings loadSettings(const std::string& input, diag::Sink& sink, const OpenTexts* texts) {
    const std::string path = findSettings(input);
    if (path.empty()) return {};
    std::string bytes;
    if (const std::string problem = readText(texts, path, bytes); !problem.empty()) {
        sink.report(say::BadProjectFile, nullptr, {},
                    {fmt::format("'{}' cannot be read: {}", path, problem)});
        return {};
    }
    return readSettings(std::make_shared<const SourceFile>(fs::proximate(path).string(), std::move(bytes)),
                        sink);
}

} // namespace rapid::project

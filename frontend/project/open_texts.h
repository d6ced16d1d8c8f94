#pragma once
// Texts that count before the files of the same path: what an editor has open and not saved yet.

#include <filesystem>
#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::project {

/// Paths are absolute and normal (fs::path::lexically_normal); texts are UTF-8.
class OpenTexts {
  public:
    void set(const std::string& path, std::string text) { texts_[path] = std::move(text); }
    void erase(const std::string& path) { texts_.erase(path); }
    /// Null when no text of this path is open.
    const std::string* find(const std::string& path) const;
    /// The paths of the open texts that lie directly in a folder, sorted.
    std::vector<std::filesystem::path> in(const std::filesystem::path& folder) const;

  private:
    std::map<std::string, std::string> texts_;
};

/// The text of `path` in `texts` (which may be null), else the bytes of the file. Returns what went wrong, for people; empty:
/// success.
[[nodiscard]] std::string readText(const OpenTexts* texts, const std::string& path, std::string& bytes);

} // namespace rapid::project

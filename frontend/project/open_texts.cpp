#include "frontend/project/open_texts.h"

#include "config/read_file.h"

namespace rapid::project {

const std::string* OpenTexts::find(const std::string& path) const {
    const auto found = texts_.find(path);
    return found == texts_.end() ? nullptr : &found->second;
}

std::vector<std::filesystem::path> OpenTexts::in(const std::filesystem::path& folder) const {
    std::vector<std::filesystem::path> found;
    for (const auto& [path, text] : texts_)
        if (std::filesystem::path(path).parent_path() == folder) found.emplace_back(path);
    return found;
}

std::string readText(const OpenTexts* texts, const std::string& path, std::string& bytes) {
    const std::string* text = texts ? texts->find(path) : nullptr;
    if (!text) return config::readFile(path, bytes);
    bytes = *text;
    return {};
}

} // namespace rapid::project

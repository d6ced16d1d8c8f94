#include "tools/service/module_edits.h"

#include "frontend/source/source_file.h"

#include <algorithm>

namespace rapidc::service {

void ModuleEdits::set(const std::string& task, const std::string& path, std::string bytes) {
    files_[{task, path}] = std::move(bytes);
}

void ModuleEdits::remove(const std::string& task, const std::string& path) {
    files_[{task, path}] = std::nullopt;
}

void ModuleEdits::applyTo(std::vector<rapid::sema::TaskInput>& tasks) const {
    for (rapid::sema::TaskInput& task : tasks)
        if (const auto entry = entries_.find(task.name); entry != entries_.end()) task.entry = entry->second;
    for (const auto& [key, bytes] : files_) {
        const std::string &name = key.first, &path = key.second;
        const auto task = std::find_if(tasks.begin(), tasks.end(),
                                       [&name](const auto& input) { return input.name == name; });
        if (task == tasks.end()) continue;
        const auto file = std::find_if(task->files.begin(), task->files.end(),
                                       [&path](const auto& source) { return source->path() == path; });
        if (!bytes) {
            if (file != task->files.end()) task->files.erase(file);
            continue;
        }
        auto source = std::make_shared<const rapid::SourceFile>(path, *bytes);
        if (file != task->files.end())
            *file = std::move(source);
        else
            task->files.push_back(std::move(source));
    }
}

} // namespace rapidc::service

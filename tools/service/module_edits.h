#pragma once
// ModuleEdits: how the modules of a program differ from the files it was made of: files changed, added and taken out by clients.

#include "frontend/sema/checker.h"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace rapidc::service {

class ModuleEdits {
  public:
    /// `path` as the program knows its file; another path is an additional file of the task.
    void set(const std::string& task, const std::string& path, std::string bytes);
    void remove(const std::string& task, const std::string& path);
    /// The procedure with which the task begins.
    void setEntry(const std::string& task, std::string routine) { entries_[task] = std::move(routine); }
    void clearEntry(const std::string& task) { entries_.erase(task); }
    void applyTo(std::vector<rapid::sema::TaskInput>& tasks) const;

  private:
    std::map<std::pair<std::string, std::string>, std::optional<std::string>>
        files_;                                  ///< by task and path; none: taken out
    std::map<std::string, std::string> entries_; ///< by task
};

} // namespace rapidc::service

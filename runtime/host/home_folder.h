#pragma once
// HomeFolder: the controller's HOME: as a folder of the host. RAPID paths are resolved here and nowhere else,
// so that nothing outside it can be reached.

#include "config/temporary.h"

#include <string>
#include <string_view>

namespace rt {

class HomeFolder {
  public:
    HomeFolder() = default;
    HomeFolder(const HomeFolder&) = delete;
    HomeFolder& operator=(const HomeFolder&) = delete;

    /// Uses an existing folder; false with a message when it is none.
    bool open(const std::string& path, std::string& error);
    /// Makes an empty folder that the destructor removes, and removes those of processes that were killed.
    bool openTemporary(std::string& error);
    /// Absolute path of the folder on the host, symbolic links resolved.
    const std::string& path() const { return path_; }

    /// Turns a RAPID path ("HOME:/part/a.txt", "HOME:a.txt", "part/a.txt", relative to HOME:) into a path of
    /// the host. False when it would leave the folder, by `..` or through a symbolic link, names another
    /// device, or is not a possible path: the caller raises ERR_FILEACC. The file need not exist.
    bool resolve(std::string_view rapidPath, std::string& hostPath) const;
    /// With the directory given apart, as in Open "HOME:" \File:="a.txt".
    bool resolve(std::string_view directory, std::string_view file, std::string& hostPath) const;

  private:
    bool walk(std::string_view relative, std::string& hostPath) const;
    std::string path_;
    rapid::config::TemporaryFolder temporary_;
};

} // namespace rt

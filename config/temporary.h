#pragma once
// Temporary files and folders that a later process can tell from those of living ones: their names say that they are
// rapidc's, and each is locked (flock) as long as its process lives, however that ends.

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace rapid::config {

/// A new, empty, locked file `.NAME.rapidc-PID-XXXXXX.tmp`, in the folder where `name` is to be.
class TemporaryFile {
  public:
    TemporaryFile() = default;
    ~TemporaryFile(); ///< removes the file unless it was renamed
    TemporaryFile(const TemporaryFile&) = delete;
    TemporaryFile& operator=(const TemporaryFile&) = delete;

    /// 0 or the number of the error.
    [[nodiscard]] int make(const std::filesystem::path& folder, const std::string& name);
    int descriptor() const { return file_; }
    /// Takes the place of `target`, which lies in the same folder. 0 or the number of the error.
    [[nodiscard]] int renameTo(const std::filesystem::path& target);

  private:
    std::string path_;
    int file_ = -1;
};

/// A new, empty, locked folder; the destructor removes it with all that it holds.
class TemporaryFolder {
  public:
    TemporaryFolder() = default;
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    /// `rapidc-PURPOSE-PID-XXXXXX` in the folder for temporary files, once leftovers there are removed. 0 or the
    /// number of the error.
    [[nodiscard]] int make(std::string_view purpose);
    /// `.NAME.rapidc-PID-XXXXXX` in the folder where `name` is to be. 0 or the number of the error.
    [[nodiscard]] int makeBeside(const std::filesystem::path& folder, const std::string& name);
    const std::string& path() const { return path_; }

  private:
    int makeFrom(const std::string& pattern);
    std::string path_;
    int lock_ = -1;
};

/// Removes the temporary files and folders of this user in `folder` that no living process owns. Files of other
/// programs, and what cannot be locked (some network file systems), stay.
void removeLeftovers(const std::filesystem::path& folder);
/// The same in a folder and all folders below it, of which `most` are read; links are not followed.
void removeLeftoversBelow(const std::filesystem::path& folder, std::size_t most);
/// The same in the folders of these files, in each once.
void removeLeftoversBeside(const std::vector<std::string>& files);

} // namespace rapid::config

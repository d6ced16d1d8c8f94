#pragma once
// FileVolumes: the volumes of the controller ($HOME, $BACKUP ...) as clients see them. Nothing outside of a volume can be reached, by
// whatever name. A file is replaced in one step, or not at all. All calls from any thread.

#include "runtime/host/volumes.h"

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace rapidc::service {

enum class FileProblem : uint8_t {
    None,
    NoPath,   ///< there is no such file, folder or volume
    Outside,  ///< the path leads out of its volume, or is not a possible one
    Exists,   ///< a target that is there already
    Refused,  ///< a volume as such, a device, no permission
    TooLarge, ///< the file, or more than the disk has room for
    Failed,   ///< the disk
};

struct FileResult {
    FileProblem problem = FileProblem::None;
    std::string text; ///< for people
    bool isDone() const { return problem == FileProblem::None; }
};

struct FileEntry {
    std::string name;
    bool isFolder = false;
    bool isReadOnly = false;
    uint64_t size = 0;                 ///< bytes
    int64_t created = 0, modified = 0; ///< seconds since 1970
};

/// A name for a new file of programs and modules: without folder, volume and control characters, not hidden, at most 80 bytes.
bool isPlainFileName(std::string_view name);

/// A path in a volume: "$HOME/part/a.mod". The volume's name in any case, with or without '$'.
class FileVolumes {
  public:
    static constexpr uint64_t kLargestRead = uint64_t{256} << 20; ///< bytes of a file that is handed out

    FileVolumes() = default;
    /// Adds the folder of the host as volume `name`; false when it is none.
    bool add(const std::string& name, const std::string& folder);
    /// Names as they are added, without '$'.
    const std::vector<std::string>& names() const { return names_; }
    bool has(const std::string& path) const;
    /// Bytes of the disk of that volume: free and in all.
    std::pair<uint64_t, uint64_t> space(const std::string& volume) const;

    FileResult describe(const std::string& path, FileEntry& entry) const;
    /// The entries of a folder, folders first, each sorted by name.
    FileResult list(const std::string& path, std::vector<FileEntry>& entries) const;
    FileResult read(const std::string& path, std::string& bytes) const;
    /// `isNew`: there was no such file.
    FileResult write(const std::string& path, std::string_view bytes, bool& isNew) const;
    FileResult makeFolder(const std::string& parent, const std::string& name) const;
    /// A file, or a folder with all that it holds.
    FileResult remove(const std::string& path) const;
    /// Within its folder; `name` is a bare name.
    FileResult rename(const std::string& path, const std::string& name) const;
    FileResult copy(const std::string& path, const std::string& name, bool overwrite) const;
    /// Of a file, to a path of any volume.
    FileResult copyTo(const std::string& from, const std::string& to, bool overwrite) const;
    /// The path on the host, for parts of the controller that take one.
    FileResult hostPath(const std::string& path, std::string& host) const;

  private:
    FileResult locate(const std::string& path, rt::Volumes::LastLink last, rt::VolumePlace& place) const;

    rt::Volumes volumes_;
    std::vector<std::string> names_;
};

} // namespace rapidc::service

#pragma once
// PlacedFile: the new contents of a file of a volume, which appear there in one step. A process that is killed meanwhile
// leaves the old file or the new one, never a part.

#include "config/temporary.h"
#include "runtime/host/volumes.h"

#include <string>
#include <string_view>

#include <sys/stat.h>

namespace rt::lib {

class PlacedFile {
  public:
    /// Makes an empty file beside the place, to be written through descriptor(). 0 or the number of the error.
    [[nodiscard]] int make(const VolumePlace& place);
    int descriptor() const { return file_.descriptor(); }
    /// Puts it in the place of what is there. `mode`: permissions of the file. 0 or the number of the error.
    [[nodiscard]] int replace(mode_t mode);
    /// Puts it where nothing must be yet (EEXIST otherwise). `mode`: as in open(). 0 or the number of the error.
    [[nodiscard]] int putNew(mode_t mode);

  private:
    rapid::config::TemporaryFile file_;
    const VolumePlace* place_ = nullptr;
    std::string folder_; ///< the open folder of the place: links on the way to it do not matter
};

/// Writes all of a file of a volume, in one step and to the disk. An existing file keeps its permissions. 0 or the number of the error.
[[nodiscard]] int replaceWhole(const VolumePlace& place, std::string_view bytes);

} // namespace rt::lib

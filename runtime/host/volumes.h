#pragma once
// Volumes: the disks of the controller (HOME:, TEMP: ...) as folders of the host. RAPID paths are resolved here and nowhere
// else, so that a program can reach nothing outside of them.

#include "config/temporary.h"
#include "runtime/base/descriptor.h"

#include <map>
#include <string>
#include <string_view>
#include <vector>

namespace rt {

/// A place in a volume that was found without leaving it: the folder is open, and `name` is one part of a path in it ("."
/// for the volume itself). Calls such as openat() with O_NOFOLLOW reach exactly this place, whatever happens to the links
/// and folders on the way to it meanwhile.
struct VolumePlace {
    Descriptor folder;
    std::string name;
    bool leaves = false; ///< nothing was found: the path leads out of its volume
};

class Volumes {
  public:
    Volumes() = default;
    Volumes(const Volumes&) = delete;
    Volumes& operator=(const Volumes&) = delete;

    /// Uses an existing folder of the host as HOME:. False with a message when it is none.
    bool open(const std::string& path, std::string& error) { return use("HOME", path, error); }
    /// The same for the volume of that name (without its colon).
    bool use(const std::string& name, const std::string& path, std::string& error);
    /// Takes "NAME=DIR" (--volume); HOME: has an option of its own.
    bool useAsWritten(const std::string& text, std::string& error);
    /// Makes HOME: an empty folder, which the destructor removes, and removes those of processes that were killed.
    bool openTemporary(std::string& error);
    /// Absolute path of HOME: on the host, symbolic links resolved.
    const std::string& path() const { return home_; }

    /// Whether a volume has this name (without its colon): one that was named with use(), or HOME, TEMP, RAMDISK, BACKUP
    /// or DATA, which are empty temporary folders otherwise.
    bool has(std::string_view name) const;

    /// A serial channel or printer: the files of a volume, or FIFOs, that it is read from and written to.
    struct Device {
        std::string input, output; ///< RAPID paths
    };
    /// Takes "com1=HOME:/in.txt,HOME:/out.txt" (--device); a single file serves both ways.
    bool addDevice(const std::string& text, std::string& error);
    /// The device that a path such as "com1:" names; null when it names none.
    const Device* device(std::string_view rapidPath) const;

    /// Turns a RAPID path ("HOME:/part/a.txt", "HOME:a.txt", "TEMP:a.txt", "part/a.txt", relative to HOME:) into a path
    /// of the host. False when it would leave the volume, by `..` or through a symbolic link, names another device, or is
    /// not a possible path: the caller raises ERR_FILEACC. The file need not exist.
    bool resolve(std::string_view rapidPath, std::string& hostPath) const;
    /// With the directory given apart, as in Open "HOME:" \File:="a.txt".
    bool resolve(std::string_view directory, std::string_view file, std::string& hostPath) const;

    enum class LastLink : uint8_t { Follow, Keep };
    /// Finds a place, which need not exist; its folder must. `Keep`: a symbolic link as the last part is the place itself
    /// (to remove or rename it). Returns "" or, in words, why the path leads nowhere.
    std::string locate(std::string_view rapidPath, LastLink last, VolumePlace& place) const;

    /// "HOME:" and "a.txt" as one path. A file part with a device of its own gives a path that leads nowhere.
    static std::string joined(std::string_view directory, std::string_view file);

  private:
    struct Volume {
        std::string path;
        Descriptor root;
        rapid::config::TemporaryFolder temporary;
    };
    bool openFolder(Volume& volume, const std::string& path, std::string& error) const;
    const Volume* find(std::string_view rapidPath, std::string& relative, std::string& error) const;
    const Volume* volumeNamed(std::string_view name, std::string& error) const;

    mutable std::map<std::string, Volume>
        volumes_; ///< by name in upper case; temporary ones are made when first used
    std::map<std::string, Device> devices_; ///< by name in upper case
    std::string home_;
};

} // namespace rt

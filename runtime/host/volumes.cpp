#include "runtime/host/volumes.h"

#include "config/letter_case.h"
#include "runtime/base/text_util.h"

#include <fmt/format.h>

#include <fcntl.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <climits>
#include <cstring>
#include <deque>
#include <filesystem>

namespace rt {
namespace {

namespace fs = std::filesystem;

constexpr int kMaxLinks = 40;          // as the kernel allows
constexpr std::size_t kMaxDepth = 200; // folders open at once on the way
constexpr std::array<std::string_view, 5> kTemporaryVolumes = {"HOME", "TEMP", "RAMDISK", "BACKUP", "DATA"};

std::vector<std::string> partsOf(std::string_view path) {
    std::vector<std::string> parts;
    for (std::size_t begin = 0; begin <= path.size();) {
        const std::size_t end = std::min(path.find('/', begin), path.size());
        const std::string_view part = path.substr(begin, end - begin);
        if (!part.empty() && part != ".") parts.emplace_back(part);
        begin = end + 1;
    }
    return parts;
}

/// Follows a path part by part. Each part is opened by itself and without following it, and `..` goes back to the folder it
/// was opened from: neither `..` nor a symbolic link, even a dangling one or one that changes meanwhile, leads out.
class Walk {
  public:
    Walk(const std::string& rootPath, int root) : rootPath_(rootPath), root_(root) {}

    /// "" or why the path leads nowhere. Parts that do not exist are kept as they are written.
    std::string follow(std::string_view relative, Volumes::LastLink last) {
        const std::vector<std::string> parts = partsOf(relative);
        open_.assign(parts.begin(), parts.end());
        while (!open_.empty()) {
            std::string part = std::move(open_.front());
            open_.pop_front();
            if (std::string problem = take(std::move(part), last); !problem.empty()) return problem;
        }
        return {};
    }

    bool leaves() const { return leaves_; }

    std::string hostPath() const {
        std::string path = rootPath_;
        for (const Step& step : done_)
            path += "/" + step.name;
        return path;
    }

    std::string place(VolumePlace& place) {
        const bool atRoot = done_.size() < 2;
        const int folder = atRoot ? root_ : done_[done_.size() - 2].file.number();
        if (folder < 0) {
            const auto missing = std::find_if(done_.begin(), done_.end(),
                                              [](const Step& step) { return !step.file.isOpen(); });
            return fmt::format("folder {} does not exist", missing->name);
        }
        place.name = done_.empty() ? "." : done_.back().name;
        if (!atRoot)
            place.folder = std::move(done_[done_.size() - 2].file);
        else
            place.folder = Descriptor(::fcntl(root_, F_DUPFD_CLOEXEC, 0));
        return place.folder.isOpen() ? std::string() : std::string(std::strerror(errno));
    }

  private:
    struct Step {
        std::string name;
        Descriptor file; ///< not open: this part does not exist
    };

    std::string take(std::string part, Volumes::LastLink last) {
        if (part == "..") {
            if (done_.empty()) return left();
            done_.pop_back();
            return {};
        }
        if (part.size() > NAME_MAX) return "a name in it is longer than 255 bytes";
        if (done_.size() >= kMaxDepth) return "it has too many parts";
        const int parent = done_.empty() ? root_ : done_.back().file.number();
        Descriptor file;
        if (parent >= 0) file = Descriptor(::openat(parent, part.c_str(), O_PATH | O_NOFOLLOW | O_CLOEXEC));
        if (parent >= 0 && !file.isOpen()) {
            if (errno == ENOTDIR)
                done_.back().file.close(); // a file: nothing can be in it
            else if (errno != ENOENT)
                return std::strerror(errno);
        }
        struct stat status{};
        const bool isLink = file.isOpen() && ::fstat(file.number(), &status) == 0 && S_ISLNK(status.st_mode);
        if (isLink && !(open_.empty() && last == Volumes::LastLink::Keep)) return goTo(file.number());
        done_.push_back({std::move(part), std::move(file)});
        return {};
    }

    std::string left() {
        leaves_ = true;
        return "it leads out of the volume";
    }

    std::string goTo(int link) {
        if (++links_ > kMaxLinks) return "it has too many symbolic links";
        std::array<char, PATH_MAX> text{};
        const ssize_t size = ::readlinkat(link, "", text.data(), text.size());
        if (size <= 0) return "a symbolic link in it cannot be read";
        const std::string_view target(text.data(), static_cast<std::size_t>(size));
        std::vector<std::string> parts = partsOf(target);
        if (target.front() == '/') { // absolute: fine when it begins with the volume itself
            done_.clear();
            const std::vector<std::string> rootParts = partsOf(rootPath_);
            if (parts.size() < rootParts.size() ||
                !std::equal(rootParts.begin(), rootParts.end(), parts.begin()))
                return left();
            parts.erase(parts.begin(), parts.begin() + static_cast<std::ptrdiff_t>(rootParts.size()));
        }
        open_.insert(open_.begin(), parts.begin(), parts.end());
        return {};
    }

    const std::string& rootPath_;
    int root_;
    int links_ = 0;
    bool leaves_ = false;
    std::deque<std::string> open_;
    std::vector<Step> done_;
};

} // namespace

bool Volumes::openFolder(Volume& volume, const std::string& path, std::string& error) const {
    std::error_code code;
    const fs::path real = fs::canonical(path, code);
    if (!code) volume.root = Descriptor(::open(real.c_str(), O_PATH | O_DIRECTORY | O_CLOEXEC));
    if (code || !volume.root.isOpen()) {
        error = fmt::format("{} is not a folder", path);
        return false;
    }
    volume.path = real.string();
    return true;
}

namespace {

/// "USB1=DIR" as name (upper case, no colon) and rest. False: it is not of this form.
bool splitOption(const std::string& text, std::string& name, std::string& rest) {
    const std::size_t equals = text.find('=');
    if (equals == std::string::npos) return false;
    name = upperCase(text.substr(0, equals));
    if (!name.empty() && name.back() == ':') name.pop_back();
    rest = text.substr(equals + 1);
    return !name.empty() && !rest.empty() && std::all_of(name.begin(), name.end(), [](unsigned char c) {
        return (c >= 'A' && c <= 'Z') || (c >= '0' && c <= '9') || c == '_';
    });
}

} // namespace

bool Volumes::use(const std::string& name, const std::string& path, std::string& error) {
    Volume& volume = volumes_[upperCase(name)];
    if (!openFolder(volume, path, error)) {
        volumes_.erase(upperCase(name));
        return false;
    }
    if (sameName(name, "HOME")) home_ = volume.path;
    return true;
}

bool Volumes::useAsWritten(const std::string& text, std::string& error) {
    std::string name, folder;
    if (!splitOption(text, name, folder)) {
        error = fmt::format("expected NAME=DIR, such as USB1=/media/stick, found '{}'", text);
        return false;
    }
    if (sameName(name, "HOME")) {
        error = "HOME: is given by --home=DIR";
        return false;
    }
    if (volumes_.count(name) != 0) {
        error = fmt::format("{}: is given twice", name);
        return false;
    }
    return use(name, folder, error);
}

bool Volumes::addDevice(const std::string& text, std::string& error) {
    std::string name, files;
    if (!splitOption(text, name, files)) {
        error = fmt::format("expected NAME=FILE[,FILE], such as com1=HOME:/com1.txt, found '{}'", text);
        return false;
    }
    if (has(name)) {
        error = fmt::format("{}: is a disk", name);
        return false;
    }
    const std::size_t comma = files.find(',');
    Device device{files.substr(0, comma), files.substr(comma == std::string::npos ? 0 : comma + 1)};
    for (const std::string& file : {device.input, device.output}) {
        VolumePlace place;
        if (const std::string problem = locate(file, LastLink::Follow, place); !problem.empty()) {
            error = fmt::format("{}: '{}' cannot be used: {}", name, file, problem);
            return false;
        }
    }
    if (!devices_.emplace(name, std::move(device)).second) {
        error = fmt::format("{}: is given twice", name);
        return false;
    }
    return true;
}

const Volumes::Device* Volumes::device(std::string_view rapidPath) const {
    const std::size_t colon = rapidPath.find(':');
    if (colon == std::string_view::npos) return nullptr;
    const auto found = devices_.find(upperCase(rapidPath.substr(0, colon)));
    return found == devices_.end() ? nullptr : &found->second;
}

bool Volumes::openTemporary(std::string& error) {
    const Volume* volume = volumeNamed("HOME", error);
    if (volume == nullptr) return false;
    home_ = volume->path;
    return true;
}

bool Volumes::has(std::string_view name) const {
    return volumes_.count(upperCase(name)) != 0 ||
           std::any_of(kTemporaryVolumes.begin(), kTemporaryVolumes.end(),
                       [name](std::string_view known) { return sameName(name, known); });
}

const Volumes::Volume* Volumes::volumeNamed(std::string_view name, std::string& error) const {
    const std::string key = upperCase(name);
    if (const auto found = volumes_.find(key); found != volumes_.end()) return &found->second;
    if (!has(name)) {
        error = fmt::format(
            "the controller has no volume or device {0}: (--volume={0}=DIR or --device={0}=FILE gives "
            "it one)",
            name);
        return nullptr;
    }
    Volume& volume = volumes_[key];
    const std::string purpose = rapid::config::lowerCase(key);
    if (const int problem = volume.temporary.make(purpose); problem != 0)
        error = fmt::format("cannot make a temporary folder for {}: {}", key, std::strerror(problem));
    else if (openFolder(volume, volume.temporary.path(), error))
        return &volume;
    volumes_.erase(key);
    return nullptr;
}

/// The volume that a path names, and the rest of the path. Null with the reason when there is none.
const Volumes::Volume* Volumes::find(std::string_view rapidPath, std::string& relative,
                                     std::string& error) const {
    relative = rapidPath;
    std::replace(relative.begin(), relative.end(), '\\', '/'); // programs written under Windows
    std::string name = "HOME";
    if (const std::size_t colon = relative.find(':'); colon != std::string::npos) {
        name = relative.substr(0, colon);
        relative.erase(0, colon + 1);
    }
    if (rapidPath.find('\0') != std::string_view::npos) {
        error = "it contains the character \\00";
        return nullptr;
    }
    return volumeNamed(name, error);
}

bool Volumes::resolve(std::string_view rapidPath, std::string& hostPath) const {
    std::string relative, error;
    const Volume* volume = find(rapidPath, relative, error);
    if (volume == nullptr) return false;
    Walk walk(volume->path, volume->root.number());
    if (!walk.follow(relative, LastLink::Follow).empty()) return false;
    hostPath = walk.hostPath();
    return true;
}

bool Volumes::resolve(std::string_view directory, std::string_view file, std::string& hostPath) const {
    return resolve(joined(directory, file), hostPath);
}

std::string Volumes::locate(std::string_view rapidPath, LastLink last, VolumePlace& place) const {
    std::string relative, error;
    const Volume* volume = find(rapidPath, relative, error);
    if (volume == nullptr) return error;
    Walk walk(volume->path, volume->root.number());
    error = walk.follow(relative, last);
    place.leaves = walk.leaves();
    return error.empty() ? walk.place(place) : error;
}

std::string Volumes::joined(std::string_view directory, std::string_view file) {
    if (file.empty()) return std::string(directory);
    // A device in the second part would turn the first into nothing.
    if (file.find(':') != std::string_view::npos) return "HOME:/..";
    return fmt::format("{}/{}", directory, file);
}

} // namespace rt

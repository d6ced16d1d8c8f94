#include "runtime/host/mapped_image.h"

#include <cerrno>
#include <cstring>
#include <fmt/format.h>
#include <sys/mman.h>

namespace rt {
namespace {

constexpr uint64_t kPage = 4096;
constexpr uint64_t kLargest = uint64_t{1} << 30;

bool isWithin(uint64_t offset, uint64_t size, uint64_t whole) {
    return offset <= whole && size <= whole - offset;
}

/// It may come from another process.
bool makesSense(const UnitImage& image, std::size_t imports) {
    if (image.size == 0 || image.size > kLargest || image.imports.size() != imports ||
        !isWithin(image.program, sizeof(ProgramDesc), image.size))
        return false;
    for (const UnitImage::Segment& segment : image.segments)
        if (segment.offset % kPage != 0 || segment.bytes.size() > segment.size ||
            !isWithin(segment.offset, segment.size, image.size))
            return false;
    for (const UnitImage::Patch& patch : image.patches)
        if (!isWithin(patch.offset, sizeof(void*), image.size) || patch.import < -1 ||
            patch.import >= static_cast<int64_t>(imports))
            return false;
    return true;
}

} // namespace

std::unique_ptr<MappedImage> MappedImage::map(const UnitImage& image, const std::vector<const void*>& imports,
                                              std::string& error) {
    if (!makesSense(image, imports.size())) {
        error = "the compiled module is damaged";
        return nullptr;
    }
    void* memory = ::mmap(nullptr, image.size, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (memory == MAP_FAILED) {
        error = fmt::format("no memory for the compiled module: {}", std::strerror(errno));
        return nullptr;
    }
    std::unique_ptr<MappedImage> mapped(new MappedImage);
    mapped->base_ = static_cast<char*>(memory);
    mapped->size_ = image.size;
    mapped->program_ = image.program;
    for (const UnitImage::Segment& segment : image.segments) {
        std::memcpy(mapped->base_ + segment.offset, segment.bytes.data(), segment.bytes.size());
        const int bits =
            PROT_READ | (segment.writable ? PROT_WRITE : 0) | (segment.executable ? PROT_EXEC : 0);
        if (segment.size > 0) mapped->segments_.push_back({segment.offset, segment.size, bits});
    }
    for (const UnitImage::Patch& patch : image.patches) {
        if (patch.import < 0) {
            mapped->write(patch.offset,
                          reinterpret_cast<uint64_t>(memory) + static_cast<uint64_t>(patch.addend));
            continue;
        }
        mapped->patches_.push_back(patch);
        mapped->bind(patch, imports[static_cast<std::size_t>(patch.import)]);
    }
    if (!mapped->protect(false)) {
        error = fmt::format("memory cannot be made executable: {}", std::strerror(errno));
        return nullptr;
    }
    return mapped;
}

MappedImage::~MappedImage() {
    if (base_ != nullptr) ::munmap(base_, size_);
}

/// While addresses are changed everything can be written and nothing executed.
bool MappedImage::protect(bool patching) {
    bool done = true;
    for (const Protection& segment : segments_) {
        const int bits = patching ? PROT_READ | PROT_WRITE : segment.bits;
        done = ::mprotect(base_ + segment.offset, segment.size, bits) == 0 && done;
    }
    return done;
}

void MappedImage::write(uint64_t offset, uint64_t value) {
    std::memcpy(base_ + offset, &value, sizeof value);
}

void MappedImage::bind(const UnitImage::Patch& patch, const void* address) {
    const auto target = reinterpret_cast<uint64_t>(address);
    write(patch.offset, target == 0 ? 0 : target + static_cast<uint64_t>(patch.addend));
}

void MappedImage::rebind(std::size_t import, const void* address) {
    if (!protect(true)) return;
    for (const UnitImage::Patch& patch : patches_)
        if (patch.import == static_cast<int32_t>(import)) bind(patch, address);
    protect(false);
}

} // namespace rt

#pragma once
// MappedImage: a UnitImage in memory, ready to run.

#include "runtime/abi/rt_abi.h"
#include "runtime/abi/unit_image.h"

#include <memory>
#include <string>
#include <vector>

namespace rt {

class MappedImage {
  public:
    /// Maps an image, with the addresses of its imports in their order. Null with a message in `error` when the image makes no
    /// sense or there is no memory.
    static std::unique_ptr<MappedImage> map(const UnitImage& image, const std::vector<const void*>& imports,
                                            std::string& error);
    ~MappedImage();
    MappedImage(const MappedImage&) = delete;
    MappedImage& operator=(const MappedImage&) = delete;

    const ProgramDesc* program() const { return reinterpret_cast<const ProgramDesc*>(base_ + program_); }
    /// An import lies elsewhere from now on; null: it is absent.
    void rebind(std::size_t import, const void* address);

  private:
    MappedImage() = default;
    struct Protection {
        uint64_t offset, size;
        int bits;
    };
    bool protect(bool patching);
    void write(uint64_t offset, uint64_t value);
    void bind(const UnitImage::Patch& patch, const void* address);

    char* base_ = nullptr;
    uint64_t size_ = 0;
    uint64_t program_ = 0;
    std::vector<Protection> segments_;
    std::vector<UnitImage::Patch> patches_; ///< those of imports
};

} // namespace rt

#pragma once
// UnitImage: compiled code and data that can be put anywhere in memory. What compiles a module while a program runs makes
// it (codegen), maybe in another process; what runs the program maps it (runtime/host/mapped_image.h).

#include <cstdint>
#include <string>
#include <vector>

namespace rt {

struct UnitImage {
    /// Begins on a page; page = 4 KiB.
    struct Segment {
        uint64_t offset = 0;
        uint64_t size = 0; ///< in memory; what `bytes` does not cover is zero
        std::string bytes;
        bool writable = false, executable = false;
    };
    /// 8 bytes at `offset` get an address: that of an import plus `addend`, or of the image itself.
    struct Patch {
        uint64_t offset = 0;
        int64_t addend = 0;
        int32_t import = -1; ///< index into `imports`; -1: the image
    };
    uint64_t size = 0; ///< of all segments; a multiple of the page
    std::vector<Segment> segments;
    std::vector<Patch> patches;
    std::vector<std::string> imports; ///< symbols of natives, and names of external globals
    uint64_t program = 0;             ///< offset of the ProgramDesc
};

} // namespace rt

#include "frontend/source/heap.h"

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#if defined(__linux__)
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>
#endif
#if defined(__GLIBC__)
#include <malloc.h>
#endif

namespace rapid {

void putHeapOnHugePages() {
#if defined(__GLIBC__)
    constexpr int kAtOnce = 1 << 28;           // the heap grows by so much address space
    constexpr size_t kProbe = size_t{1} << 16; // less than what malloc maps by itself
    constexpr uintptr_t kHugePage = uintptr_t{1} << 21;
    constexpr int kOnHeap = 1 << 24; // what is larger is mapped by itself
    rlimit limit{};
    if (::getrlimit(RLIMIT_AS, &limit) != 0 || limit.rlim_cur != RLIM_INFINITY)
        return; // no address space to waste
    if (mallopt(M_TOP_PAD, kAtOnce) == 0 || mallopt(M_MMAP_THRESHOLD, kOnHeap) == 0) return;
    const auto before = reinterpret_cast<uintptr_t>(::sbrk(0));
    uintptr_t end = before;
    std::vector<std::unique_ptr<char[]>> probes; // they use up what is left of the old heap: it grows
    for (int i = 0; i < 64 && end == before; ++i) {
        probes.push_back(std::make_unique_for_overwrite<char[]>(kProbe));
        end = reinterpret_cast<uintptr_t>(::sbrk(0));
    }
    const uintptr_t begin = (before + kHugePage - 1) / kHugePage * kHugePage;
    if (begin < end) ::madvise(reinterpret_cast<void*>(begin), end - begin, MADV_HUGEPAGE);
#endif
}

} // namespace rapid

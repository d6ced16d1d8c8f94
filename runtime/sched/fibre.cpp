// Fibre on boost::context::fiber with its own mapped stack and the annotations that the address sanitizer needs.

#include "runtime/sched/fibre.h"

#include <boost/context/fiber.hpp>
#include <boost/context/preallocated.hpp>
#include <boost/context/stack_context.hpp>

#include <sys/mman.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>

#if defined(__SANITIZE_ADDRESS__)
#define RT_ASAN 1
#elif defined(__has_feature)
#if __has_feature(address_sanitizer)
#define RT_ASAN 1
#endif
#endif
#ifdef RT_ASAN
#include <sanitizer/common_interface_defs.h>
#endif

namespace rt {
namespace {

#ifdef RT_ASAN
constexpr std::size_t kNativeReserve = 1u << 20; // instrumented frames are large
#else
constexpr std::size_t kNativeReserve = 256u << 10;
#endif

/// The stack is mapped and unmapped by Impl.
struct NoAllocator {
    boost::context::stack_context allocate() { return {}; }
    void deallocate(boost::context::stack_context&) {}
};

} // namespace

struct Fibre::Impl {
    std::function<void()> body;
    char* mapping = nullptr;
    std::size_t mappingBytes = 0, guardBytes = 0;
    boost::context::fiber inside, outside;
    bool started = false, finished = false;
    // sanitizer: fake stacks and bounds of the stack that resumed us
    void* outsideFake = nullptr;
    void* insideFake = nullptr;
    const void* outsideBottom = nullptr;
    std::size_t outsideSize = 0;

    char* bottom() const { return mapping + guardBytes; }
    std::size_t size() const { return mappingBytes - guardBytes; }

    void create() {
        boost::context::stack_context context;
        context.sp = mapping + mappingBytes;
        context.size = size();
        inside = boost::context::fiber(std::allocator_arg,
                                       boost::context::preallocated(context.sp, context.size, context),
                                       NoAllocator{}, [this](boost::context::fiber&& from) {
                                           outside = std::move(from);
                                           enterInside();
                                           body();
                                           finished = true;
                                           leaveInside(true);
                                           return std::move(outside);
                                       });
        started = true;
    }
    void leaveOutside() {
#ifdef RT_ASAN
        __sanitizer_start_switch_fiber(&outsideFake, bottom(), size());
#endif
    }
    void backOutside() {
#ifdef RT_ASAN
        __sanitizer_finish_switch_fiber(outsideFake, nullptr, nullptr);
#endif
    }
    void enterInside() {
#ifdef RT_ASAN
        __sanitizer_finish_switch_fiber(insideFake, &outsideBottom, &outsideSize);
#endif
    }
    void leaveInside(bool forGood) {
        (void)forGood;
#ifdef RT_ASAN
        __sanitizer_start_switch_fiber(forGood ? nullptr : &insideFake, outsideBottom, outsideSize);
#endif
    }
};

Fibre::Fibre(std::size_t stackBytes, std::function<void()> body) : impl_(std::make_unique<Impl>()) {
    Impl& impl = *impl_;
    impl.body = std::move(body);
    const auto page = static_cast<std::size_t>(sysconf(_SC_PAGESIZE));
    const std::size_t wanted = stackBytes < 2 * kNativeReserve ? 2 * kNativeReserve : stackBytes;
    impl.guardBytes = page;
    impl.mappingBytes = (wanted + page - 1) / page * page + page;
    void* mapping = mmap(nullptr, impl.mappingBytes, PROT_READ | PROT_WRITE,
                         MAP_PRIVATE | MAP_ANONYMOUS | MAP_NORESERVE | MAP_STACK, -1, 0);
    if (mapping == MAP_FAILED || mprotect(mapping, page, PROT_NONE) != 0) {
        std::fputs("cannot reserve memory for the stack of a task\n", stderr);
        std::abort();
    }
    impl.mapping = static_cast<char*>(mapping);
}

Fibre::~Fibre() {
    Impl& impl = *impl_;
    if (impl.started && !impl.finished) {
        // Destroying the fiber would throw through the frames on it; so it is kept, with its stack.
        [[maybe_unused]] const Impl* const kept = impl_.release();
        return;
    }
    munmap(impl.mapping, impl.mappingBytes);
}

void Fibre::resume() {
    Impl& impl = *impl_;
    if (impl.finished) return;
    if (!impl.started) impl.create();
    impl.leaveOutside();
    impl.inside = std::move(impl.inside).resume();
    impl.backOutside();
}

void Fibre::suspend() {
    Impl& impl = *impl_;
    impl.leaveInside(false);
    impl.outside = std::move(impl.outside).resume();
    impl.enterInside();
}

bool Fibre::started() const {
    return impl_->started;
}

bool Fibre::finished() const {
    return impl_->finished;
}

char* Fibre::stackLimit() const {
    return impl_->bottom() + kNativeReserve;
}

bool Fibre::owns(const void* address) const {
    const auto* at = static_cast<const char*>(address);
    return at >= impl_->bottom() && at < impl_->bottom() + impl_->size();
}

} // namespace rt

#include "runtime/sched/inbox.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <unistd.h>

#include <cstdint>
#include <system_error>
#include <utility>

namespace rt {

Inbox::Inbox() : descriptor_(::eventfd(0, EFD_CLOEXEC | EFD_NONBLOCK)) {
    if (descriptor_ < 0) throw std::system_error(errno, std::generic_category(), "eventfd");
}

Inbox::~Inbox() {
    ::close(descriptor_);
}

void Inbox::post(Command command) {
    const std::lock_guard<std::mutex> lock(mutex_);
    commands_.push_back(std::move(command));
    waiting_.fetch_add(1, std::memory_order_release);
    const uint64_t one = 1;
    (void)!::write(descriptor_, &one, sizeof one); // full only when the owner is to wake anyway
}

bool Inbox::take(Command& command) {
    const std::lock_guard<std::mutex> lock(mutex_);
    if (commands_.empty()) return false;
    command = std::move(commands_.front());
    commands_.pop_front();
    waiting_.fetch_sub(1, std::memory_order_release);
    if (commands_.empty()) {
        uint64_t count = 0;
        (void)!::read(descriptor_, &count, sizeof count);
    }
    return true;
}

void Inbox::run() {
    Command command;
    while (hasCommands() && take(command))
        command();
}

void Inbox::wait(int milliseconds) {
    pollfd file{descriptor_, POLLIN, 0};
    (void)::poll(&file, 1, milliseconds);
}

} // namespace rt

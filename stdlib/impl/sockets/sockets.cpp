#include "stdlib/impl/sockets/sockets.h"

#include <fmt/format.h>

#include <vector>

namespace rt::lib {
namespace {

std::string describe(const net::Socket& socket) {
    if (socket.state() == net::Socket::State::Connected)
        return fmt::format("connection with {}", net::addressText(socket.remote()));
    return socket.local().port == 0 ? "a socket without address"
                                    : fmt::format("{}", net::addressText(socket.local()));
}

} // namespace

Sockets& Sockets::of(Controller& controller) {
    auto& sockets = controller.service<Sockets>();
    if (!sockets.isOpen_)
        sockets.network_.open(controller.scheduler(), controller.log(), controller.options().network);
    sockets.isOpen_ = true;
    return sockets;
}

std::shared_ptr<net::Socket> Sockets::find(Handle handle) {
    const std::shared_ptr<net::Socket>* socket = table_.find(handle);
    if (socket == nullptr) return nullptr;
    if ((*socket)->state() != net::Socket::State::Closed) return *socket;
    table_.erase(handle);
    return nullptr;
}

void Sockets::close(Handle handle) {
    if (const std::shared_ptr<net::Socket>* socket = table_.find(handle)) (*socket)->close();
    table_.erase(handle);
}

std::size_t Sockets::closeAll(const Task& task, std::string& which) {
    std::vector<Handle> owned;
    for (const auto& [handle, socket] : table_) {
        if (&socket->owner() != &task) continue;
        owned.push_back(handle);
        which += (which.empty() ? "" : ", ") + describe(*socket);
    }
    for (const Handle handle : owned)
        close(handle);
    return owned.size();
}

void closeSockets(Task& task, const char* why) {
    std::string which;
    if (Sockets::of(task.controller()).closeAll(task, which) > 0)
        task.report(EventId::SocketsClosed, {task.name(), why, which});
}

} // namespace rt::lib

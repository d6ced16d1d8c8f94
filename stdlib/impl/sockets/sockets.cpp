#include "stdlib/impl/sockets/sockets.h"

#include <fmt/format.h>

#include <vector>

namespace rt::lib {
namespace {

std::string describe(const net::Socket& socket) {
    if (socket.state() == net::Socket::State::Connected)
        return "connection with " + (socket.remote().port == 0 ? net::ipText(socket.remote().ip)
                                                               : net::addressText(socket.remote()));
    return socket.local().port == 0 ? "a socket without address" : net::addressText(socket.local());
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

/// Those whose connection has ended; no variable may name them any more.
void Sockets::forgetClosed() {
    std::vector<Handle> closed;
    for (const auto& [handle, socket] : table_)
        if (socket->state() == net::Socket::State::Closed) closed.push_back(handle);
    for (const Handle handle : closed)
        table_.erase(handle);
}

bool Sockets::isFull() {
    if (table_.size() >= kMost) forgetClosed();
    return table_.size() >= kMost;
}

void Sockets::close(Handle handle) {
    if (const std::shared_ptr<net::Socket>* socket = table_.find(handle)) (*socket)->close();
    table_.erase(handle);
}

std::size_t Sockets::closeAll(const Task& task, std::string& which) {
    forgetClosed();
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

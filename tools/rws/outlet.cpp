#include "tools/rws/outlet.h"

#include <utility>

namespace rapidc::rws {

void Outlet::send(const std::shared_ptr<const std::string>& frame) {
    const std::lock_guard lock(mutex_);
    if (ended_) return;
    if (socket_) return socket_->send(frame);
    if (waiting_.size() >= kMostWaiting) waiting_.pop_front();
    waiting_.push_back(frame);
}

bool Outlet::mayAttach() {
    const std::lock_guard lock(mutex_);
    return !ended_ && (reopens_ || !used_);
}

void Outlet::attach(std::shared_ptr<http::WebSocket> socket) {
    std::shared_ptr<http::WebSocket> before;
    {
        const std::lock_guard lock(mutex_);
        before = std::exchange(socket_, std::move(socket));
        used_ = true;
        for (const auto& frame : waiting_)
            socket_->send(frame);
        waiting_.clear();
        if (ended_) socket_->close(http::CloseCode::GoingAway, "the subscription has ended");
    }
    if (before) before->close(http::CloseCode::PolicyViolation, "another socket was opened");
}

bool Outlet::detach() {
    const std::lock_guard lock(mutex_);
    socket_.reset();
    return !reopens_;
}

void Outlet::close() {
    const std::lock_guard lock(mutex_);
    ended_ = true;
    waiting_.clear();
    if (socket_) socket_->close(http::CloseCode::Normal, "the subscription has ended");
}

} // namespace rapidc::rws

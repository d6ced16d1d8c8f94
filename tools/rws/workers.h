#pragma once
// Workers: two threads for what waits for the disk.

#include <condition_variable>
#include <deque>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

namespace rapidc::rws {

class Workers {
  public:
    Workers();
    /// Waits for the work in progress; what has not begun is dropped.
    ~Workers();
    Workers(const Workers&) = delete;
    Workers& operator=(const Workers&) = delete;

    /// False: too much is waiting already.
    bool post(std::function<void()> work);

  private:
    static constexpr std::size_t kMostWaiting = 1000;
    void run();

    std::mutex mutex_;
    std::condition_variable wake_;
    std::deque<std::function<void()>> waiting_;
    bool ends_ = false;
    std::vector<std::thread> threads_;
};

} // namespace rapidc::rws

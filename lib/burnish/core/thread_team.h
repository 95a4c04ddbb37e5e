// Threads of the standard library, side by side, and how many of them may run: what parallel_std.h makes loops of.
//
// They begin with a team's work and end with it. What they share in between is relaxed, so that nothing but the
// members' own doing orders one before another, and a thread sanitizer sees each race between two of them.
#pragma once

#include <algorithm>
#include <atomic>
#include <cstddef>
#include <exception>
#include <mutex>
#include <thread>
#include <vector>

namespace burnish {
namespace detail {

inline std::atomic<int> threads_allowed = 0;  // 0: as many as the machine has
inline std::atomic<int> threads_busy = 1;     // those of teams, and the first

}  // namespace detail

class ThreadLimit {
 public:
  explicit ThreadLimit(int threads) : before_(detail::threads_allowed) {
    if (threads > 0) detail::threads_allowed = before_ > 0 ? std::min(before_, threads) : threads;
  }
  ~ThreadLimit() { detail::threads_allowed = before_; }
  ThreadLimit(const ThreadLimit&) = delete;
  ThreadLimit& operator=(const ThreadLimit&) = delete;

 private:
  int before_;
};

inline int thread_limit() {
  const int allowed = detail::threads_allowed.load(std::memory_order_relaxed);
  return allowed > 0 ? allowed : std::max(1, int(std::thread::hardware_concurrency()));
}

namespace detail {

// The caller and as many further threads as may run by now, `wanted` in all at most.
class Team {
 public:
  explicit Team(std::size_t wanted) {
    const int most = int(std::clamp<std::size_t>(wanted, 1, 4096)) - 1;
    int busy = threads_busy.load(std::memory_order_relaxed);
    do others_ = std::clamp(thread_limit() - busy, 0, most);
    while (!threads_busy.compare_exchange_weak(busy, busy + others_, std::memory_order_relaxed));
  }
  ~Team() { threads_busy.fetch_sub(others_, std::memory_order_relaxed); }
  Team(const Team&) = delete;
  Team& operator=(const Team&) = delete;

  std::size_t size() const { return std::size_t(others_) + 1; }
  bool failed() const { return failed_.load(std::memory_order_relaxed); }

  // member(k) for each k in [0, size), each on a thread of its own, the first on the caller's. Throws what the first of
  // them to fail threw, when all have ended.
  template <typename Member>
  void run(const Member& member) {
    const auto guarded = [&](std::size_t k) {
      try {
        member(k);
      } catch (...) {
        const std::lock_guard lock(error_mutex_);
        if (!error_) error_ = std::current_exception();
        failed_.store(true, std::memory_order_relaxed);
      }
    };
    {
      std::vector<std::jthread> others;
      for (std::size_t k = 1; k < size(); k++) others.emplace_back(guarded, k);
      guarded(0);
    }
    if (error_) std::rethrow_exception(error_);
  }

 private:
  int others_;
  std::atomic<bool> failed_ = false;
  std::mutex error_mutex_;
  std::exception_ptr error_;
};

}  // namespace detail
}  // namespace burnish

// What parallel.h declares, run by std::thread: for the thread sanitizer, to which a oneTBB that was compiled without
// it looks like races everywhere.
#pragma once

#include <atomic>
#include <condition_variable>
#include <cstddef>
#include <mutex>
#include <string>

#include "burnish/core/thread_team.h"

namespace burnish {

inline std::string thread_library() { return "std::thread"; }

template <typename Body>
void parallel_for(std::size_t count, const Body& body) {
  detail::Team team(count);
  std::atomic<std::size_t> next = team.size();
  team.run([&](std::size_t first) {  // an index of its own first: no thread comes too late to take part
    for (std::size_t i = first; i < count && !team.failed(); i = next.fetch_add(1, std::memory_order_relaxed)) body(i);
  });
}

template <typename A, typename B>
void parallel_invoke(const A& a, const B& b) {
  parallel_for(2, [&](std::size_t i) { i == 0 ? a() : b(); });
}

template <typename Produce, typename Work, typename Consume>
void parallel_pipeline(std::size_t in_flight, const Produce& produce, const Work& work, const Consume& consume) {
  std::mutex producer, consumer;
  std::condition_variable consumed;
  std::size_t produced = 0, turn = 0;
  bool ended = false, failed = false;
  const auto pass_one = [&] {
    std::unique_lock producing(producer);
    if (ended) return false;
    ended = true;  // and remains so if the next line throws
    const auto item = produce();
    ended = !item;
    const std::size_t mine = produced++;
    producing.unlock();
    if (!item) return false;
    const auto result = work(item);
    std::unique_lock consuming(consumer);
    consumed.wait(consuming, [&] { return failed || turn == mine; });
    if (failed) return false;
    consume(result);
    turn++;
    consumed.notify_all();
    return true;
  };
  detail::Team(in_flight).run([&](std::size_t) {
    try {
      while (pass_one()) continue;
    } catch (...) {
      const std::lock_guard lock(consumer);
      failed = true;
      consumed.notify_all();
      throw;
    }
  });
}

}  // namespace burnish

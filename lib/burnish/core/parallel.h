// Parallel loops, and the promise that no result depends on how many threads ran them.
//
// Every body writes only what belongs to its own index. What is summed up is summed per chunk, over chunks whose bounds
// depend on the size alone, and then in the order of the chunks.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/version.h>

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace burnish {

// While it lives, at most `threads` run; 0 leaves it to the machine.
class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : control_(tbb::global_control::max_allowed_parallelism,
                 threads > 0 ? std::size_t(threads)
                             : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)) {}

 private:
  tbb::global_control control_;
};

// "2021.8"
inline std::string thread_library_version() {
  return std::to_string(TBB_VERSION_MAJOR) + "." + std::to_string(TBB_VERSION_MINOR);
}

// How many threads may run now; for libraries that keep threads of their own.
inline int thread_limit() {
  return int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

// body(i) for each i in [0, count).
template <typename Body>
void parallel_for(std::size_t count, const Body& body) {
  tbb::parallel_for(std::size_t(0), count, body);
}

// body(begin, end, chunk) over chunks of `grain` indices; the chunks are the same whatever the thread count.
template <typename Body>
void parallel_for_chunks(std::size_t count, std::size_t grain, const Body& body) {
  const std::size_t chunks = (count + grain - 1) / grain;
  tbb::parallel_for(std::size_t(0), chunks,
                    [&](std::size_t c) { body(c * grain, std::min(count, (c + 1) * grain), c); });
}

// Both, side by side where a thread is free.
template <typename A, typename B>
void parallel_invoke(const A& a, const B& b) {
  tbb::parallel_invoke(a, b);
}

// consume(work(produce())) until `produce` gives null: produced one at a time, worked on side by side, consumed one at
// a time in the order they were produced, no more than `in_flight` at once. All of them pass shared pointers.
template <typename Produce, typename Work, typename Consume>
void parallel_pipeline(std::size_t in_flight, const Produce& produce, const Work& work, const Consume& consume) {
  using Item = decltype(produce());
  using Result = decltype(work(produce()));
  tbb::parallel_pipeline(in_flight, tbb::make_filter<void, Item>(tbb::filter_mode::serial_in_order,
                                                                 [&](tbb::flow_control& flow) {
                                                                   Item item = produce();
                                                                   if (!item) flow.stop();
                                                                   return item;
                                                                 }) &
                                        tbb::make_filter<Item, Result>(tbb::filter_mode::parallel, work) &
                                        tbb::make_filter<Result, void>(tbb::filter_mode::serial_in_order, consume));
}

// The sum of body(begin, end) over chunks of `grain` indices, added in their order; T needs +=.
template <typename T, typename Body>
T parallel_sum(std::size_t count, std::size_t grain, const Body& body) {
  std::vector<T> partial((count + grain - 1) / grain);
  parallel_for_chunks(count, grain,
                      [&](std::size_t begin, std::size_t end, std::size_t c) { partial[c] = body(begin, end); });
  T total{};
  for (const T& p : partial) total += p;
  return total;
}

}  // namespace burnish

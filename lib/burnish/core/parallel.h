// Parallel loops, and the promise that no result depends on how many threads ran them.
//
// Every body writes only what belongs to its own index. What is summed up is summed per chunk, over chunks whose bounds
// depend on the size alone, and then in the order of the chunks. Loops may stand within loops. Where a body throws,
// what has not begun is left out, and one of the exceptions comes out of the loop once no body runs any more.
//
// oneTBB runs them, or, with the build option BURNISH_THREADS=std, plain threads, which a thread sanitizer sees
// through.
#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <vector>

namespace burnish {

// ThreadLimit(int threads): while it lives, at most `threads` run; 0 leaves it as it was, at first to the machine.
class ThreadLimit;

// How many threads may run now; for libraries that keep threads of their own.
int thread_limit();

// "oneTBB 2021.8", "std::thread"
std::string thread_library();

// body(i) for each i in [0, count).
template <typename Body>
void parallel_for(std::size_t count, const Body& body);

// Both, side by side where a thread is free.
template <typename A, typename B>
void parallel_invoke(const A& a, const B& b);

// consume(work(produce())) until `produce` gives null: produced one at a time, worked on side by side, consumed one at
// a time in the order they were produced, no more than `in_flight` at once. All of them pass shared pointers.
template <typename Produce, typename Work, typename Consume>
void parallel_pipeline(std::size_t in_flight, const Produce& produce, const Work& work, const Consume& consume);

// body(begin, end, chunk) over chunks of `grain` indices; the chunks are the same whatever the thread count.
template <typename Body>
void parallel_for_chunks(std::size_t count, std::size_t grain, const Body& body) {
  const std::size_t chunks = (count + grain - 1) / grain;
  parallel_for(chunks, [&](std::size_t c) { body(c * grain, std::min(count, (c + 1) * grain), c); });
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

#ifdef BURNISH_STD_THREADS
#include "burnish/core/parallel_std.h"
#else
#include "burnish/core/parallel_tbb.h"
#endif

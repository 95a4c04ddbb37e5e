// What parallel.h declares, run by oneTBB.
#pragma once

#include <tbb/blocked_range.h>
#include <tbb/global_control.h>
#include <tbb/parallel_for.h>
#include <tbb/parallel_invoke.h>
#include <tbb/parallel_pipeline.h>
#include <tbb/version.h>

#include <cstddef>
#include <string>

namespace burnish {

class ThreadLimit {
 public:
  explicit ThreadLimit(int threads)
      : control_(tbb::global_control::max_allowed_parallelism,
                 threads > 0 ? std::size_t(threads)
                             : tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism)) {}

 private:
  tbb::global_control control_;
};

inline int thread_limit() {
  return int(tbb::global_control::active_value(tbb::global_control::max_allowed_parallelism));
}

inline std::string thread_library() {
  return "oneTBB " + std::to_string(TBB_VERSION_MAJOR) + "." + std::to_string(TBB_VERSION_MINOR);
}

template <typename Body>
void parallel_for(std::size_t count, const Body& body) {
  tbb::parallel_for(std::size_t(0), count, body);
}

template <typename A, typename B>
void parallel_invoke(const A& a, const B& b) {
  tbb::parallel_invoke(a, b);
}

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

}  // namespace burnish

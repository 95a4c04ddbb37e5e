// What a kernel's bytes are held against: those of std::memcpy on the same machine, in the same run.
#pragma once

#include <benchmark/benchmark.h>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstring>
#include <vector>

namespace burnish::bench {

// Bytes a second, read and written, of copying 128 MiB, more than caches hold.
inline double memcpy_bandwidth() {
  constexpr std::size_t kBytes = std::size_t(128) << 20;
  static const double bandwidth = [] {
    const std::vector<char> from(kBytes, 1);
    std::vector<char> to(kBytes, 2);
    double best = 0;
    for (int run = 0; run < 9; run++) {
      const auto start = std::chrono::steady_clock::now();
      std::memcpy(to.data(), from.data(), kBytes);
      benchmark::ClobberMemory();
      const std::chrono::duration<double> took = std::chrono::steady_clock::now() - start;
      best = std::max(best, 2.0 * double(kBytes) / took.count());
    }
    return best;
  }();
  return bandwidth;
}

// Of a benchmark whose every iteration reads and writes so many bytes.
inline void report(benchmark::State& state, std::size_t bytes, std::size_t items) {
  state.SetBytesProcessed(std::int64_t(state.iterations()) * std::int64_t(bytes));
  state.SetItemsProcessed(std::int64_t(state.iterations()) * std::int64_t(items));
  state.counters["memcpy"] = memcpy_bandwidth();  // bytes a second
}

}  // namespace burnish::bench

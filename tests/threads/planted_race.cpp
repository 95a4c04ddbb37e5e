// The sum of a few numbers through each kind of parallel loop, soundly, or with a race planted in it that the thread
// sanitizer is to report.
//
//   burnish-planted-race sound|race loop|invoke|pipeline
#include <atomic>
#include <cstdio>
#include <memory>
#include <string>
#include <thread>

#include "burnish/core/parallel.h"

using namespace burnish;

namespace {

double by_loop(bool race) {
  if (!race) return parallel_sum<double>(4, 1, [](std::size_t i, std::size_t) { return double(2 * i); });
  double sum = 0;
  parallel_for(4, [&](std::size_t i) { sum += double(2 * i); });
  return sum;
}

double by_invoke(bool race) {
  double a = 0, b = 0;
  parallel_invoke([&] { a += 5; }, [&] { (race ? a : b) += 7; });
  return a + b;
}

double by_pipeline(bool race) {
  double sum = 0, next = 5;
  std::atomic<int> at_work = 0;
  using Number = std::shared_ptr<double>;
  parallel_pipeline(
      2, [&] { return next <= 7 ? std::make_shared<double>((next += 2) - 2) : nullptr; },
      [&](const Number& number) {
        at_work.fetch_add(1, std::memory_order_relaxed);  // the first waits for the second, and orders nothing by it
        while (at_work.load(std::memory_order_relaxed) < 2) std::this_thread::yield();
        if (race) sum += *number;
        return number;
      },
      [&](const Number& number) {
        if (!race) sum += *number;
      });
  return sum;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) return 2;
  const ThreadLimit limit(2);
  const bool race = argv[1] == std::string("race");
  const std::string loop = argv[2];
  const double sum = loop == "loop" ? by_loop(race) : loop == "invoke" ? by_invoke(race) : by_pipeline(race);
  std::printf("%g\n", sum);
  return sum == 12 ? 0 : 1;
}

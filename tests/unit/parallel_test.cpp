#include "burnish/core/parallel.h"

#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <cstring>
#include <memory>
#include <stdexcept>
#include <thread>

namespace burnish {
namespace {

// Values of very different magnitude, so that any other order of adding gives other bits.
double term(std::size_t i) { return std::sin(double(i) * 12.9898) * std::pow(10.0, double(i % 17) - 8); }

double sum_with(int threads, std::size_t count, std::size_t grain) {
  const ThreadLimit limit(threads);
  return parallel_sum<double>(count, grain, [](std::size_t begin, std::size_t end) {
    double s = 0;
    for (std::size_t i = begin; i < end; i++) s += term(i);
    return s;
  });
}

TEST(Parallel, SumHasTheSameBitsForAnyThreadCount) {
  for (const std::size_t count :
       {std::size_t(0), std::size_t(1), std::size_t(999), std::size_t(1000), std::size_t(123457)}) {
    const double one = sum_with(1, count, 1000);
    for (int threads : {2, 8, 0})
      for (int repeat = 0; repeat < 5; repeat++) {
        const double many = sum_with(threads, count, 1000);
        EXPECT_EQ(std::memcmp(&one, &many, sizeof one), 0) << count << " terms, " << threads << " threads";
      }
  }
}

TEST(Parallel, ChunksCoverEachIndexOnce) {
  for (const std::size_t count :
       {std::size_t(0), std::size_t(1), std::size_t(64), std::size_t(65), std::size_t(1000)}) {
    std::vector<int> seen(count);
    parallel_for_chunks(count, 64, [&](std::size_t begin, std::size_t end, std::size_t chunk) {
      EXPECT_EQ(begin, chunk * 64);
      EXPECT_LE(end, count);
      for (std::size_t i = begin; i < end; i++) seen[i]++;
    });
    for (std::size_t i = 0; i < count; i++) EXPECT_EQ(seen[i], 1) << "index " << i << " of " << count;
  }
}

TEST(Parallel, LimitEndsWithItsScope) {
  const int before = thread_limit();
  {
    const ThreadLimit limit(1);
    EXPECT_EQ(thread_limit(), 1);
  }
  EXPECT_EQ(thread_limit(), before);
}

TEST(Parallel, LimitWithinALimitOnlyLowersIt) {
  const ThreadLimit outer(2);
  {
    const ThreadLimit more(8);
    EXPECT_EQ(thread_limit(), 2);
    const ThreadLimit less(1);
    EXPECT_EQ(thread_limit(), 1);
    const ThreadLimit same(0);
    EXPECT_EQ(thread_limit(), 1);
  }
  EXPECT_EQ(thread_limit(), 2);
}

// How many run at the same time, and the most that ever did.
class Crowd {
 public:
  void pass() {
    int most = most_, now = ++now_;
    while (most < now && !most_.compare_exchange_weak(most, now)) continue;
    std::this_thread::sleep_for(std::chrono::microseconds(200));
    now_--;
  }
  int most() const { return most_; }

 private:
  std::atomic<int> now_ = 0, most_ = 0;
};

TEST(Parallel, LoopsWithinLoopsRunAllOfThemWithinTheLimit) {
  for (const int threads : {1, 2, 3}) {
    const ThreadLimit limit(threads);
    Crowd crowd;
    std::vector<int> seen(6 * 8);
    parallel_for(6, [&](std::size_t i) {
      parallel_invoke(
          [&] {
            parallel_for(4, [&](std::size_t k) {
              crowd.pass();
              seen[8 * i + k]++;
            });
          },
          [&] {
            for (std::size_t k = 4; k < 8; k++) seen[8 * i + k]++;
          });
    });
    EXPECT_EQ(seen, std::vector<int>(6 * 8, 1)) << threads << " threads";
    EXPECT_LE(crowd.most(), threads);
  }
}

TEST(Parallel, PipelineConsumesInOrderNoMoreThanItMayHold) {
  for (const int threads : {1, 2, 8})
    for (const std::size_t in_flight : {1, 3}) {
      const ThreadLimit limit(threads);
      std::size_t produced = 0;
      std::atomic<std::size_t> held = 0, most = 0;
      std::vector<std::size_t> consumed;
      parallel_pipeline(
          in_flight,
          [&] {
            if (produced == 50) return std::shared_ptr<std::size_t>();
            most = std::max<std::size_t>(most, ++held);
            return std::make_shared<std::size_t>(produced++);
          },
          [](const std::shared_ptr<std::size_t>& item) {
            std::this_thread::sleep_for(std::chrono::microseconds(*item * 7 % 5 * 100));  // later ones overtake
            return std::make_shared<std::size_t>(*item * *item);
          },
          [&](const std::shared_ptr<std::size_t>& result) {
            held--;
            consumed.push_back(*result);
          });
      ASSERT_EQ(consumed.size(), 50u) << threads << " threads";
      for (std::size_t i = 0; i < consumed.size(); i++) EXPECT_EQ(consumed[i], i * i) << threads << " threads";
      EXPECT_LE(most, in_flight) << threads << " threads";
    }
}

void fail(bool here) {
  if (here) throw std::runtime_error("planted");
}

// Whichever stage throws at the seventh of a hundred, all comes to an end, and little is begun after it.
TEST(Parallel, ExceptionsComeOutOfLoops) {
  for (const int threads : {1, 2, 8}) {
    const ThreadLimit limit(threads);
    EXPECT_THROW(parallel_for(100, [](std::size_t i) { fail(i == 7); }), std::runtime_error);
    EXPECT_THROW(parallel_for(100, [](std::size_t) { fail(true); }), std::runtime_error);
    EXPECT_THROW(parallel_for(3, [](std::size_t) { parallel_for(3, [](std::size_t i) { fail(i == 2); }); }),
                 std::runtime_error);
    EXPECT_THROW(parallel_invoke([] { fail(true); }, [] {}), std::runtime_error);
    EXPECT_THROW(parallel_invoke([] {}, [] { fail(true); }), std::runtime_error);
    for (const int stage : {0, 1, 2}) {
      int produced = 0, consumed = 0;
      const auto run = [&] {
        parallel_pipeline(
            3,
            [&] {
              fail(stage == 0 && produced == 7);
              return produced < 100 ? std::make_shared<int>(produced++) : nullptr;
            },
            [&](const std::shared_ptr<int>& item) {
              fail(stage == 1 && *item == 7);
              return item;
            },
            [&](const std::shared_ptr<int>& item) {
              fail(stage == 2 && *item == 7);
              EXPECT_EQ(*item, consumed++);
            });
      };
      EXPECT_THROW(run(), std::runtime_error) << "stage " << stage << ", " << threads << " threads";
      EXPECT_LE(consumed, 7) << "stage " << stage << ", " << threads << " threads";
      EXPECT_LE(produced, 10) << "stage " << stage << ", " << threads << " threads";
    }
  }
  EXPECT_EQ(sum_with(8, 12345, 100), sum_with(1, 12345, 100));  // and loops run as before
}

}  // namespace
}  // namespace burnish

// The same thing, made with any number of threads.
#pragma once

#include <gtest/gtest.h>

#include "burnish/core/parallel.h"

namespace burnish {

// What `make` makes while `threads` may run.
template <typename Make>
auto on_threads(int threads, const Make& make) {
  const ThreadLimit limit(threads);
  EXPECT_EQ(thread_limit(), threads);
  return make();
}

}  // namespace burnish

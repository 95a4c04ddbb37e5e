// EXPECT_ERROR(statement, kind, "part of the message")
#pragma once

#include <gtest/gtest.h>

#include "burnish/core/error.h"

#define EXPECT_ERROR(statement, expected_kind, part)                                                    \
  do {                                                                                                  \
    try {                                                                                               \
      statement;                                                                                        \
      ADD_FAILURE() << "no error from " #statement;                                                     \
    } catch (const ::burnish::Error& e) {                                                               \
      EXPECT_EQ(int(e.kind()), int(expected_kind)) << e.what();                                         \
      EXPECT_NE(std::string(e.what()).find(part), std::string::npos) << "the message is: " << e.what(); \
      EXPECT_EQ(std::string(e.what()).find('\n'), std::string::npos) << "more than one line";           \
    }                                                                                                   \
  } while (false)

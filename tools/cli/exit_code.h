// The exit codes, the same for every tool; the manual's text is beside each.
#pragma once

#include "burnish/core/error.h"

namespace burnish::cli {

enum ExitCode {
  kOk = 0,
  kUsage = 1,        // an option or argument is wrong
  kIo = 2,           // a file cannot be read or written
  kMalformed = 3,    // input is malformed or does not fit (sizes differ, NaN, wrong channels)
  kInternal = 4,     // a fault of the tool
  kUnsupported = 5,  // not supported
  kThreshold = 10,   // a check or threshold was not met
};

inline ExitCode exit_code(ErrorKind kind) {
  switch (kind) {
    case ErrorKind::kUsage:
      return kUsage;
    case ErrorKind::kIo:
      return kIo;
    case ErrorKind::kMalformed:
      return kMalformed;
    case ErrorKind::kUnsupported:
      return kUnsupported;
    case ErrorKind::kThreshold:
      return kThreshold;
    case ErrorKind::kInternal:
      break;
  }
  return kInternal;
}

}  // namespace burnish::cli

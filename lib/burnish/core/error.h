// The one exception the library throws: what went wrong, and of which kind.
//
// A message names the file, what was expected and what was found, on one line:
//   'm.png': expected 1 channel, got 3
// Where no file is at fault it begins with the name of what was asked for, which a tool shows as its option:
//   levels: expected 1 to 7 for 64x48 texels, got 9
// Callers above the library turn the kind into an exit code; nothing in the library knows of those.
#pragma once

#include <algorithm>
#include <cctype>
#include <stdexcept>
#include <string>

namespace burnish {

enum class ErrorKind {
  kUsage,        // an option or argument that makes no sense
  kIo,           // a file cannot be read or written
  kMalformed,    // input is damaged or does not fit: sizes differ, NaN, wrong channels
  kInternal,     // a fault of ours
  kUnsupported,  // well-formed, and not provided
  kThreshold,    // a check or threshold was not met
};

class Error : public std::runtime_error {
 public:
  Error(ErrorKind kind, const std::string& message) : std::runtime_error(message), kind_(kind) {}
  ErrorKind kind() const { return kind_; }

 private:
  ErrorKind kind_;
};

// How standard input and output are called where a file's name would stand.
inline const std::string kStandardInput = "standard input";
inline const std::string kStandardOutput = "standard output";

// 'name': message
inline Error file_error(ErrorKind kind, const std::string& name, const std::string& message) {
  const bool stream = name == kStandardInput || name == kStandardOutput;
  return Error(kind, (stream ? name : "'" + name + "'") + ": " + message);
}

// Text of a file as a message shows it: the start, without control characters.
inline std::string excerpt(std::string text) {
  text.resize(std::min<std::size_t>(text.size(), 32));
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return std::iscntrl(c); }, '?');
  return text;
}

}  // namespace burnish

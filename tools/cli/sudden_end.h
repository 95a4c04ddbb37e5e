// How a tool ends in the middle of its work, where nothing is caught any more: its temporaries go first.
#pragma once

#include <exception>
#include <string>

namespace burnish::cli {

// From here on
//   SIGINT, SIGTERM, SIGHUP and their like end the tool as they would, unless it was started with them ignored;
//   SIGSEGV, SIGBUS and other faults too, with one line;
//   an exception that nothing catches, as in a codec's own thread that finds no memory, ends it with kInternal and one
//   line.
// Lines go to that file descriptor, which stays open.
void end_cleanly(const std::string& tool, int messages);

// What it says, in words for users where the standard library's are not.
const char* message_of(const std::exception& error);

}  // namespace burnish::cli

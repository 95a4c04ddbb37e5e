// What a tool says of itself for man and for shells, from the same options as its --help.
#pragma once

#include <CLI/CLI.hpp>
#include <string>

namespace burnish::cli {

struct ToolText;

// A page of section 1 in man's macros.
std::string man_page(const CLI::App& app, const ToolText& text, const std::string& version);

// A script that completes the tool's options, their words, and file names. kUsage for a shell but bash and zsh.
std::string completion(const CLI::App& app, const std::string& shell);

}  // namespace burnish::cli

#pragma once
#include <string>

#include <CLI/CLI.hpp>

namespace nacre {

// What a shell and man(1) show, made from the tree of commands and options, so that it cannot differ from --help.
std::string bashCompletion(const CLI::App& app);
std::string manPage(const CLI::App& app, const std::string& version);

} // namespace nacre

// The frame of a program that is not the tool: --help, and whatever is wrong in one line with exit 2.
#pragma once

#include <functional>
#include <optional>
#include <string>

namespace CLI {
class App;
}

/// Prints the one line; returns 2.
int refuse(const CLI::App& app, std::string what);

/// The exit code if the command line says all there is to do, or is wrong. Before MPI begins.
std::optional<int> parse(CLI::App& app, int argc, char** argv);

/// Runs `work` under MPI; returns the program's exit code.
int run_under_mpi(const CLI::App& app, int argc, char** argv, const std::function<void()>& work);

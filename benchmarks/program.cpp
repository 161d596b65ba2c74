#include "program.hpp"

#include <fmt/format.h>
#include <mpi.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdio>
#include <exception>

int refuse(const CLI::App& app, std::string what) {
  std::replace(what.begin(), what.end(), '\n', ' ');
  fmt::print(stderr, "{}: error: {}\n", app.get_name(), what);
  return 2;
}

std::optional<int> parse(CLI::App& app, int argc, char** argv) {
  try {
    app.parse(argc, argv);
  } catch (const CLI::Success& success) {
    return app.exit(success);
  } catch (const CLI::ParseError& error) {
    return refuse(app, std::string(error.what()) + " (see --help)");
  }
  return std::nullopt;
}

int run_under_mpi(const CLI::App& app, int argc, char** argv, const std::function<void()>& work) {
  MPI_Init(&argc, &argv);
  int code = 0;
  try {
    work();
  } catch (const std::exception& error) {
    code = refuse(app, error.what());
  }
  MPI_Finalize();
  return code;
}

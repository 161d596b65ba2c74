#include "sph/run/command_line.hpp"

#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <functional>
#include <limits>

#include "decomp/memory.hpp"
#include "keys/reference.hpp"
#include "keys/units.hpp"
#include "sph/files/provenance.hpp"
#include "sph/inspect/inspect.hpp"
#include "sph/output/snapshot.hpp"
#include "sph/run/report.hpp"
#include "sph/run/run.hpp"
#include "sph/run/self_check.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;

/// MPI from here to the end of the program; signals are caught before it begins.
class Mpi {
 public:
  Mpi(int argc, char** argv) {
    install_signal_handlers();
    MPI_Init(&argc, &argv);
  }
  ~Mpi() { MPI_Finalize(); }
  Mpi(const Mpi&) = delete;
  Mpi& operator=(const Mpi&) = delete;
};

std::int64_t steps_of(const std::string& text) {
  std::int64_t steps = 0;
  const char* end = text.data() + text.size();
  const auto [stop, error] = std::from_chars(text.data(), end, steps);
  if (error != std::errc() || stop != end || steps < 0)
    throw InputError(
        fmt::format("--steps: \"{}\" is not a number of steps; write a whole number from 0 to {}", text,
                    std::numeric_limits<std::int64_t>::max()));
  return steps;
}

/// A time of the scene as --set time.until takes it, a number or "5 ms".
double until_of(const std::string& text) {
  const Quantity time = parse_quantity(text);
  const bool seconds = !time.has_unit || time.dim == dimension::time;
  if (!time.problem.empty() || !seconds || !std::isfinite(time.value) || time.value < 0)
    throw InputError(
        fmt::format("--until: \"{}\" is not a time; write seconds from 0, or a time like \"5 ms\"", text));
  return time.value;
}

/// "H:M:S", "M:S" or "S" in seconds.
double seconds_of(const std::string& text) {
  double seconds = 0;
  int parts = 0;
  const char* at = text.data();
  const char* end = at + text.size();
  for (;; ++at) {
    double part = 0;
    const auto [stop, error] = std::from_chars(at, end, part, std::chars_format::fixed);
    const bool good = error == std::errc() && part >= 0 && std::isfinite(part) && ++parts <= 3;
    if (!good || (stop != end && *stop != ':'))
      throw InputError("--max-time: \"" + text + "\" is not a time; write hours:minutes:seconds");
    seconds = 60 * seconds + part;
    at = stop;
    if (at == end) return seconds;
  }
}

/// Options of everything that runs.
struct Arguments {
  RunOptions run;
  std::string first, second;

  void add_scene(CLI::App& app, bool required) {
    app.add_option("case", run.scene, "the scene, a TOML file")->required(required)->type_name("FILE");
    add_set(app, "override a key of the scene: --set time.dt=1e-4");
    add_end(app);
  }
  void add_set(CLI::App& app, const std::string& what) {
    app.add_option("--set", run.overrides, what)->type_name("KEY=VALUE")->allow_extra_args(false);
  }
  void add_end(CLI::App& app) {
    auto* steps = add_text(app, "--steps", "end after this many steps, counted from 0", "N",
                           [this](const std::string& text) { run.end.steps = steps_of(text); });
    auto* until = add_text(app, "--until", "end at the first step with t >= T [s]", "T",
                           [this](const std::string& text) { run.end.until = until_of(text); });
    steps->excludes(until);
  }
  void add_out(CLI::App& app) {
    add_text(app, "--out", "directory of the output, default out/<case>", "DIR",
             [this](const std::string& text) {
               if (text.empty()) throw InputError("--out: is empty; name a directory");
               run.out = text;
             });
  }
  void add_resume(CLI::App& app) {
    add_text(app, "dir", "the directory of the run", "DIR", [this](const std::string& text) {
      if (text.empty()) throw InputError("dir: is empty; name the directory of a run");
      run.resume = text;
    })->required();
  }
  void add_branch(CLI::App& app) {
    add_text(app, "--branch", "begin another run in this directory with the state of the last checkpoint",
             "DIR", [this](const std::string& text) {
               if (text.empty()) throw InputError("--branch: is empty; name a directory");
               run.branch = text;
             });
  }
  void add_max_time(CLI::App& app) {
    add_text(app, "--max-time", "checkpoint, stop and exit 75 before so much wall time", "H:M:S",
             [this](const std::string& text) { run.max_seconds = seconds_of(text); });
  }

 private:
  /// The library's own conversions take an empty text for none and a number too large for another.
  static CLI::Option* add_text(CLI::App& app, const std::string& name, const std::string& what,
                               const std::string& type, const std::function<void(const std::string&)>& take) {
    return app.add_option_function<std::string>(name, take, what)->type_name(type);
  }
};

using Reference = std::string();

/// Ways to print the keys of a scene; without any of them `reference` stays as it is.
void add_forms(CLI::App& app, Reference*& reference) {
  CLI::App& forms = *app.add_option_group("form");
  forms.require_option(0, 1);
  const auto add = [&](const char* name, const char* what, Reference* form) {
    forms.add_flag_callback(
        name, [&reference, form] { reference = form; }, what);
  };
  add("--markdown", "as tables (apps/keys.md)", keys::reference_markdown);
  add("--toml", "as a scene with all keys commented out", keys::reference_toml);
  add("--json-schema", "for editors (apps/scene.schema.json)", keys::reference_json_schema);
}

/// The exit code if the command line says all there is to do (--help, --version); throws InputError if it is
/// wrong.
std::optional<int> parse(CLI::App& app, int argc, char** argv, const decomp::Comm& comm) {
  try {
    app.parse(argc, argv);
    return std::nullopt;
  } catch (const CLI::Success& success) {
    if (comm.rank() == 0) app.exit(success);
    return exit_done;
  } catch (const CLI::ParseError& error) {
    throw InputError(std::string(error.what()) + " (see --help)");
  }
}

std::string version_text() {
  const BuildInfo& b = build_info();
  return fmt::format(
      "peperite {}\ngit      {}\ncompiler {}\nflags    {}\nbuild    {}\nMPI      {}\nHDF5     {}", b.version,
      b.git, b.compiler, b.flags, b.build_type, b.mpi, b.hdf5);
}

std::string case_file(const std::string& asked, const Application& application) {
  const std::string name = asked.empty() ? application.default_case : asked;
  std::error_code none;
  if (!asked.empty() && (fs::exists(name, none) || fs::path(name).has_parent_path())) return name;
  for (const fs::path& folder : application.case_folders)
    if (fs::exists(folder / name, none)) return (folder / name).string();
  return name;
}

template <class Work>
int run_program(int argc, char** argv, Work&& work) {
  decomp::return_freed_memory();
  const Mpi mpi(argc, argv);
  const decomp::Comm comm(MPI_COMM_WORLD);
  Failure failure(comm);
  return failure.guard([&] {
    self_check();
    return work(comm, failure);
  });
}

/// The serial subcommands: one rank does the work, all return its exit code.
template <class Work>
int on_one_rank(const decomp::Comm& comm, Work&& work) {
  if (comm.rank() != 0) return exit_done;
  return work();
}

}  // namespace

fs::path program_folder() {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  return error ? fs::path() : program.parent_path();
}

int application_main(int argc, char** argv, const Application& application) {
  return run_program(argc, argv, [&](const decomp::Comm& comm, Failure& failure) {
    CLI::App app(application.description, application.name);
    app.set_version_flag("--version", version_text());
    Arguments arguments;
    arguments.add_scene(app, false);
    arguments.add_out(app);
    arguments.add_max_time(app);
    if (const auto code = parse(app, argc, argv, comm)) return *code;
    RunOptions options = arguments.run;
    options.scene = case_file(options.scene, application);
    return run_case(options, comm, failure);
  });
}

int tool_main(int argc, char** argv) {
  return run_program(argc, argv, [&](const decomp::Comm& comm, Failure& failure) {
    CLI::App app("Particle simulations with the same bits on any number of ranks", "peperite");
    app.set_version_flag("--version", version_text());
    app.require_subcommand(1);
    app.footer(
        "By Python: plot DIR draws a run, report DIR makes a page of it, export DIR writes it for ParaView "
        "and OVITO, sweep varies keys (--help).");
    Arguments arguments;
    CLI::App& run = *app.add_subcommand("run", "run a scene");
    arguments.add_scene(run, true);
    arguments.add_out(run);
    arguments.add_max_time(run);
    CLI::App& check = *app.add_subcommand("check", "validate a scene and say what running it costs");
    arguments.add_scene(check, true);
    check.add_flag("--plan", arguments.run.plan,
                   "print the stages of a step: what they read, send and write");
    CLI::App& resume = *app.add_subcommand("resume", "go on from the last checkpoint of a run");
    arguments.add_resume(resume);
    arguments.add_set(resume,
                      "change when files are written, or how the domain is cut: --set "
                      "output.snapshot_interval=0.1; of a branch "
                      "also constants of laws");
    arguments.add_branch(resume);
    arguments.add_end(resume);
    arguments.add_max_time(resume);
    CLI::App& info = *app.add_subcommand("info", "describe a snapshot or a checkpoint");
    info.add_option("file", arguments.first, "snapshot, checkpoint or run directory")->required();
    CLI::App& diff = *app.add_subcommand("diff", "compare two states bit by bit; exits 1 if they differ");
    diff.add_option("a", arguments.first, "snapshot, checkpoint or run directory")->required();
    diff.add_option("b", arguments.second, "another")->required();
    CLI::App& explain = *app.add_subcommand("keys", "explain every key of a scene");
    Reference* reference = keys::reference_text;
    add_forms(explain, reference);
    if (const auto code = parse(app, argc, argv, comm)) return *code;

    if (!run.parsed() && !resume.parsed()) restore_signal_handlers();
    if (check.parsed()) return check_case(arguments.run, comm);
    if (explain.parsed())
      return on_one_rank(comm, [&] {
        fmt::print("{}", reference());
        return exit_done;
      });
    if (info.parsed())
      return on_one_rank(comm, [&] {
        fmt::print("{}\n", describe(arguments.first));
        return exit_done;
      });
    if (diff.parsed())
      return on_one_rank(comm, [&] {
        const std::string difference = first_difference(arguments.first, arguments.second);
        if (difference.empty()) return exit_done;
        fmt::print("{}\n", difference);
        return exit_differ;
      });
    return run_case(arguments.run, comm, failure);
  });
}

}  // namespace sph

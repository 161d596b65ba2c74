// The equivalence matrix: the same bits on any number of ranks, whatever the cuts, the messages, the order of
// arrival, the lists and the restarts. One MPI program on 8 ranks; a row on k ranks uses the first k, the
// others sleep. Every row's fingerprints are compared with those of the scene's run on one rank.
//
//   equivalence --array SEED [--scenes START]   a covering array of the factors (covering_array.hpp); with --part
//                                               i/n of every n-th scene
//   equivalence --full --part i/n --log FILE    every row in random order; those in FILE are not run again
//   equivalence --row "scene=... ranks=..."     one row, as printed
//
// Options: --help. The last line is "N passed, M failed"; exit status 1 if any failed.
#include <mpi.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <fstream>
#include <set>
#include <stdexcept>

#include "covering_array.hpp"
#include "first_ranks.hpp"
#include "matrix_case.hpp"

namespace {

namespace fs = std::filesystem;
using namespace equivalence;

struct Options {
  enum class Mode { array, full, row } mode = Mode::array;
  Family family = Family::sph;
  std::uint64_t seed = 1;
  std::int64_t steps = 300, long_steps = 1000;
  bool every = false;
  Strength strength = Strength::mixed;
  std::string row, log, scenes;
  std::size_t part = 1, parts = 1;
  double limit = 1e9;  ///< [s]
  bool help = false;
};

constexpr const char* usage =
    "equivalence: the same bits on any number of ranks. On 8 ranks:\n"
    "  --array SEED [--scenes START]   a covering array of the factors; of scenes whose names start so\n"
    "  --array SEED --part i/n         the same, of every n-th scene\n"
    "  --full --part i/n --log FILE    every row in random order; those in FILE are not run again\n"
    "  --row \"scene=... ranks=...\"     one row, as printed\n"
    "  --grains | --sph                scenes of which, default: sph\n"
    "  --seed S                        of the order, the cuts and the restarts, default: 1\n"
    "  --steps N, --long N             the last step that is compared, of an array's first row of each\n"
    "                                  scene: 300, 1000\n"
    "  --every-triple                  the array has every 3-way combination: 1375 rows instead of 495\n"
    "  --every                         compare at every step\n"
    "  --limit SECONDS                 start no row after that long";

/// Reads all of the text as a number, or says which option wants one.
template <class T>
T number(const std::string& key, const std::string& text) {
  T value{};
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size())
    throw std::runtime_error(key + " wants a number, not \"" + text + "\"");
  return value;
}

Options parse(int argc, char** argv) {
  Options o;
  for (int k = 1; k < argc; ++k) {
    const std::string key = argv[k];
    const auto value = [&]() -> std::string {
      if (++k == argc) throw std::runtime_error(key + " wants a value");
      return argv[k];
    };
    if (key == "--help" || key == "-h")
      o.help = true;
    else if (key == "--array")
      o.seed = number<std::uint64_t>(key, value());
    else if (key == "--full")
      o.mode = Options::Mode::full;
    else if (key == "--grains")
      o.family = Family::grains;
    else if (key == "--sph")
      o.family = Family::sph;
    else if (key == "--row")
      o.mode = Options::Mode::row, o.row = value();
    else if (key == "--seed")
      o.seed = number<std::uint64_t>(key, value());
    else if (key == "--steps")
      o.steps = number<std::int64_t>(key, value());
    else if (key == "--long")
      o.long_steps = number<std::int64_t>(key, value());
    else if (key == "--every-triple")
      o.strength = Strength::three;
    else if (key == "--every")
      o.every = true;
    else if (key == "--log")
      o.log = value();
    else if (key == "--scenes")
      o.scenes = value();
    else if (key == "--limit")
      o.limit = number<double>(key, value());
    else if (key == "--part") {
      if (std::sscanf(value().c_str(), "%zu/%zu", &o.part, &o.parts) != 2 || o.part < 1 || o.part > o.parts)
        throw std::runtime_error("--part wants i/n with 1 <= i <= n");
    } else
      throw std::runtime_error("unknown option " + key);
  }
  if (o.steps < 1) throw std::runtime_error("--steps must be at least 1");
  return o;
}

std::vector<Row> rows_of(const Options& o) {
  if (o.mode == Options::Mode::row) return {row_from_text(o.row)};
  if (o.mode == Options::Mode::array) {
    std::vector<Row> rows = covering_array(o.family, o.seed, o.strength);
    if (const std::size_t missing = uncovered_triples(o.family, rows, o.strength); missing > 0)
      throw std::runtime_error(std::to_string(missing) + " combinations are not covered");
    std::erase_if(rows, [&](const Row& row) {
      const std::size_t scene = row.level[static_cast<std::size_t>(Factor::scene)];
      return scene % o.parts != o.part - 1 || !row[Factor::scene].starts_with(o.scenes);
    });
    return rows;
  }
  std::vector<Row> rows = full_product(o.family);
  shuffle(rows, o.seed);
  std::vector<Row> mine;
  for (std::size_t k = o.part - 1; k < rows.size(); k += o.parts) mine.push_back(rows[k]);
  return mine;
}

/// The rows with the steps at which they are compared. In an array each scene has one long row, its first.
std::vector<Case> cases_of(const Options& o) {
  std::vector<Case> cases;
  std::set<std::string_view> seen;
  for (const Row& row : rows_of(o)) {
    const bool longer = seen.insert(row[Factor::scene]).second && o.mode == Options::Mode::array;
    const std::int64_t last = longer ? std::max(o.steps, o.long_steps) : o.steps;
    Case c{row, {}};
    for (std::int64_t s = 1; s <= last; ++s)
      if (o.every || s == 1 || s == 100 || s == 300 || s == 3000 || s == last) c.steps.push_back(s);
    cases.push_back(std::move(c));
  }
  return cases;
}

std::string steps_text(std::int64_t steps) { return ", " + std::to_string(steps) + " steps,"; }

/// Rows that earlier runs have found good over as many steps: lines "ok <row> | ..., N steps, ...".
std::set<std::string> passed_before(const std::string& log, std::int64_t steps) {
  std::set<std::string> rows;
  std::ifstream in(log);
  for (std::string line; std::getline(in, line);)
    if (line.starts_with("ok ") && line.find(steps_text(steps)) != std::string::npos)
      rows.insert(line.substr(3, line.find(" |") - 3));
  return rows;
}

class Matrix {
 public:
  Matrix(const decomp::Comm& world, const Options& options)
      : world_(world),
        options_(options),
        comms_(world),
        scratch_(world, "equivalence"),
        cases_(options.seed, scratch_.path()) {
    if (world.rank() != 0 || options.log.empty()) return;
    done_ = passed_before(options.log, options.steps);
    log_.open(options.log, std::ios::app);
    if (!log_) throw std::runtime_error("cannot write " + options.log);
  }

  /// The number of rows that failed, on rank 0.
  int run(const std::vector<Case>& cases) {
    if (world_.rank() == 0)
      std::printf("%zu rows, seed %llu\n", cases.size(), static_cast<unsigned long long>(options_.seed));
    for (const Case& c : cases) {
      const bool wanted = world_.rank() == 0 && !done_.contains(to_text(c.row));
      const bool late = world_.rank() == 0 && seconds() > options_.limit;
      const std::int64_t go = world_.max(std::int64_t{late ? 2 : wanted ? 1 : 0});
      if (go == 2) break;
      if (go != 1) continue;
      try {
        run(c);
      } catch (const std::exception& error) {
        throw std::runtime_error(to_text(c.row) + ": " + error.what());
      }
    }
    if (world_.rank() == 0) std::printf("%d passed, %d failed\n", passed_, failed_);
    return failed_;
  }

 private:
  [[nodiscard]] double seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  }

  void run(const Case& c) {
    const bool first = world_.rank() == 0;
    if (first) cases_.prepare(*comms_.first(1), c);
    sleep_until_all_are_here(world_.get());
    const double begin = seconds();
    Outcome total;
    std::string route;
    for (const Leg& leg : legs_of(c, options_.seed)) {
      if (world_.rank() < leg.ranks && total.mismatch.empty()) {
        const Outcome outcome = cases_.run(*comms_.first(leg.ranks), c, leg);
        total = {outcome.mismatch, total.rebuilds + outcome.rebuilds};
      }
      route += (leg.from > 0 ? " -" + std::to_string(leg.from) + "-> " : "") + std::to_string(leg.ranks);
      sleep_until_all_are_here(world_.get());
      if (world_.max(std::int64_t{!total.mismatch.empty()}) > 0) break;
    }
    if (first) report(c, total, route, seconds() - begin);
    sleep_until_all_are_here(world_.get());
  }

  void report(const Case& c, const Outcome& outcome, const std::string& route, double time) {
    const bool good = outcome.mismatch.empty();
    ++(good ? passed_ : failed_);
    char line[400];
    std::snprintf(line, sizeof line, "%s %s | %s ranks%s seed %llu, %lld rebuilds, %.2f s",
                  good ? "ok" : "FAILED", to_text(c.row).c_str(), route.c_str(),
                  steps_text(c.steps.back()).c_str(), static_cast<unsigned long long>(options_.seed),
                  static_cast<long long>(outcome.rebuilds), time);
    std::printf("%s\n", line);
    if (!good)
      std::printf("       %s: %s\n", outcome.mismatch.c_str(),
                  cases_.explain(*comms_.first(1), c.row).c_str());
    std::fflush(stdout);
    if (log_.is_open()) log_ << line << std::endl;
  }

  const decomp::Comm& world_;
  Options options_;
  SubComms comms_;
  Scratch scratch_;
  Cases cases_;
  std::set<std::string> done_;
  std::ofstream log_;
  int passed_ = 0, failed_ = 0;
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace

int main(int argc, char** argv) {
  Options options;
  try {
    options = parse(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "equivalence: error: %s (see --help)\n", error.what());
    return 2;
  }
  if (options.help) {
    std::puts(usage);
    return 0;
  }
  MPI_Init(&argc, &argv);
  int failed = 0;
  try {
    const decomp::Comm world(MPI_COMM_WORLD);
    if (world.size() != most_ranks) {
      if (world.rank() == 0)
        std::fprintf(stderr, "equivalence: error: runs on 8 ranks, not %d\n", world.size());
      MPI_Finalize();
      return 2;
    }
    failed = Matrix(world, options).run(cases_of(options));
  } catch (const std::exception& error) {
    // A rank that has given up cannot tell the others, who wait for it.
    std::fprintf(stderr, "equivalence: %s\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
  return failed == 0 ? 0 : 1;
}

// The screen and the final report: a short banner, one status line an interval, the table at the end and the
// same numbers in perf.json. Nothing else goes to stdout but the fingerprint line, last.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "decomp/balancer.hpp"
#include "decomp/comm.hpp"
#include "decomp/timer.hpp"
#include "sph/core/particles.hpp"

namespace sph {

struct Status {
  GlobalState global;
  double particle_steps_per_second = 0;
  double imbalance = 1;       ///< max / mean of computation time
  double kinetic_energy = 0;  ///< [J]
  double seconds_left = 0;    ///< wall; negative: unknown
};
/// "step 12000  t 1.234 s  dt 1.0e-4  1.9e7 upd/s  imb 1.07  Ekin 3.21e+02 J  left 0:42:10"
[[nodiscard]] std::string status_line(const Status& status);

/// The cells that ranks share out, and who had which at the end: enough to say whose a position was.
struct CellLayout {
  std::array<double, 3> origin{}, edge{};  ///< [m]; the last cell of an axis takes the rest of the domain
  std::array<std::int64_t, 3> cells{};
  std::array<bool, 3> periodic{};
  std::array<int, 2> cut_axes{};  ///< rows, columns
  std::string cuts;               ///< decomp::to_text
};

struct RunLabel {
  std::string scene, fingerprint, precision, formulation;
};

/// The steps of this run and the time that they took.
struct RunLoop {
  int ranks = 1;
  std::int64_t steps = 0, particles = 0;       ///< of this run; in all
  GlobalState end;                             ///< after the last step
  double wall_seconds = 0, setup_seconds = 0;  ///< of the steps; before the first, on rank 0
  double cost_seconds = 0;                     ///< CPU time of computation, of all ranks together
  double imbalance = 1;                        ///< largest / mean of that time
};

/// Per particle, means.
struct NeighbourCounts {
  double listed = 0;
  double within_support = 0;
  double halo_copies = 0;  ///< halo rows / owned rows
};

struct ByteCounts {
  double per_particle = 0, state_per_particle = 0, per_halo_particle = 0;
  double refresh = 0;        ///< of a halo row, a step
  double halo_per_step = 0;  ///< all messages
  double peak_rank = 0;      ///< resident memory of the largest rank, all told
};

struct EventCounts {
  std::int64_t rebuilds = 0, migrated = 0, refreshes = 0, iterations = 0;
};

/// What an inlet brought, an outlet or the faces took.
struct OpeningCount {
  std::string name;        ///< "inlet 1 brought"
  std::int64_t count = 0;  ///< particles
  double mass = 0;         ///< [kg]
};

/// Numbers of a finished (or stopped) run. Counters are sums over ranks unless said otherwise.
struct Performance {
  RunLabel label;
  RunLoop loop;
  NeighbourCounts neighbours;
  ByteCounts bytes;
  EventCounts events;
  decomp::BalanceAccount balance;
  CellLayout layout;
  std::vector<OpeningCount> openings;
  std::vector<decomp::Timers::Row> regions;
};
[[nodiscard]] std::string final_table(const Performance& performance);
void write_perf_json(const std::filesystem::path& path, const Performance& performance);

}  // namespace sph

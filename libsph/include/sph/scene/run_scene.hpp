// [decomposition], [output] and [[monitor]]: what may change the speed and the files of a run, never a bit of its
// particles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sph/scene/grain_scene.hpp"

namespace sph {

enum class CutRule { fixed, literal, quasi_newton, hybrid, chaos, replay };
enum class CostSource { time, counts };

struct Decomposition {
  std::array<int, 2> cut_axes{0, 1};  ///< row axis, column axis
  double skin = 0.2;                  ///< of the kernel's radius
  int rebuild_every = 0;  ///< 0: when neighbours may have gone apart by the skin; n: also every n steps
  bool overlap = true;    ///< compute the interior while halo messages travel
  CutRule cuts = CutRule::quasi_newton;
  CostSource cost = CostSource::time;
  std::uint64_t chaos_seed = 1;
  int slow_rank = 0;    ///< for tests of the balance: this rank ...
  double slowness = 1;  ///< ... takes so many times as long
  std::string record;   ///< file to write the cuts of each rebuild to, or empty
  std::string replay;
  friend bool operator==(const Decomposition&, const Decomposition&) = default;
};

enum class MonitorKind {
  particle,
  group,
  energy,
  momentum,
  wall,
  contacts,
  melt,
  budget,
  body,
  gauge,
  level,
  flux
};

struct Monitor {
  std::string name;
  MonitorKind kind = MonitorKind::particle;
  std::optional<std::uint64_t> id;  ///< particle: this id ...
  std::optional<Double3>
      nearest_to;             ///< ... or the one nearest this point at the start, lowest id on ties [m]
  int group = -1;             ///< group: averages over it; body: the rigid one
  int wall = -1;              ///< wall: its place, velocity and the force of the grains on it
  std::optional<Double3> at;  ///< gauge, level: its place [m]
  std::optional<Double3> to;  ///< gauge: it is a line from `at` to this point [m], of ...
  std::optional<std::uint64_t> points;  ///< ... so many points, 11 if not given
  std::optional<Double3> lower, upper;  ///< flux: corners of its rectangle, thin along one axis [m]
  friend bool operator==(const Monitor&, const Monitor&) = default;
};

/// The axis along which a box has no width; the number of dimensions where there is not exactly one.
[[nodiscard]] inline std::size_t normal_of(const Double3& lower, const Double3& upper, int dim) {
  const auto d = static_cast<std::size_t>(dim);
  std::size_t found = d, thin = 0;
  for (std::size_t a = 0; a < d; ++a) {
    if (lower[a] != upper[a]) continue;
    found = a;
    ++thin;
  }
  return thin == 1 ? found : d;
}

struct OutputControl {
  double snapshot_interval = 0;           ///< [s] of scene time; 0: only the last state
  double series_interval = 0;             ///< [s] of scene time; 0: every step
  double checkpoint_interval = 600;       ///< [s] of wall time; 0: none but the last
  double status_interval = 2;             ///< [s] of wall time
  double average_time = 0;                ///< window of the running time averages in snapshots [s]; 0: none
  bool average_space = false;             ///< kernel averages over same-group neighbours in snapshots
  bool contacts = false;                  ///< grains: snapshots hold the contacts with their forces
  std::int64_t sort_limit = 100'000'000;  ///< rows up to which snapshots are sorted by id
  int compression = 0;                    ///< of snapshots, by deflate: 1 to 9; 0: none
  int checkpoint_files = 0;               ///< 0: one per 512 ranks
  std::vector<Monitor> monitors;
  friend bool operator==(const OutputControl&, const OutputControl&) = default;
};

}  // namespace sph

// The pairs of a set of particles: their lists, and what pairs carry from step to step, which travels with the
// rows when they move to other ranks.
#pragma once

#include <algorithm>
#include <cstdint>
#include <optional>
#include <span>

#include "decomp/comm.hpp"
#include "decomp/grid.hpp"
#include "decomp/migrate.hpp"
#include "decomp/partition.hpp"
#include "decomp/timer.hpp"
#include "sph/core/particles.hpp"
#include "sph/pairs/neighbour_lists.hpp"

namespace sph {

/// Where lists are made, and how wide.
struct ListSetting {
  const decomp::Comm& comm;
  const decomp::CellGrid& grid;
  const decomp::JaggedPartition& partition;
  decomp::Box own_cells;
  std::int64_t radius = 0;  ///< range and skin [quanta]
  double skin = 0;          ///< [m]
  RowRanges& ranges;        ///< of the owned rows
  const GlobalState& global;
  decomp::Timers& timers;
  const Particles* other;  ///< of a pair of two sets: the other one, with its halo
};

class SetPair {
 public:
  explicit SetPair(std::size_t set) : SetPair(set, set) {}
  SetPair(std::size_t set, std::size_t other) : set_(set), other_(other) {}
  virtual ~SetPair() = default;

  /// Index of the set with whose rows travels what pairs carry, and whose rows lists are of.
  [[nodiscard]] std::size_t set() const { return set_; }
  /// ... of the set that the partners of its rows are of.
  [[nodiscard]] std::size_t other() const { return other_; }

  /// What lists are made of, and what changes only when rows move: sent to the halo after they have.
  [[nodiscard]] virtual FieldSet constants() const = 0;
  /// Lists must reach so far beyond their range, however small the scene's skin [m].
  [[nodiscard]] virtual double least_skin(const GlobalState&) const { return 0; }
  [[nodiscard]] virtual bool carries() const { return false; }
  /// What is to travel, before rows move; `arrived` where it has come from a checkpoint.
  [[nodiscard]] virtual decomp::Payload send(const Particles&, decomp::Payload arrived) { return arrived; }
  /// New lists after rows have moved. What travelled with row r is that of row order[r] in `carried`, which the pair that it
  /// is of empties. Collective; throws GuardError if anything was lost on its way.
  virtual void rebuild(const Particles& particles, const ListSetting& setting, decomp::Payload& carried,
                       std::span<const std::uint32_t> order) = 0;
  /// Bounds on ways since lists were made, of this rank's particles.
  struct Ways {
    double alone = 0;     ///< of any particle [m]
    double together = 0;  ///< how far two that are near each other have gone apart [m]
  };
  struct Look {
    Ways now;
    Ways next;  ///< when particles have drifted once more
  };
  /// Of pairs that would rather look than rely on what the fastest particle of each step may have done.
  [[nodiscard]] virtual std::optional<Look> look_at_ways(const Particles&, const GlobalState&) const {
    return std::nullopt;
  }
  struct LookedAt {
    FieldSet fields;        ///< that must be up to date in the halo ...
    bool in_lines = false;  ///< ... and are there (core/grain_lines.hpp)
  };
  /// For that.
  [[nodiscard]] virtual LookedAt looked_at() const { return {}; }
  /// How many entries are looked at for each owned row, as far as blocks tell: what it costs.
  virtual void count(const RowRanges& ranges, std::span<std::uint32_t> entries) const = 0;

 private:
  std::size_t set_, other_;
};

/// Shares `entries` of a block among its rows [first, last).
inline void share_block(std::span<std::uint32_t> rows, std::size_t first, std::size_t last,
                        std::size_t entries) {
  for (std::size_t i = first; i < std::min(last, rows.size()); ++i)
    rows[i] = static_cast<std::uint32_t>(entries / (last - first));
}

}  // namespace sph

// Where the cuts of a scene go: the rule that moves them, asked with the load that it needs to know, and the
// record of where they were. Cuts decide who computes a particle, never what is computed: nothing in here can
// reach a particle's bits.
#pragma once

#include <cstdint>
#include <fstream>
#include <functional>
#include <optional>
#include <span>
#include <vector>

#include "decomp/balancer.hpp"
#include "decomp/comm.hpp"
#include "decomp/partition.hpp"
#include "sph/plan/particle_set.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Pairs that are computed for each owned row of a set, or nothing where there are no lists yet.
using PairCounts = std::function<std::vector<std::uint32_t>(std::size_t set)>;

class CutControl {
 public:
  CutControl(const decomp::CellGrid& grid, const Scene& scene);

  /// Do cuts go where the load is?
  [[nodiscard]] bool follow_load() const { return balancer_.follows_load(); }
  /// The best cuts for the particles, before any time was measured. Collective.
  [[nodiscard]] decomp::Cuts first(const decomp::Comm& comm, const decomp::CellGrid& grid,
                                   std::span<const ParticleSet> sets) const;
  /// Cuts to move to, if any, by the computation time (or counts) of this rank since the last call. Collective.
  [[nodiscard]] std::optional<decomp::Cuts> next(const decomp::Comm& comm, const decomp::JaggedPartition& now,
                                                 double cost_seconds, std::span<const ParticleSet> sets,
                                                 const PairCounts& pairs);
  /// Adds a line to the file that the scene names, if it does, on rank 0.
  void record(int rank, const decomp::Cuts& cuts);

  /// What the last migration took.
  void migrated(std::int64_t rows_sent, std::int64_t rows_kept, double seconds) {
    balancer_.migrated(rows_sent, rows_kept, seconds);
  }
  [[nodiscard]] const decomp::BalanceAccount& account() const { return balancer_.account(); }

 private:
  /// Rows and their pairs in each column of cells.
  [[nodiscard]] decomp::Balancer::CountCells counts_of(const decomp::CellGrid& grid,
                                                       std::span<const ParticleSet> sets,
                                                       const PairCounts& pairs) const;

  const Scene& scene_;
  decomp::Balancer balancer_;
  std::ofstream record_;
};

/// Rows that this rank owns, of all sets.
[[nodiscard]] std::int64_t owned_rows(std::span<const ParticleSet> sets);

}  // namespace sph

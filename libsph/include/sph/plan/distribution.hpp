// Where particles live: cell grid, cuts, migration, order in memory, halo plan. Everything that depends on
// ranks is in here, and nothing of it can reach a particle's bits.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decomp/comm.hpp"
#include "decomp/migrate.hpp"
#include "sph/core/findings.hpp"
#include "sph/plan/cut_control.hpp"
#include "sph/plan/particle_set.hpp"
#include "sph/plan/row_order.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// The cells of a scene, the same on any number of ranks.
[[nodiscard]] decomp::CellGrid cell_grid_of(const Scene& scene, const PositionScale& scale);

class Distribution {
 public:
  /// Throws InputError when the ranks do not fit the grid, naming the largest number that does.
  Distribution(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale);

  [[nodiscard]] const decomp::Comm& comm() const { return comm_; }
  [[nodiscard]] const decomp::CellGrid& grid() const { return grid_; }
  [[nodiscard]] const decomp::JaggedPartition& partition() const { return partition_; }
  /// Of the lists since the last rebuild: how far beyond the range of interaction they reach [m].
  [[nodiscard]] double skin() const { return skin_; }
  [[nodiscard]] std::int64_t list_radius() const { return reach_; }  ///< range of interaction + skin [quanta]
  [[nodiscard]] decomp::Box own_cells() const { return partition_.cells(comm_.rank()); }
  /// A place in the domain is this rank's.
  [[nodiscard]] bool owns(const decomp::Int3& place) const {
    return partition_.quanta(comm_.rank()).contains(place);
  }
  [[nodiscard]] std::int64_t migrated() const { return migrated_; }  ///< rows this rank sent away
  [[nodiscard]] const decomp::BalanceAccount& balance() const { return cuts_.account(); }

  /// Where cuts may follow the load: shares out the particles, wherever their rows are now, evenly. Before
  /// the first rebuild; scatter() must follow.
  void cut_by_counts(std::span<ParticleSet> sets);

  /// At the last rebuild: how far this rank's movers, of any set, were from the faces through which they may leave [m].
  [[nodiscard]] double to_face() const { return to_face_; }
  /// Which rows of this rank lie beyond such a face.
  [[nodiscard]] Findings outside(const Particles& particles) const;

  /// Sends every row, with its contacts, to its owner wherever it is: set-up and resume.
  void scatter(Particles& particles, decomp::Payload* contacts = nullptr);

  /// What pairs carry migrates with the rows of their set, but is not sorted (it may be most of the memory):
  /// that of row r is afterwards in row order[r].
  struct Carried {
    decomp::Payload payload;
    bool any = false;
    std::vector<std::uint32_t> order;
  };

  /// Moves the cuts by the computation time (or counts) since the last call, migrates, sorts in memory and
  /// plans the halos. Halo rows are allocated, not filled. No particle has moved further than `moved` [m]
  /// since the last call. The lists will reach as far as the scene's skin, or `least_skin` [m] where that is
  /// more. `carried`: one for each set. Sets that have owners of their own are not among them.
  void rebuild(std::span<ParticleSet> sets, double cost_seconds, const PairCounts& pairs, double moved,
               double least_skin, std::span<Carried> carried);

 private:
  void cut(decomp::Cuts cuts);
  void wrap_positions(Particles& particles) const;
  [[nodiscard]] std::vector<decomp::Rank> owners(const Particles& particles) const;
  void migrate(std::span<ParticleSet> sets, double cost, const PairCounts& pairs, double moved,
               std::span<Carried> carried);

  const decomp::Comm& comm_;
  const Scene& scene_;
  PositionScale scale_;
  double skin_;
  std::int64_t reach_;
  decomp::CellGrid grid_;
  decomp::JaggedPartition partition_;
  CutControl cuts_;
  RowOrder order_;
  std::int64_t migrated_ = 0;
  double to_face_ = 0;
};

}  // namespace sph

#include "sph/plan/distribution.hpp"

#include <algorithm>
#include <chrono>
#include <limits>
#include <utility>

#include "sph/core/error.hpp"
#include "sph/core/findings.hpp"
#include "sph/scene/positions.hpp"

namespace sph {
namespace {

/// Support and skin [quanta].
std::int64_t reach_of(const Scene& scene, const PositionScale& scale) {
  return scale.quanta(scene.list_range() + scene.decomposition.skin * scene.support()) + 1;
}

decomp::Cuts first_cuts(const decomp::CellGrid& grid, const Scene& scene, int ranks) {
  const auto [row, column] = scene.decomposition.cut_axes;
  try {
    return decomp::uniform_cuts(ranks, grid.cells()[static_cast<std::size_t>(row)],
                                grid.cells()[static_cast<std::size_t>(column)]);
  } catch (const InputError& error) {
    throw InputError(scene.file + ": " + error.what() +
                     "; start fewer, or reduce decomposition.skin or start.spacing for smaller cells");
  }
}

}  // namespace

decomp::CellGrid cell_grid_of(const Scene& scene, const PositionScale& scale) {
  const decomp::Int3 length = domain_length(scene, scale);
  // Places along the Hilbert curve, and cells of all axes, must be numbers of 62 bits.
  constexpr std::int64_t most_cells = (std::int64_t{1} << 20) - 1;
  std::int64_t edge = reach_of(scene, scale);
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    edge = std::max(edge, (length[a] - 1) / most_cells + 1);
  return {scene.dim, scale.origin, length, scene.domain.periodic, edge};
}

Distribution::Distribution(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale)
    : comm_(comm),
      scene_(scene),
      scale_(scale),
      skin_(scene.decomposition.skin * scene.support()),
      reach_(reach_of(scene, scale)),
      grid_(cell_grid_of(scene, scale)),
      partition_(grid_, scene.decomposition.cut_axes[0], scene.decomposition.cut_axes[1],
                 first_cuts(grid_, scene, comm.size())),
      cuts_(grid_, scene) {}

void Distribution::cut(decomp::Cuts cuts) {
  const auto [row, column] = scene_.decomposition.cut_axes;
  partition_ = decomp::JaggedPartition(grid_, row, column, std::move(cuts));
  order_.cuts_moved();
}

void Distribution::cut_by_counts(std::span<ParticleSet> sets) {
  if (!cuts_.follow_load() || comm_.size() == 1) return;
  for (ParticleSet& set : sets) wrap_positions(set.particles);
  cut(cuts_.first(comm_, grid_, sets));
}

void Distribution::wrap_positions(Particles& particles) const {
  const std::size_t d = static_cast<std::size_t>(particles.dim());
  std::int64_t* x = particles.data<Field::position>();
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    decomp::Int3 p{};
    for (std::size_t a = 0; a < d; ++a) p[a] = x[i * d + a];
    p = grid_.wrap(p);
    for (std::size_t a = 0; a < d; ++a) x[i * d + a] = p[a];
  }
}

Findings Distribution::outside(const Particles& particles) const {
  const std::size_t d = static_cast<std::size_t>(particles.dim());
  const RowPlaces x = particles.places();
  Findings found;
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    decomp::Int3 p{};
    for (std::size_t a = 0; a < d; ++a) p[a] = x(i, a);
    if (grid_.inside(p)) continue;
    const Group& group = scene_.groups[particles.data<Field::group>()[i]];
    if (is_deleted(scene_, scale_, group, p.data())) continue;
    const std::uint64_t id = particles.data<Field::id>()[i];
    found.add(id, [&] {
      std::vector<double> at;
      for (std::size_t a = 0; a < d; ++a) at.push_back(scale_.metres(grid_.wrap(p)[a]));
      return "particle " + std::to_string(id) + " is outside the domain " + place_text(at) +
             (particles.has(Field::radius)
                  ? ": give a [[wall]] there, or enlarge domain.lower or domain.upper"
                  : ": enlarge domain.lower or domain.upper, or see domain.leaves");
    });
  }
  return found;
}

std::vector<decomp::Rank> Distribution::owners(const Particles& particles) const {
  const std::size_t d = static_cast<std::size_t>(particles.dim());
  const std::int64_t* x = particles.data<Field::position>();
  const decomp::Box own = partition_.quanta(comm_.rank());
  std::vector<decomp::Rank> owner(particles.owned(), comm_.rank());
  for (std::size_t i = 0; i < owner.size(); ++i) {
    decomp::Int3 p{};
    for (std::size_t a = 0; a < d; ++a) p[a] = x[i * d + a];
    if (!own.contains(p)) owner[i] = partition_.owner(grid_.cell_of(p));
  }
  return owner;
}

void Distribution::scatter(Particles& particles, decomp::Payload* contacts) {
  wrap_positions(particles);
  decomp::redistribute(comm_, owners(particles), particles.table(), contacts);
}

void Distribution::rebuild(std::span<ParticleSet> sets, double cost_seconds, const PairCounts& pairs,
                           double moved, double least_skin, std::span<Carried> carried) {
  skin_ = std::max(scene_.decomposition.skin * scene_.support(), least_skin);
  reach_ = scale_.quanta(scene_.list_range() + skin_) + 1;
  for (ParticleSet& set : sets) wrap_positions(set.particles);
  if (comm_.size() > 1) migrate(sets, cost_seconds, pairs, moved, carried);
  to_face_ = std::numeric_limits<double>::infinity();
  for (std::size_t k = 0; k < sets.size(); ++k) {
    ParticleSet& set = sets[k];
    RowOrder::Sorted sorted = order_.sort(set, partition_, comm_.rank(), reach_);
    carried[k].order = std::move(sorted.order);
    to_face_ = std::min(to_face_, scale_.metres(sorted.to_face));
    set.halo = decomp::HaloPlan(comm_, partition_, reach_, set.particles.dim(),
                                set.particles.column(Field::position), set.particles.table());
  }
}

void Distribution::migrate(std::span<ParticleSet> sets, double cost_seconds, const PairCounts& pairs,
                           double moved, std::span<Carried> carried) {
  const decomp::JaggedPartition before = partition_;
  if (auto cuts = cuts_.next(comm_, partition_, cost_seconds, sets, pairs)) cut(std::move(*cuts));
  cuts_.record(comm_.rank(), partition_.cuts());
  const std::int64_t strayed = scale_.quanta(moved) + 1;
  const decomp::MigrationPeers peers = decomp::migration_peers(before, partition_, comm_.rank(), strayed);
  const auto start = std::chrono::steady_clock::now();
  std::int64_t sent = 0;
  for (std::size_t k = 0; k < sets.size(); ++k)
    sent += static_cast<std::int64_t>(decomp::migrate(comm_, owners(sets[k].particles), peers,
                                                      sets[k].particles.table(),
                                                      carried[k].any ? &carried[k].payload : nullptr));
  migrated_ += sent;
  cuts_.migrated(sent, owned_rows(sets),
                 std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

}  // namespace sph

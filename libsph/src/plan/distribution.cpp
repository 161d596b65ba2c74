#include "sph/plan/distribution.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <chrono>
#include <fstream>
#include <limits>
#include <numeric>
#include <utility>

#include "pairs/list_slack.hpp"
#include "pairs/occupied.hpp"
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

std::unique_ptr<decomp::CutPolicy> make_policy(const Decomposition& d) {
  switch (d.cuts) {
    case CutRule::literal:
      return decomp::make_literal();
    case CutRule::quasi_newton:
      return decomp::make_quasi_newton();
    case CutRule::hybrid:
      return decomp::make_hybrid();
    case CutRule::chaos:
      return decomp::make_chaos(d.chaos_seed);
    case CutRule::replay: {
      std::ifstream in(d.replay);
      if (!in) throw InputError("decomposition.replay: cannot read '" + d.replay + "'");
      std::vector<decomp::Cuts> cuts;
      for (std::string line; std::getline(in, line);) cuts.push_back(decomp::cuts_from_text(line));
      return decomp::make_replay(std::move(cuts));
    }
    case CutRule::fixed:
      break;
  }
  return decomp::make_fixed();
}

decomp::CutLimits limits_of(const decomp::CellGrid& grid, const Scene& scene) {
  const auto [row, column] = scene.decomposition.cut_axes;
  return {grid.cells()[static_cast<std::size_t>(row)], grid.cells()[static_cast<std::size_t>(column)]};
}

}  // namespace

decomp::CellGrid cell_grid_of(const Scene& scene, const PositionScale& scale) {
  const decomp::Int3 length = domain_length(scene, scale);
  // Places along the Hilbert curve, and cells of all axes, must be numbers of 62 bits.
  constexpr std::int64_t most_cells = (std::int64_t{1} << 20) - 1;
  std::int64_t edge = reach_of(scene, scale);
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    edge = std::max(edge, (length[a] - 1) / most_cells + 1);
  return {scene.dim, scale.origin, length, scene.periodic, edge};
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
      // The literal rule goes one cell a call, so it is called at each rebuild.
      balancer_(make_policy(scene.decomposition), limits_of(grid_, scene),
                scene.decomposition.cost == CostSource::time &&
                    (scene.decomposition.cuts == CutRule::quasi_newton ||
                     scene.decomposition.cuts == CutRule::hybrid)) {}

void Distribution::record_cuts() {
  const std::string& file = scene_.decomposition.record;
  if (file.empty() || comm_.rank() != 0) return;
  if (!record_.is_open()) record_.open(file, std::ios::app);  // the run has made it, see run_directory.hpp
  record_ << decomp::to_text(partition_.cuts()) << '\n' << std::flush;
  if (!record_) throw OutputError("decomposition.record: cannot write " + file);
}

void Distribution::cut(decomp::Cuts cuts) {
  const auto [row, column] = scene_.decomposition.cut_axes;
  partition_ = decomp::JaggedPartition(grid_, row, column, std::move(cuts));
  curve_.clear();
}

decomp::Balancer::CountCells Distribution::counts_of(std::span<const ParticleSet> sets,
                                                     const PairCounts& pairs) const {
  return [&, sets](const decomp::CellColumns& columns, std::span<std::int64_t> rows,
                   std::span<std::int64_t> of_pairs) {
    const auto row = static_cast<std::size_t>(scene_.decomposition.cut_axes[0]);
    const auto column = static_cast<std::size_t>(scene_.decomposition.cut_axes[1]);
    for (std::size_t set = 0; set < sets.size(); ++set) {
      const Particles& particles = sets[set].particles;
      const std::size_t d = static_cast<std::size_t>(particles.dim());
      const std::int64_t* x = particles.data<Field::position>();
      const std::vector<std::uint32_t> listed = pairs ? pairs(set) : std::vector<std::uint32_t>();
      for (std::size_t i = 0; i < particles.owned(); ++i) {
        decomp::Int3 p{};
        for (std::size_t a = 0; a < d; ++a) p[a] = x[i * d + a];
        const decomp::Int3 cell = grid_.cell_of(p);
        const std::size_t at = columns.index(cell[row], cell[column]);
        ++rows[at];
        if (i < listed.size()) of_pairs[at] += listed[i];
      }
    }
  };
}

void Distribution::cut_by_counts(std::span<ParticleSet> sets) {
  if (!balancer_.follows_load() || comm_.size() == 1) return;
  for (ParticleSet& set : sets) wrap_positions(set.particles);
  cut(balancer_.first(comm_, counts_of(sets, {})));
}

int Distribution::curve_bits() const {
  const decomp::Int3& cells = grid_.cells();
  return static_cast<int>(
      std::bit_width(static_cast<std::uint64_t>(std::max({cells[0], cells[1], cells[2]}))));
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
  const std::int64_t* x = particles.data<Field::position>();
  Findings found;
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    decomp::Int3 p{};
    for (std::size_t a = 0; a < d; ++a) p[a] = x[i * d + a];
    if (grid_.inside(p)) continue;
    const std::uint64_t id = particles.data<Field::id>()[i];
    found.add(id, [&] {
      std::vector<double> at;
      for (std::size_t a = 0; a < d; ++a) at.push_back(scale_.metres(grid_.wrap(p)[a]));
      return "particle " + std::to_string(id) + " is outside the domain " + place_text(at) +
             ": enlarge domain.lower or domain.upper";
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
    carried[k].order = sort_rows(set);
    set.halo = decomp::HaloPlan(comm_, partition_, reach_, set.particles.dim(),
                                set.particles.column(Field::position), set.particles.table());
  }
}

void Distribution::migrate(std::span<ParticleSet> sets, double cost_seconds, const PairCounts& pairs,
                           double moved, std::span<Carried> carried) {
  const decomp::JaggedPartition before = partition_;
  const auto rows = [&] {
    std::int64_t n = 0;
    for (const ParticleSet& set : sets) n += static_cast<std::int64_t>(set.particles.owned());
    return n;
  };
  const double cost =
      scene_.decomposition.cost == CostSource::time ? cost_seconds : static_cast<double>(rows());
  if (auto cuts = balancer_.next(comm_, partition_.cuts(), cost, counts_of(sets, pairs)))
    cut(std::move(*cuts));
  record_cuts();
  const std::int64_t strayed = scale_.quanta(moved) + 1;
  const decomp::MigrationPeers peers = decomp::migration_peers(before, partition_, comm_.rank(), strayed);
  const auto start = std::chrono::steady_clock::now();
  std::int64_t sent = 0;
  for (std::size_t k = 0; k < sets.size(); ++k)
    sent += static_cast<std::int64_t>(decomp::migrate(comm_, owners(sets[k].particles), peers,
                                                      sets[k].particles.table(),
                                                      carried[k].any ? &carried[k].payload : nullptr));
  migrated_ += sent;
  balancer_.migrated(sent, rows(),
                     std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count());
}

// Counting sort by (class, cell along the curve), then by id within a cell. The boundary is a layer inside
// the faces shared with anyone, this rank's own periodic images included, as deep as lists can reach:
// particles deeper in have no partner in the halo, and are computed before it has arrived.
std::vector<std::uint32_t> Distribution::sort_rows(ParticleSet& set) {
  Particles& particles = set.particles;
  const std::size_t d = static_cast<std::size_t>(particles.dim()), n = particles.owned();
  const std::int64_t* x = particles.data<Field::position>();
  const auto* group = particles.data<Field::group>();
  const auto* id = particles.data<Field::id>();
  const decomp::Box own = own_cells();
  decomp::Box inner = partition_.quanta(comm_.rank());
  const auto slack =
      static_cast<std::int64_t>(2 * list_slack(grid_, own, reach_) * static_cast<double>(reach_));
  const std::int64_t depth = reach_ + slack + 1;
  for (std::size_t a = 0; a < d; ++a) inner.lo[a] += depth, inner.hi[a] -= depth;
  const std::int64_t nx = own.hi[0] - own.lo[0], ny = own.hi[1] - own.lo[1];
  const auto own_count = static_cast<std::size_t>(nx * ny * (d == 3 ? own.hi[2] - own.lo[2] : 1));
  // Few rows in many cells: their places along the curve of the whole grid, which are in the same order.
  const bool dense = Occupied::dense(4 * own_count, n);
  const std::size_t cells = dense ? own_count : std::size_t{1} << (static_cast<int>(d) * curve_bits());
  if (!dense) curve_ = {};
  if (dense && curve_.empty()) curve_ = decomp::hilbert_places(grid_.dim(), curve_bits(), own);

  std::vector<std::size_t> bucket(n);
  Occupied occupied(4 * cells, n);
  std::int64_t to_face = std::numeric_limits<std::int64_t>::max();
  for (std::size_t i = 0; i < n; ++i) {
    decomp::Int3 p{};
    for (std::size_t a = 0; a < d; ++a) p[a] = x[i * d + a];
    const decomp::Int3 c = grid_.cell_of(p);
    const auto place = [&]() -> std::size_t {
      if (!dense) return decomp::hilbert_key(grid_.dim(), curve_bits(), c);
      return curve_[static_cast<std::size_t>(((c[2] - own.lo[2]) * ny + c[1] - own.lo[1]) * nx + c[0] -
                                             own.lo[0])];
    };
    bool interior = true;
    for (std::size_t a = 0; a < d; ++a) interior = interior && p[a] >= inner.lo[a] && p[a] < inner.hi[a];
    const std::size_t row_class = (interior ? 0u : 2u) + (set.stays[group[i]] ? 1u : 0u);
    for (std::size_t a = 0; a < d && row_class % 2 == 0; ++a)
      if (const std::int64_t low = p[a] - grid_.origin()[a]; !grid_.periodic()[a])
        to_face = std::min({to_face, low, grid_.length()[a] - 1 - low});
    bucket[i] = row_class * cells + place();
    occupied.mark(bucket[i]);
  }
  std::vector<std::uint32_t> start(occupied.number() + 1, 0), bin(n), order(n);
  for (std::size_t i = 0; i < n; ++i) ++start[(bin[i] = occupied.before(bucket[i])) + 1];
  std::partial_sum(start.begin(), start.end(), start.begin());
  for (std::size_t c = 0; c < 4; ++c)
    set.ranges[c] = {start[occupied.before(c * cells)], start[occupied.before((c + 1) * cells)], 0};
  std::vector<std::uint32_t> at(start.begin(), start.end() - 1);
  for (std::size_t i = 0; i < n; ++i) {
    const std::uint32_t first = start[bin[i]];
    std::uint32_t k = at[bin[i]]++;
    for (; k > first && id[order[k - 1]] > id[i]; --k) order[k] = order[k - 1];
    order[k] = static_cast<std::uint32_t>(i);
  }
  to_face_ = std::min(to_face_, scale_.metres(to_face));
  particles.table().reorder(order);
  return order;
}

}  // namespace sph

#include "run/cost.hpp"

#include <sys/resource.h>

#include <algorithm>
#include <array>

#include "decomp/cut_policy.hpp"

namespace sph {
namespace {

/// Directed pairs of fluid and solid particles of this rank that lie within the support.
std::int64_t pairs_within_support(const Simulation& s) {
  const auto d = static_cast<std::size_t>(s.scene().dim);
  const auto lanes = static_cast<std::size_t>(s.lists().lanes());
  const double support = s.scene().kernel_radius() / s.scale().quantum;
  const Particles& particles = s.particles(s.physics()->set());
  const std::int64_t* x = particles.data<Field::position>();
  const double* h = particles.data<Field::smoothing_length>();
  const auto radius = [&](std::size_t i, std::size_t j) {
    return h == nullptr ? support : support * std::max(h[i], h[j]) / s.scene().smoothing_length;
  };
  std::int64_t pairs = 0;
  for (const RowRange& range : s.sets()[s.physics()->set()].ranges)
    for (std::size_t i = range.first; i < range.last; ++i) {
      const std::size_t k = i - range.first;
      const auto block = s.lists().block(range.first_block + k / lanes);
      for (std::size_t entry = k % lanes; entry < block.size(); entry += lanes) {
        const std::size_t j = block[entry];
        double r2 = 0;
        for (std::size_t a = 0; a < d; ++a) {
          const auto r = static_cast<double>(x[i * d + a] - x[j * d + a]);
          r2 += r * r;
        }
        const double reach = radius(i, j);
        if (j != i && r2 < reach * reach) ++pairs;
      }
    }
  return pairs;
}

CellLayout layout_of(const Simulation& s) {
  const decomp::JaggedPartition& partition = s.distribution().partition();
  const decomp::CellGrid& grid = partition.grid();
  CellLayout out;
  for (std::size_t a = 0; a < 3; ++a) {
    out.origin[a] = s.scale().metres(grid.origin()[a]);
    out.edge[a] = s.scale().metres(grid.edge()[a]);
    out.cells[a] = grid.cells()[a];
    out.periodic[a] = grid.periodic()[a];
  }
  out.cut_axes = {partition.row_axis(), partition.column_axis()};
  out.cuts = decomp::to_text(partition.cuts());
  return out;
}

}  // namespace

std::size_t bytes_of(FieldSet fields, int dim) {
  std::size_t bytes = 0;
  for (Field f : fields.list()) bytes += width(f, dim);
  return bytes;
}

FieldSet halo_fields(const Plan& plan, std::size_t set, FieldSet fields) {
  FieldSet read{Field::id, Field::position};
  if (fields.has(Field::radius)) read |= fields;  // a partner's everything
  for (const Entry* e : entries_of(plan))
    for (const Stage& s : e->stages) {
      if (s.set == set) read |= s.refresh;
      if (s.other && s.other->set == set) read |= s.other->refresh;
    }
  return read & fields;
}

Performance performance_of(Simulation& s) {
  const decomp::Comm& comm = s.comm();
  const int dim = s.scene().dim;
  std::vector<FieldSet> fields;
  for (const ParticleSet& set : s.sets()) fields.push_back(set.particles.fields());
  std::vector<double> sent(fields.size(), 0);  // bytes a halo row of each set is sent in a step
  for (const Scheduled& scheduled : schedule_of(s.plan(), fields)) {
    sent[scheduled.stage->set] += static_cast<double>(bytes_of(scheduled.sends, dim));
    if (const auto& other = scheduled.stage->other)
      sent[other->set] += static_cast<double>(bytes_of(scheduled.other_sends, dim));
    if (const PlanRunner::Counters& c = s.counters(); c.solved > 0)
      sent[scheduled.stage->set] +=
          static_cast<double>(c.repeats / c.solved) * static_cast<double>(bytes_of(scheduled.again, dim));
  }

  std::int64_t listed = 0, near = 0;
  if (s.grains() != nullptr) {
    listed += static_cast<std::int64_t>(s.grains()->pairs().lists().listed());
    near += s.grains()->pairs().touching();
  }
  if (s.physics() != nullptr) {
    listed += static_cast<std::int64_t>(s.lists().pairs());
    near += pairs_within_support(s);
  }
  Performance p;
  p.scene = s.scene().name;
  p.fingerprint = s.fingerprint();
  p.ranks = comm.size();
  p.particles = s.particle_count();
  p.end = s.global();
  std::vector<std::int64_t> sums{listed, near, s.distribution().migrated()};
  for (const ParticleSet& set : s.sets()) {
    sums.push_back(static_cast<std::int64_t>(set.halo.rows_received() + set.halo.rows_copied()));
    sums.push_back(static_cast<std::int64_t>(set.halo.rows_sent()));
    sums.push_back(static_cast<std::int64_t>(set.particles.owned()));
  }
  comm.sum(std::span<std::int64_t>(sums));
  double halo = 0, in_halo = 0;
  for (std::size_t set = 0; set < fields.size(); ++set) {
    const auto copies = static_cast<double>(sums[3 + 3 * set]), rows = static_cast<double>(sums[5 + 3 * set]);
    halo += copies;
    p.halo_bytes_per_step += static_cast<double>(sums[4 + 3 * set]) * sent[set];
    p.state_bytes_per_particle += rows * static_cast<double>(bytes_of(state_of(fields[set]), dim));
    p.bytes_per_particle += rows * static_cast<double>(bytes_of(fields[set], dim));
    // Of sets of unlike particles the mean over what there is of them.
    p.refresh_bytes += rows * sent[set];
    in_halo += rows * static_cast<double>(bytes_of(halo_fields(s.plan(), set, fields[set]), dim));
  }
  const auto particles = static_cast<double>(p.particles);
  p.refresh_bytes /= particles;
  p.state_bytes_per_particle /= particles;
  p.bytes_per_particle /= particles;
  p.bytes_per_halo_particle = in_halo / particles;
  p.neighbours_per_particle = static_cast<double>(sums[0]) / particles;
  p.pairs_per_particle = static_cast<double>(sums[1]) / particles;
  p.halo_per_particle = halo / particles;
  p.migrated = sums[2];
  p.rebuilds = s.rebuilds();
  p.refreshes = s.refreshes();
  p.iterations = s.counters().iterations;
  p.balance = s.distribution().balance();
  p.regions = s.timers().summary(comm);
  p.layout = layout_of(s);
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::array<double, 1> peak{1024.0 * static_cast<double>(usage.ru_maxrss)};
  comm.max(peak);
  p.peak_rank_bytes = peak[0];
  return p;
}

}  // namespace sph

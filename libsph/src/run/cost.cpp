#include "run/cost.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>

#include "decomp/cut_policy.hpp"

namespace sph {

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
    return h == nullptr ? support : support * std::max(h[i], h[j]) / s.scene().kernel.smoothing_length;
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

/// Bytes that a halo row of each set is sent in a step.
std::vector<double> sent_per_row(const Simulation& s, const std::vector<FieldSet>& fields) {
  const int dim = s.scene().dim;
  std::vector<double> sent(fields.size(), 0);
  for (const Scheduled& scheduled : schedule_of(s.plan(), fields)) {
    sent[scheduled.stage->set] += static_cast<double>(bytes_of(scheduled.sends, dim));
    if (const auto& other = scheduled.stage->other)
      sent[other->set] += static_cast<double>(bytes_of(scheduled.other_sends, dim));
    if (const PlanRunner::Counters& c = s.counters(); c.solved > 0)
      sent[scheduled.stage->set] +=
          static_cast<double>(c.repeats / c.solved) * static_cast<double>(bytes_of(scheduled.again, dim));
  }
  return sent;
}

/// Rows of each set over all ranks. Collective.
struct SetRows {
  double owned, halo, sent;
};
std::vector<SetRows> rows_of(const Simulation& s) {
  std::vector<std::int64_t> sums;
  for (const ParticleSet& set : s.sets()) {
    sums.push_back(static_cast<std::int64_t>(set.particles.owned()));
    sums.push_back(static_cast<std::int64_t>(set.halo.rows_received() + set.halo.rows_copied()));
    sums.push_back(static_cast<std::int64_t>(set.halo.rows_sent()));
  }
  s.comm().sum(std::span<std::int64_t>(sums));
  std::vector<SetRows> out;
  for (std::size_t k = 0; k < sums.size(); k += 3)
    out.push_back(
        {static_cast<double>(sums[k]), static_cast<double>(sums[k + 1]), static_cast<double>(sums[k + 2])});
  return out;
}

// Of sets of unlike particles the means over what there is of them. Collective.
ByteCounts bytes_used(const Simulation& s, const std::vector<SetRows>& rows, double particles) {
  const int dim = s.scene().dim;
  std::vector<FieldSet> fields;
  for (const ParticleSet& set : s.sets()) fields.push_back(set.particles.fields());
  const std::vector<double> sent = sent_per_row(s, fields);
  ByteCounts b;
  for (std::size_t set = 0; set < fields.size(); ++set) {
    const double owned = rows[set].owned;
    b.halo_per_step += rows[set].sent * sent[set];
    b.state_per_particle += owned * static_cast<double>(bytes_of(state_of(fields[set]), dim));
    b.per_particle += owned * static_cast<double>(bytes_of(fields[set], dim));
    b.refresh += owned * sent[set];
    b.per_halo_particle +=
        owned * static_cast<double>(bytes_of(halo_fields(s.plan(), set, fields[set]), dim));
  }
  for (double* mean : {&b.refresh, &b.state_per_particle, &b.per_particle, &b.per_halo_particle})
    *mean /= particles;
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  std::array<double, 1> peak{1024.0 * static_cast<double>(usage.ru_maxrss)};
  s.comm().max(peak);
  b.peak_rank = peak[0];
  return b;
}

/// Collective.
NeighbourCounts neighbours_of(const Simulation& s, const std::vector<SetRows>& rows, double particles) {
  std::array<std::int64_t, 2> pairs{};  // listed, near
  if (s.grains() != nullptr) {
    pairs[0] += static_cast<std::int64_t>(s.grains()->pairs().lists().listed());
    pairs[1] += s.grains()->pairs().lists().pairs().contacts();
  }
  if (s.physics() != nullptr) {
    pairs[0] += static_cast<std::int64_t>(s.lists().pairs());
    pairs[1] += pairs_within_support(s);
  }
  s.comm().sum(pairs);
  double halo = 0;
  for (const SetRows& of_set : rows) halo += of_set.halo;
  return {static_cast<double>(pairs[0]) / particles, static_cast<double>(pairs[1]) / particles,
          halo / particles};
}

EventCounts events_of(const Simulation& s) {
  EventCounts e;
  e.rebuilds = s.rebuilds();
  e.migrated = s.comm().sum(s.distribution().migrated());
  for (const ParticleSet& set : s.sets()) e.refreshes += set.exchange.refreshes();
  e.iterations = s.counters().iterations;
  return e;
}

std::vector<OpeningCount> openings_of(const Simulation& s) {
  const std::size_t inlets = s.scene().domain.openings.inlets.size(),
                    outlets = s.scene().domain.openings.outlets.size();
  std::vector<OpeningCount> out;
  const std::vector<Passage>& passages = s.global().throughput.passages;
  for (std::size_t k = 0; k < passages.size(); ++k) {
    if (k == inlets + outlets && passages[k].count == 0) continue;
    out.push_back({k < inlets             ? fmt::format("inlet {} brought", k + 1)
                   : k < inlets + outlets ? fmt::format("outlet {} took", k + 1 - inlets)
                   : k > inlets + outlets ? fmt::format("insertion {} put in", k - inlets - outlets)
                                          : "through the faces left",
                   passages[k].count, passages[k].amounts[0]});
  }
  return out;
}

}  // namespace

Performance performance_of(Simulation& s) {
  Performance p;
  p.label.scene = s.scene().name;
  p.label.fingerprint = s.fingerprint();
  p.loop.ranks = s.comm().size();
  p.loop.particles = s.particle_count();
  p.loop.end = s.global();
  const std::vector<SetRows> rows = rows_of(s);
  const auto particles = static_cast<double>(p.loop.particles);
  p.neighbours = neighbours_of(s, rows, particles);
  p.bytes = bytes_used(s, rows, particles);
  p.events = events_of(s);
  p.balance = s.distribution().balance();
  p.regions = s.timers().summary(s.comm());
  p.layout = layout_of(s);
  p.openings = openings_of(s);
  return p;
}

}  // namespace sph

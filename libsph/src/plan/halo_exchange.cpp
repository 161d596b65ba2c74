#include "sph/plan/halo_exchange.hpp"

#include <vector>

#include "decomp/poison.hpp"

namespace sph {
namespace {

/// Whole lines, whichever parts of them are wanted.
std::vector<decomp::HaloPlan::Rows> lines_of(Particles& particles) {
  const auto rows = [](decomp::LargeVector<double>& of, std::size_t width, bool positions) {
    return decomp::HaloPlan::Rows{reinterpret_cast<std::byte*>(of.data()), width * sizeof(double), positions};
  };
  GrainLines& lines = particles.lines();
  std::vector<decomp::HaloPlan::Rows> out{rows(lines.motion, GrainLines::motion_width, true)};
  if (particles.has(Field::spin)) out.push_back(rows(lines.spin, GrainLines::spin_width, false));
  return out;
}

std::vector<int> columns_of(const Particles& particles, FieldSet fields) {
  std::vector<int> columns;
  for (Field f : fields.list()) columns.push_back(particles.column(f));
  return columns;
}

}  // namespace

void HaloExchange::begin(decomp::HaloPlan& halo, Particles& particles, FieldSet wanted,
                         decomp::Timers& timers, bool in_lines) {
  const auto timing = timers.time(decomp::Region::pack);
  const FieldSet send = fresh_.missing(wanted & particles.fields());
  under_way_ = !send.empty();
  if (!under_way_) return;
  if (in_lines && send.without(Particles::in_lines).empty())
    halo.begin(lines_of(particles));
  else
    halo.begin(particles.table(), columns_of(particles, send));
  fresh_.sent(send);
  ++refreshes_;
  if (!overlap_) end(halo, timers);
}

void HaloExchange::end(decomp::HaloPlan& halo, decomp::Timers& timers) {
  if (!under_way_) return;
  under_way_ = false;
  {
    const auto timing = timers.time(decomp::Region::halo_wait);
    halo.wait();
  }
  const auto timing = timers.time(decomp::Region::pack);
  halo.end();
}

void HaloExchange::changed(Particles& particles, FieldSet fields) {
  fresh_.changed(fields);
  if (!decomp::poisons()) return;
  const FieldSet of = fields & particles.fields();
  if (particles.has_lines() && of.without(Particles::in_lines).empty())
    particles.lines().poison(of, particles.owned());
  else
    decomp::poison_halo(particles.table(), columns_of(particles, of));
}

}  // namespace sph

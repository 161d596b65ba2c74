#include "sph/plan/halo_exchange.hpp"

#include <vector>

#include "decomp/poison.hpp"

namespace sph {
namespace {

std::vector<int> columns_of(const Particles& particles, FieldSet fields) {
  std::vector<int> columns;
  for (Field f : fields.list()) columns.push_back(particles.column(f));
  return columns;
}

}  // namespace

void HaloExchange::begin(decomp::HaloPlan& halo, Particles& particles, FieldSet wanted,
                         decomp::Timers& timers) {
  const auto timing = timers.time(decomp::Region::pack);
  const FieldSet send = fresh_.missing(wanted & particles.fields());
  under_way_ = !send.empty();
  if (!under_way_) return;
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
  if (decomp::poisons())
    decomp::poison_halo(particles.table(), columns_of(particles, fields & particles.fields()));
}

}  // namespace sph

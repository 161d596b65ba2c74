#include "sph/run/report.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>

namespace sph {
namespace {

/// 1.9e7 and 1.0e-4 rather than 1.9e+07 and 1.0e-04.
std::string short_exponent(double x) {
  std::string text = fmt::format("{:.1e}", x);
  const std::size_t e = text.find('e');
  if (e == std::string::npos) return text;  // inf, nan
  const std::string sign = text[e + 1] == '-' ? "-" : "";
  const std::size_t digit = std::min(text.find_first_not_of('0', e + 2), text.size() - 1);
  return text.substr(0, e + 1) + sign + text.substr(digit);
}

std::string hours_minutes_seconds(double seconds) {
  if (!(seconds >= 0) || seconds > 1e9) return "?";
  const auto s = std::llround(seconds);
  return fmt::format("{}:{:02}:{:02}", s / 3600, s / 60 % 60, s % 60);
}

double ratio(double part, double whole) { return whole > 0 ? part / whole : 0; }

void add_sections(std::string& out, const std::vector<decomp::Timers::Row>& regions, double total) {
  const auto to = std::back_inserter(out);
  fmt::format_to(to, "{:<10} {:>10} {:>10} {:>10} {:>6} {:>6} | {}\n", "Section", "min [s]", "avg [s]",
                 "max [s]", "%var", "%total", "calls");
  for (const decomp::Timers::Row& row : regions) {
    if (row.calls == 0 && row.max == 0) continue;
    const double spread = std::max(row.max - row.mean, row.mean - row.min);
    fmt::format_to(to, "{:<10} {:>10.3f} {:>10.3f} {:>10.3f} {:>6.1f} {:>6.1f} | {}\n",
                   decomp::name_of(row.region), row.min, row.mean, row.max, 100 * ratio(spread, row.mean),
                   100 * ratio(row.mean, total), row.calls);
  }
}

}  // namespace

std::string status_line(const Status& s) {
  return fmt::format("step {}  t {:.6g} s  dt {}  {} upd/s  imb {:.2f}  Ekin {:.2e} J  left {}",
                     s.global.step, s.global.time, short_exponent(s.global.dt),
                     short_exponent(s.particle_steps_per_second), s.imbalance, s.kinetic_energy,
                     hours_minutes_seconds(s.seconds_left));
}

std::string final_table(const Performance& p) {
  double total = 0;
  double order = 0;
  for (const decomp::Timers::Row& row : p.regions) {
    total += row.mean;
    if (row.region == decomp::Region::order) order = row.mean;
  }
  const double updates =
      ratio(static_cast<double>(p.loop.particles) * static_cast<double>(p.loop.steps), p.loop.wall_seconds) /
      1e6;

  std::string out;
  const auto to = std::back_inserter(out);
  fmt::format_to(to,
                 "Loop {:.1f} s  {} ranks  {} steps  {:.3g} particles  {:.3g} Mupd/s  {:.3g} Mupd/s/rank  "
                 "imbalance {:.2f}\n",
                 p.loop.wall_seconds, p.loop.ranks, p.loop.steps, static_cast<double>(p.loop.particles),
                 updates, ratio(updates, p.loop.ranks), p.loop.imbalance);
  add_sections(out, p.regions, total);
  fmt::format_to(to, "work done only for the bits: {:.3f} s ({:.1f} %)\n", order, 100 * ratio(order, total));
  fmt::format_to(to,
                 "per particle: {:.1f} neighbours listed, {:.1f} within the support, {:.2f} halo copies\n",
                 p.neighbours.listed, p.neighbours.within_support, p.neighbours.halo_copies);
  fmt::format_to(to,
                 "bytes per particle: {:.0f} ({:.0f} state), per halo particle {:.0f}; halo messages {:.3g} "
                 "bytes/step\n",
                 p.bytes.per_particle, p.bytes.state_per_particle, p.bytes.per_halo_particle,
                 p.bytes.halo_per_step);
  if (p.events.iterations > 0)
    fmt::format_to(to, "viscosity: {:.1f} iterations a step\n",
                   static_cast<double>(p.events.iterations) / static_cast<double>(p.loop.steps));
  fmt::format_to(to, "list rebuilds {}  migrated {}  halo refreshes {}\n", p.events.rebuilds,
                 p.events.migrated, p.events.refreshes);
  for (const OpeningCount& opening : p.openings)
    fmt::format_to(to, "{} {} particles, {:.6g} kg\n", opening.name, opening.count, opening.mass);
  if (p.balance.calls > 0)
    fmt::format_to(
        to, "balance asked {} times, cuts moved {} times, {:.3f} s of deciding, {:.3f} of migrating; {}\n",
        p.balance.calls, p.balance.moves, p.balance.seconds, p.balance.migrating,
        p.balance.over_optimum > 0
            ? fmt::format("largest part {:.2f} of the best cuts'", p.balance.over_optimum)
            : "not compared with the best cuts");
  return out;
}

}  // namespace sph

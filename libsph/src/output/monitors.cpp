#include "sph/output/monitors.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <optional>
#include <span>

#include "core/budget.hpp"
#include "output/flux.hpp"
#include "output/gauge.hpp"
#include "output/monitor_units.hpp"
#include "output/nearest_particle.hpp"
#include "output/particle_values.hpp"
#include "output/wall_values.hpp"
#include "sph/core/error.hpp"
#include "sph/models/energies.hpp"
#include "sph/output/contact_records.hpp"

namespace sph {
namespace {

/// Those that some model counts.
std::vector<Energy> energies_of(const State& s) {
  std::vector<Energy> out;
  for (const Model* m : s.models())
    for (Energy e : m->energies())
      if (std::ranges::find(out, e) == out.end()) out.push_back(e);
  std::ranges::sort(out);
  return out;
}

/// Led by an inlet: not yet in.
bool is_led(const Scene& scene, const Particles& p, std::size_t row) {
  const std::uint32_t* buffer = p.data<Field::buffer>();
  return buffer != nullptr && buffer[row] != 0 && buffer[row] <= scene.domain.openings.inlets.size();
}

/// Names of what a budget counts, and of what of it has passed openings.
std::vector<std::string> budget_names(const State& s) {
  std::vector<std::string> out = Budget::names(s.particles());
  if (!s.scene().domain.openings.any()) return out;
  const std::size_t own = out.size();
  for (std::size_t k = 1; k < own; ++k) out.push_back(out[k] + "_through");
  out.insert(out.end(), {"mass_in", "mass_out", "n_in", "n_out"});
  return out;
}

/// What has come in so far, less what has left; mass and numbers apart.
void append_passages(const State& s, std::vector<double>& to) {
  if (!s.scene().domain.openings.any()) return;
  const OpeningControl& openings = s.scene().domain.openings;
  const std::size_t own = Budget::names(s.particles()).size();
  std::array<Passage, 2> all;  // in, out
  const std::vector<Passage>& passages = s.global().throughput.passages;
  for (std::size_t k = 0; k < passages.size(); ++k) {
    Passage& sum = all[openings.comes_in(k) ? 0 : 1];
    sum.count += passages[k].count;
    for (std::size_t q = 0; q < own; ++q) sum.amounts[q] += passages[k].amounts[q];
  }
  for (std::size_t q = 1; q < own; ++q) to.push_back(all[0].amounts[q] - all[1].amounts[q]);
  to.insert(to.end(), {all[0].amounts[0], all[1].amounts[0], static_cast<double>(all[0].count),
                       static_cast<double>(all[1].count)});
}

bool is_gauge(const Monitor& m) { return m.kind == MonitorKind::gauge || m.kind == MonitorKind::level; }

std::size_t sums_of(const Monitor& monitor, const State& s) {
  const Particles& p = s.particles();
  switch (monitor.kind) {
    case MonitorKind::group:
      return 2 + ParticleValues::count(p);  // number, mass, moments
    case MonitorKind::energy:
      return energies_of(s).size();
    case MonitorKind::momentum:
      return static_cast<std::size_t>(p.dim());
    case MonitorKind::budget:
      return Budget::names(p).size();
    case MonitorKind::contacts:
      return 3;  // contacts of grains, with what is held, number of grains
    case MonitorKind::flux:
      return Flux::sums;
    case MonitorKind::particle:
    case MonitorKind::wall:
    case MonitorKind::body:
    case MonitorKind::melt:
    case MonitorKind::gauge:
    case MonitorKind::level:
      break;
  }
  return 0;
}

void add_row(const Scene& scene, const Monitor& monitor, const ParticleValues& of, std::size_t row,
             std::span<decomp::ExactSum> sums) {
  const double m = of.mass(row);
  if (monitor.kind == MonitorKind::group) {
    if (static_cast<int>(of.group(row)) != monitor.group) return;
    std::array<double, 16> value{};
    of.all(row, value);
    sums[0].add(1);
    sums[1].add(m);
    for (std::size_t k = 0; k + 2 < sums.size(); ++k) sums[k + 2].add(m * value[k]);
    return;
  }
  const Group& group = scene.groups[of.group(row)];
  if (is_held(group)) return;
  if (monitor.kind == MonitorKind::budget) {
    const std::vector<std::string> names =
        is_led(scene, of.particles(), row) ? Budget::names(of.particles()) : std::vector<std::string>{};
    std::size_t k = 0;
    Budget::visit(of.particles(), row, [&](double amount) {
      if (names.empty() || Budget::is_inflow(names[k])) sums[k].add(amount);
      ++k;
    });
  } else if (monitor.kind == MonitorKind::contacts) {
    if (group.kind == GroupKind::grain) sums[2].add(1);
  } else if (monitor.kind == MonitorKind::momentum) {
    for (std::size_t a = 0; a < sums.size(); ++a) sums[a].add(m * of.velocity(row, a));
  }
}

void add_energies(const State& s, std::span<decomp::ExactSum> sums) {
  EnergySums all;
  for (const Model* m : s.models()) m->add_energies(s.particles(m->set()), all);
  std::size_t k = 0;
  for (Energy e : energies_of(s)) sums[k++].add(all[e]);
}

/// Of fluids, solids and grains, whichever set they are in.
template <class PartOf>
void add_fluxes(const Simulation& s, const std::vector<Monitor>& monitors, PartOf&& part) {
  for (std::size_t k = 0; k < monitors.size(); ++k) {
    if (monitors[k].kind != MonitorKind::flux) continue;
    const Flux flux(s, monitors[k]);
    for (const ParticleSet& set : s.sets()) {
      const ParticleValues of(s, set.particles);
      for (std::size_t row = 0; row < set.particles.owned(); ++row) flux.add(of, row, part(k));
    }
  }
}

void add_contact(const Monitor& monitor, const ContactRecord& contact, std::span<decomp::ExactSum> sums) {
  if (monitor.kind == MonitorKind::energy) sums.back().add(contact.energy);
  if (monitor.kind == MonitorKind::contacts) sums[contact.with_wall() || contact.fixed ? 1 : 0].add(1);
}

bool looks_at_contacts(const Scene& scene, const Monitor& monitor) {
  return scene.has_grains() && (monitor.kind == MonitorKind::contacts || monitor.kind == MonitorKind::energy);
}

/// The values of the chosen particles, one after the other; nan of one that is gone. Bits travel unchanged: all
/// but the owner have zeros.
std::vector<double> values_of(const Simulation& s, const ParticleValues& of,
                              const std::vector<std::uint64_t>& ids) {
  const std::size_t n = ParticleValues::count(s.particles());
  std::vector<std::uint64_t> bits((n + 1) * ids.size(), 0);
  std::vector<double> value(n);
  const std::uint64_t* id = s.particles().data<Field::id>();
  for (std::size_t row = 0; row < s.particles().owned(); ++row)
    for (std::size_t k = 0; k < ids.size(); ++k) {
      if (id[row] != ids[k]) continue;
      of.all(row, value);
      for (std::size_t c = 0; c < n; ++c) bits[k * n + c] = std::bit_cast<std::uint64_t>(value[c]);
      bits[n * ids.size() + k] = 1;
    }
  if (!bits.empty()) s.comm().bit_xor(bits);
  std::vector<double> out;
  for (std::size_t c = 0; c < n * ids.size(); ++c)
    out.push_back(bits[n * ids.size() + c / n] == 1 ? std::bit_cast<double>(bits[c])
                                                    : std::numeric_limits<double>::quiet_NaN());
  return out;
}

}  // namespace

Monitors::Monitors(const Simulation& s, const std::vector<std::optional<std::uint64_t>>& known) {
  for (const Monitor& m : s.scene().output.monitors) {
    if (m.kind != MonitorKind::particle) continue;
    if (const std::size_t k = ids_.size(); k < known.size() && known[k]) {
      ids_.push_back(*known[k]);
      continue;
    }
    if (m.nearest_to) {
      ids_.push_back(nearest_particle(s, *m.nearest_to));
      continue;
    }
    const std::uint64_t* id = s.particles().data<Field::id>();
    std::int64_t found = 0;
    for (std::size_t row = 0; row < s.particles().owned(); ++row) found += id[row] == *m.id ? 1 : 0;
    if (s.comm().sum(found) == 0)
      throw InputError(s.scene().file + ": monitor." + m.name + ".id: there is no particle " +
                       std::to_string(*m.id) + "; name an existing one, or use nearest_to");
    ids_.push_back(*m.id);
  }
  make_names(s);
}

void Monitors::make_names(const Simulation& s) {
  for (const Monitor& m : s.scene().output.monitors) {
    std::vector<std::string> quantities = ParticleValues::names(s.particles());
    if (m.kind == MonitorKind::group) quantities.insert(quantities.begin(), "n");
    if (m.kind == MonitorKind::energy) {
      quantities.clear();
      for (Energy e : energies_of(s)) quantities.emplace_back(energy_names[static_cast<std::size_t>(e)]);
    }
    if (m.kind == MonitorKind::wall) quantities = {"x", "y", "z", "vx", "vy", "vz", "fx", "fy", "fz"};
    if (m.kind == MonitorKind::body) quantities = names_of_body(s.scene().dim);
    if (m.kind == MonitorKind::contacts) quantities = {"n", "walls", "z"};
    if (m.kind == MonitorKind::momentum) {
      quantities = {"px", "py", "pz"};
      quantities.resize(static_cast<std::size_t>(s.scene().dim));
    }
    if (m.kind == MonitorKind::budget) quantities = budget_names(s);
    if (is_gauge(m)) quantities = Gauge::names(s, m);
    if (m.kind == MonitorKind::melt) quantities = s.melt()->columns();
    if (m.kind == MonitorKind::flux) quantities = Flux::names();
    for (const std::string& quantity : quantities) {
      const std::string name = m.name + "_" + quantity;
      if (std::ranges::find(names_, name) != names_.end())
        throw InputError(
            fmt::format("monitor.{}.name: \"{}\" would be two columns of series.csv; give it another name",
                        m.name, name));
      names_.push_back(name);
      units_.push_back(unit_of(m.kind, quantity, s.scene().dim));
    }
  }
}

std::vector<double> Monitors::values(Simulation& s) const {
  const std::vector<Monitor>& monitors = s.scene().output.monitors;
  const bool contacts = std::any_of(monitors.begin(), monitors.end(),
                                    [&](const Monitor& m) { return looks_at_contacts(s.scene(), m); });
  if (contacts) s.refresh_contacts();  // may move rows

  const ParticleValues of(s);
  std::vector<std::size_t> first{0};
  std::vector<std::optional<Gauge>> gauges(monitors.size());
  for (std::size_t k = 0; k < monitors.size(); ++k) {
    if (is_gauge(monitors[k])) gauges[k].emplace(s, monitors[k]);
    first.push_back(first.back() + (gauges[k] ? gauges[k]->sums() : sums_of(monitors[k], s)));
  }
  std::vector<decomp::ExactSum> sums(first.back());
  const auto part = [&](std::size_t k) { return std::span(sums).subspan(first[k], first[k + 1] - first[k]); };
  for (std::size_t row = 0; row < s.particles().owned(); ++row)
    for (std::size_t k = 0; k < monitors.size(); ++k)
      if (gauges[k])
        gauges[k]->add(of, row, part(k));
      else if (first[k + 1] > first[k])
        add_row(s.scene(), monitors[k], of, row, part(k));
  add_fluxes(s, monitors, part);
  for (std::size_t k = 0; k < monitors.size(); ++k)
    if (monitors[k].kind == MonitorKind::energy) add_energies(s, part(k));
  if (contacts)
    for_each_contact(s, [&](const ContactRecord& contact) {
      for (std::size_t k = 0; k < monitors.size() && contact.counted; ++k)
        add_contact(monitors[k], contact, part(k));
    });
  if (!sums.empty()) decomp::ExactSum::all_reduce(s.comm(), sums);
  const std::vector<double> chosen = values_of(s, of, ids_);

  std::vector<double> out;
  auto particle = chosen.begin();
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  for (std::size_t k = 0; k < monitors.size(); ++k) {
    std::vector<double> sum;
    for (const decomp::ExactSum& exact : part(k)) sum.push_back(exact.value());
    switch (monitors[k].kind) {
      case MonitorKind::particle: {
        const auto n = static_cast<std::ptrdiff_t>(ParticleValues::count(s.particles()));
        out.insert(out.end(), particle, particle + n);
        particle += n;
        break;
      }
      case MonitorKind::group:
        out.push_back(sum[0]);
        for (std::size_t q = 2; q < sum.size(); ++q) out.push_back(sum[0] > 0 ? sum[q] / sum[1] : none);
        break;
      case MonitorKind::wall:
        for (double value : values_of_wall(s, monitors[k].wall)) out.push_back(value);
        break;
      case MonitorKind::body:
        for (double value : values_of_body(s, monitors[k].group)) out.push_back(value);
        break;
      case MonitorKind::melt:
        for (double value : s.melt()->values(s.particles(s.melt()->set()), s.global())) out.push_back(value);
        break;
      case MonitorKind::contacts:
        out.insert(out.end(), {sum[0], sum[1], sum[2] > 0 ? (2 * sum[0] + sum[1]) / sum[2] : none});
        break;
      case MonitorKind::energy:
      case MonitorKind::momentum:
      case MonitorKind::flux:
        out.insert(out.end(), sum.begin(), sum.end());
        break;
      case MonitorKind::budget:
        out.insert(out.end(), sum.begin(), sum.end());
        append_passages(s, out);
        break;
      case MonitorKind::gauge:
      case MonitorKind::level:
        gauges[k]->append(sum, out);
    }
  }
  return out;
}

double kinetic_energy(const Simulation& s) {
  decomp::ExactSum sum;
  for (const ParticleSet& set : s.sets()) {
    const Particles& p = set.particles;
    for (std::size_t row = 0; row < p.owned(); ++row)
      if (!is_held(s.scene().groups[p.data<Field::group>()[row]])) sum.add(kinetic_energy(p, row));
  }
  decomp::ExactSum::all_reduce(s.comm(), std::span(&sum, 1));
  return sum.value();
}

}  // namespace sph

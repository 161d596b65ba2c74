#include "sph/monitors.hpp"

#include <bit>
#include <cmath>
#include <limits>
#include <span>

#include "output/nearest_particle.hpp"
#include "output/particle_values.hpp"
#include "sph/exact_math.hpp"

namespace sph {
namespace {

/// rho_0/K times the energy of compression per mass: ln(1+s) - s/(1+s), s = rho/rho_0 - 1. The closed form
/// cancels for small s, where its series sum (-1)^k (k-1)/k s^k is good to rounding.
double compression(double s) {
  constexpr double small = 0.03125;
  constexpr int last_power = 12;
  if (!(std::fabs(s) < small)) return exact_log(1 + s) - s / (1 + s);
  double sum = 0;
  for (int k = last_power; k >= 2; --k) sum = (k % 2 == 0 ? 1.0 : -1.0) * (k - 1) / k + s * sum;
  return s * s * sum;
}

double elastic_energy(const Scene& scene, const ParticleValues& of, std::size_t row) {
  if (scene.of_grains()) return 0;
  const Particles& p = of.particles();
  const auto d = static_cast<std::size_t>(p.dim());
  const Group& g = scene.groups[of.group(row)];
  const double m = of.mass(row), rho = p.data<Field::density>()[row];
  double energy = 0;
  if (g.eos == EosKind::linear)
    energy += m * (g.bulk_modulus / g.density) * compression((rho - g.density) / g.density);
  if (g.kind != GroupKind::solid || scene.formulation != Formulation::conservative) return energy;
  const std::size_t n = d * (d + 1) / 2;
  const double* s = p.data<Field::stress>() + row * n;
  double product = d == 2 ? (s[0] + s[1]) * (s[0] + s[1]) : 0.0;  // of the zz component in plane strain
  for (std::size_t k = 0; k < n; ++k) product += (k < d ? 1.0 : 2.0) * (s[k] * s[k]);
  return energy + m / rho * product / (4 * g.shear_modulus);
}

double kinetic_energy(const ParticleValues& of, std::size_t row) {
  double v2 = 0;
  for (int a = 0; a < of.particles().dim(); ++a) {
    const double v = of.velocity(row, static_cast<std::size_t>(a));
    v2 += v * v;
  }
  return 0.5 * of.mass(row) * v2;
}

double potential_energy(const Scene& scene, const ParticleValues& of, std::size_t row) {
  double work = 0;
  for (int axis = 0; axis < scene.dim; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    work += scene.gravity[a] * of.position(row, a);
  }
  return -of.mass(row) * work;
}

std::size_t sums_of(const Monitor& monitor, const Particles& p) {
  switch (monitor.kind) {
    case MonitorKind::group:
      return 2 + ParticleValues::count(p);  // number, mass, moments
    case MonitorKind::energy:
      return 3;
    case MonitorKind::momentum:
      return static_cast<std::size_t>(p.dim());
    case MonitorKind::particle:
    case MonitorKind::wall:
    case MonitorKind::contacts:
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
  if (scene.groups[of.group(row)].kind == GroupKind::wall) return;
  if (monitor.kind == MonitorKind::energy) {
    sums[0].add(kinetic_energy(of, row));
    sums[1].add(potential_energy(scene, of, row));
    sums[2].add(elastic_energy(scene, of, row));
  } else {
    for (std::size_t a = 0; a < sums.size(); ++a) sums[a].add(m * of.velocity(row, a));
  }
}

/// The values of the chosen particles, one after the other. Bits travel unchanged: all but the owner have
/// zeros.
std::vector<double> values_of(const Simulation& s, const ParticleValues& of,
                              const std::vector<std::uint64_t>& ids) {
  const std::size_t n = ParticleValues::count(s.particles());
  std::vector<std::uint64_t> bits(n * ids.size(), 0);
  std::vector<double> value(n);
  const std::uint64_t* id = s.particles().data<Field::id>();
  for (std::size_t row = 0; row < s.particles().owned(); ++row)
    for (std::size_t k = 0; k < ids.size(); ++k) {
      if (id[row] != ids[k]) continue;
      of.all(row, value);
      for (std::size_t c = 0; c < n; ++c) bits[k * n + c] = std::bit_cast<std::uint64_t>(value[c]);
    }
  if (!bits.empty()) s.comm().bit_xor(bits);
  std::vector<double> out;
  for (std::uint64_t b : bits) out.push_back(std::bit_cast<double>(b));
  return out;
}

}  // namespace

Monitors::Monitors(const Simulation& s) {
  for (const Monitor& m : s.scene().output.monitors) {
    if (m.kind != MonitorKind::particle) continue;
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

Monitors::Monitors(const Simulation& s, std::vector<std::uint64_t> ids) : ids_(std::move(ids)) {
  make_names(s);
}

void Monitors::make_names(const Simulation& s) {
  for (const Monitor& m : s.scene().output.monitors) {
    std::vector<std::string> quantities = ParticleValues::names(s.particles());
    if (m.kind == MonitorKind::group) quantities.insert(quantities.begin(), "n");
    if (m.kind == MonitorKind::energy) quantities = {"kinetic", "potential", "elastic"};
    if (m.kind == MonitorKind::momentum) {
      quantities = {"px", "py", "pz"};
      quantities.resize(static_cast<std::size_t>(s.scene().dim));
    }
    for (const std::string& quantity : quantities) names_.push_back(m.name + "_" + quantity);
  }
}

std::vector<double> Monitors::values(const Simulation& s) const {
  const std::vector<Monitor>& monitors = s.scene().output.monitors;
  const ParticleValues of(s);
  std::vector<std::size_t> first{0};
  for (const Monitor& m : monitors) first.push_back(first.back() + sums_of(m, s.particles()));
  std::vector<decomp::ExactSum> sums(first.back());
  for (std::size_t row = 0; row < s.particles().owned(); ++row)
    for (std::size_t k = 0; k < monitors.size(); ++k)
      if (first[k + 1] > first[k])
        add_row(s.scene(), monitors[k], of, row, std::span(sums).subspan(first[k], first[k + 1] - first[k]));
  if (!sums.empty()) decomp::ExactSum::all_reduce(s.comm(), sums);
  const std::vector<double> chosen = values_of(s, of, ids_);

  std::vector<double> out;
  auto particle = chosen.begin();
  for (std::size_t k = 0; k < monitors.size(); ++k) {
    if (monitors[k].kind == MonitorKind::particle) {
      const auto n = static_cast<std::ptrdiff_t>(ParticleValues::count(s.particles()));
      out.insert(out.end(), particle, particle + n);
      particle += n;
    } else if (monitors[k].kind == MonitorKind::group) {
      const double number = sums[first[k]].value(), mass = sums[first[k] + 1].value();
      out.push_back(number);
      for (std::size_t q = first[k] + 2; q < first[k + 1]; ++q)
        out.push_back(number > 0 ? sums[q].value() / mass : std::numeric_limits<double>::quiet_NaN());
    } else {
      for (std::size_t q = first[k]; q < first[k + 1]; ++q) out.push_back(sums[q].value());
    }
  }
  return out;
}

double kinetic_energy(const Simulation& s) {
  const ParticleValues of(s);
  decomp::ExactSum sum;
  for (std::size_t row = 0; row < s.particles().owned(); ++row)
    if (s.scene().groups[of.group(row)].kind != GroupKind::wall) sum.add(kinetic_energy(of, row));
  decomp::ExactSum::all_reduce(s.comm(), std::span(&sum, 1));
  return sum.value();
}

}  // namespace sph

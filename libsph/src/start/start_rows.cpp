#include "start/start_rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <fstream>

#include "sph/laws/eos/law.hpp"

namespace sph {
namespace {

bool is_hdf5(const std::string& path) {
  std::array<char, 4> start{};
  std::ifstream(path, std::ios::binary).read(start.data(), start.size());
  return std::memcmp(start.data(), "\x89HDF", start.size()) == 0;
}

void check_finite(const StartRows& rows, std::size_t k, const char* column, const std::vector<double>& values,
                  std::size_t components) {
  if (values.empty()) return;
  for (std::size_t c = 0; c < components; ++c)
    if (!std::isfinite(values[k * components + c]))
      fail_row(rows, k, fmt::format("{} is not finite", column));
}

/// Lists and cells are made for the radii that the scene names.
void check_radius(const StartRows& rows, std::size_t k, const Group& group) {
  if (rows.grains.radius.empty()) return;
  const double r = rows.grains.radius[k];
  if (!(r > 0)) fail_row(rows, k, fmt::format("radius is {}; it must be positive", r));
  const GrainMaterial& g = group.grain;
  if (!(g.largest_radius > 0))
    fail_row(rows, k, fmt::format("group \"{}\" has no diameter in the scene: it is for walls", group.name));
  if (r < g.least_radius || r > g.largest_radius)
    fail_row(rows, k,
             fmt::format("radius is {} m; half the diameter of group \"{}\" is {}", r, group.name,
                         g.least_radius == g.largest_radius
                             ? fmt::format("{} m", g.largest_radius)
                             : fmt::format("{} to {} m", g.least_radius, g.largest_radius)));
}

}  // namespace

StartRows read_rows(const Scene& scene, const std::string& file, int rank, int ranks) {
  return is_hdf5(file) ? read_hdf5_rows(scene, file, rank, ranks) : read_csv_rows(scene, file, rank, ranks);
}

std::int64_t count_rows(const std::string& file) {
  return is_hdf5(file) ? count_hdf5_rows(file) : count_csv_rows(file);
}

void fail_row(const StartRows& rows, std::size_t k, const std::string& what) {
  throw RowProblem(rows.number[k], fmt::format("{} {}: {}", rows.unit, rows.number[k], what));
}

void check_row(const StartRows& rows, std::size_t k, const Scene& scene) {
  const auto d = static_cast<std::size_t>(scene.dim);
  if (rows.id[k] > largest_id)
    fail_row(rows, k, fmt::format("id is {}; it must be at most 2^63 - 1 = {}", rows.id[k], largest_id));
  check_finite(rows, k, "x", rows.position.x, d);
  check_finite(rows, k, "v", rows.v, d);
  check_finite(rows, k, "rho", rows.matter.rho, 1);
  check_finite(rows, k, "m", rows.matter.gas, 1);
  check_finite(rows, k, "u", rows.matter.energy, 1);
  check_finite(rows, k, "T", rows.matter.temperature, 1);
  check_finite(rows, k, "mass", rows.matter.mass, 1);
  check_finite(rows, k, "stress", rows.matter.stress, d * (d + 1) / 2);
  check_finite(rows, k, "radius", rows.grains.radius, 1);
  check_finite(rows, k, "spin", rows.grains.spin, d);
  if (rows.group[k] >= scene.groups.size())
    fail_row(rows, k,
             fmt::format("group {} is not in the scene, which has {}", rows.group[k], scene.groups.size()));
  if (!rows.matter.rho.empty() && !(rows.matter.rho[k] > 0))
    fail_row(rows, k, fmt::format("rho is {}; it must be positive", rows.matter.rho[k]));
  if (!rows.matter.mass.empty() && !(rows.matter.mass[k] > 0))
    fail_row(rows, k, fmt::format("mass is {}; it must be positive", rows.matter.mass[k]));
  if (!rows.matter.gas.empty() && !(rows.matter.gas[k] >= 0 && rows.matter.gas[k] < 1))
    fail_row(rows, k, fmt::format("m is {}; it must be at least 0 and below 1", rows.matter.gas[k]));
  if (!rows.matter.energy.empty() && scene.groups[rows.group[k]].eos.law->kind == EosKind::ideal_gas &&
      !(rows.matter.energy[k] > 0))
    fail_row(rows, k, fmt::format("u is {}; it must be positive", rows.matter.energy[k]));
  if (!rows.matter.temperature.empty() && !(rows.matter.temperature[k] >= 0))
    fail_row(rows, k, fmt::format("T is {} K; it must not be negative", rows.matter.temperature[k]));
  check_radius(rows, k, scene.groups[rows.group[k]]);
  // Far outside, the coordinate in quanta would overflow.
  constexpr double periods = 2;
  for (std::size_t a = 0; a < d; ++a) {
    const double x = rows.position.quanta.empty()
                         ? rows.position.x[k * d + a]
                         : static_cast<double>(rows.position.quanta[k * d + a]) * rows.position.quantum;
    const double margin = periods * (scene.domain.upper[a] - scene.domain.lower[a]);
    if (!(x >= scene.domain.lower[a] - margin && x <= scene.domain.upper[a] + margin))
      fail_row(rows, k, fmt::format("particle {} lies outside the domain", rows.id[k]));
  }
}

decomp::Int3 quanta_of(const StartRows& rows, std::size_t k, const PositionScale& scale, int dim) {
  const auto d = static_cast<std::size_t>(dim);
  decomp::Int3 out{};
  for (std::size_t a = 0; a < d; ++a) {
    if (rows.position.quanta.empty())
      out[a] = scale.quanta(rows.position.x[k * d + a]);
    else if (rows.position.quantum == scale.quantum)
      out[a] = rows.position.quanta[k * d + a];
    else
      out[a] = scale.quanta(static_cast<double>(rows.position.quanta[k * d + a]) * rows.position.quantum);
  }
  return out;
}

namespace {

/// By the equation of state.
double pressure_at(const Group& g, double density) {
  double pressure = 0;
  g.eos.law->derive(g, {&density, nullptr, nullptr, nullptr, &pressure, nullptr, nullptr, 0}, 0, 1);
  return pressure;
}

}  // namespace

void add_row(const StartRows& rows, std::size_t k, std::uint64_t id, const decomp::Int3& quanta,
             const InitialFields& fields, const Scene& scene, const PositionScale& scale,
             Particles& particles) {
  const auto d = static_cast<std::size_t>(scene.dim), n = d * (d + 1) / 2;
  NewParticle p{id, {}, {}, rows.group[k], 0, 0};
  for (std::size_t a = 0; a < d; ++a) p.position[a] = scale.metres(quanta[a]);
  if (!rows.grains.radius.empty()) p.radius = rows.grains.radius[k];
  fields.set(p);
  const bool fixed = scene.groups[p.group].grain.fixed;
  for (std::size_t a = 0; a < d && !fixed; ++a) {
    p.velocity[a] = rows.v[k * d + a];
    if (!rows.grains.spin.empty()) p.spin[a] = rows.grains.spin[k * d + a];
  }
  if (!rows.matter.rho.empty()) {
    p.energy *= p.density / rows.matter.rho[k];  // at the same pressure
    p.density = rows.matter.rho[k];
    p.mass = p.density * particle_volume(scene);  // as on a lattice, to the bit
    if (is_bonded(scene.groups[p.group])) p.prestress += pressure_at(scene.groups[p.group], p.density);
  }
  if (!rows.matter.energy.empty() && p.energy > 0) p.energy = rows.matter.energy[k];
  if (!rows.matter.mass.empty()) p.mass = rows.matter.mass[k];
  append(scene, p, quanta, particles);
  const std::size_t i = particles.owned() - 1;
  if (auto* m = particles.data<Field::gas_content>(); m != nullptr && !rows.matter.gas.empty())
    m[i] = rows.matter.gas[k];
  if (auto* t = particles.data<Field::temperature>();
      t != nullptr && !rows.matter.temperature.empty() && scene.groups[p.group].kind != GroupKind::wall)
    t[i] = rows.matter.temperature[k];
  if (auto* s = particles.data<Field::stress>(); s != nullptr && !rows.matter.stress.empty())
    std::copy_n(rows.matter.stress.data() + k * n, n, s + i * n);
}

}  // namespace sph

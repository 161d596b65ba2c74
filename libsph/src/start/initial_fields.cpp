#include "start/initial_fields.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "physics/random.hpp"
#include "sph/eos.hpp"
#include "sph/exact_math.hpp"
#include "sph/grain_mass.hpp"

namespace sph {
namespace {

constexpr std::uint64_t radius_stream = 3;  // 0 to 2: jitter in x, y, z

const Group& first_fluid(const Scene& scene) {
  for (const Group& g : scene.groups)
    if (g.kind == GroupKind::fluid) return g;
  return scene.groups.front();
}

/// Of still layers, above the surface pressure: in each dp/dd = rho g along the depth d with
/// rho = rho_0 (1 + p/K), hence p = (K + p_top) (exp(rho_0 g (d - d_top) / K) - 1) + p_top.
double hydrostatic_pressure(const Scene& scene, const Double3& x) {
  double g2 = 0, height = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    g2 += scene.gravity[a] * scene.gravity[a];
    height -= scene.gravity[a] * x[a];
  }
  const double g = std::sqrt(g2);
  if (g == 0) return 0;
  height /= g;
  const std::vector<Layer>& layers = scene.start.layers;
  double top = 0;  // pressure
  for (std::size_t k = 0;; ++k) {
    const bool within = k + 1 == layers.size() || height >= layers[k + 1].top;
    const Group& fluid = scene.groups[static_cast<std::size_t>(layers[k].group)];
    const double depth = layers[k].top - (within ? height : layers[k + 1].top);
    const double grown = (fluid.bulk_modulus + scene.surface_pressure + top) *
                         (exact_exp(fluid.density * g * depth / fluid.bulk_modulus) - 1);
    if (within) return top + grown;
    top += grown;
  }
}

/// Pressure above the surface pressure.
double initial_pressure(const Scene& scene, const Double3& x) {
  switch (scene.start.pressure) {
    case InitialPressure::hydrostatic:
      return hydrostatic_pressure(scene, x);
    case InitialPressure::taylor_green: {
      const double k = 4 * std::numbers::pi / scene.start.flow_length;
      const double u = scene.start.flow_speed;
      return -0.25 * first_fluid(scene).density * u * u * (exact_cos(k * x[0]) + exact_cos(k * x[1]));
    }
    case InitialPressure::zero:
      break;
  }
  return 0;
}

}  // namespace

void displace_by_jitter(const Scene& scene, NewParticle& p) {
  if (scene.start.jitter == 0) return;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    p.position[a] += scene.start.jitter * scene.spacing * uniform_minus_one_to_one(scene.start.seed, p.id, a);
}

double random_radius(const Scene& scene, const NewParticle& p) {
  const GrainMaterial& grain = scene.groups[p.group].grain;
  const double u = 0.5 * (uniform_minus_one_to_one(scene.start.seed, p.id, radius_stream) + 1);
  return std::min(grain.least_radius + (grain.largest_radius - grain.least_radius) * u, grain.largest_radius);
}

void set_initial_fields(const Scene& scene, NewParticle& p) {
  const Group& g = scene.groups[p.group];
  if (g.kind == GroupKind::grain) {
    p.mass = grain_mass(g.density, p.radius);
    if (g.grain.fixed)
      p.velocity = g.wall_velocity;
    else if (scene.start.velocity == InitialVelocity::uniform)
      p.velocity = scene.start.uniform_velocity;
    return;
  }
  const Double3& x = p.position;
  double volume = 1;
  for (int a = 0; a < scene.dim; ++a) volume *= scene.spacing;

  if (g.kind == GroupKind::wall && scene.formulation == Formulation::conservative) {
    p.density = g.density;
    p.velocity = g.wall_velocity;
  } else {
    const double pressure = initial_pressure(scene, x) + scene.surface_pressure;
    if (g.eos == EosKind::bubbly)
      p.density = bubbly_eos(g, g.gas_content).density(pressure);
    else if (g.eos == EosKind::ideal_gas)
      p.density = g.density;
    else
      p.density = g.density * (1 + pressure / g.bulk_modulus);
    if (g.eos == EosKind::ideal_gas)
      p.energy = IdealGas{g.heat_ratio}.energy(g.start_pressure + initial_pressure(scene, x), g.density);
    if (g.kind == GroupKind::wall) {
      p.velocity = g.wall_velocity;
    } else if (scene.start.velocity == InitialVelocity::uniform) {
      p.velocity = scene.start.uniform_velocity;
    } else if (scene.start.velocity == InitialVelocity::taylor_green) {
      // u = -U cos(kx) sin(ky), v = U sin(kx) cos(ky), k = 2 pi / L: decays as exp(-2 nu k^2 t)
      const double k = 2 * std::numbers::pi / scene.start.flow_length, u = scene.start.flow_speed;
      p.velocity = {-u * exact_cos(k * x[0]) * exact_sin(k * x[1]),
                    u * exact_sin(k * x[0]) * exact_cos(k * x[1]), 0};
    }
  }
  p.mass = p.density * volume;
}

void append(const Scene& scene, const NewParticle& p, const decomp::Int3& quanta, Particles& particles) {
  const std::size_t i = particles.owned(), d = static_cast<std::size_t>(scene.dim);
  particles.table().resize(i + 1, 0);
  particles.data<Field::id>()[i] = p.id;
  for (std::size_t a = 0; a < d; ++a) {
    particles.data<Field::position>()[i * d + a] = quanta[a];
    particles.data<Field::velocity>()[i * d + a] = p.velocity[a];
  }
  if (auto* density = particles.data<Field::density>()) density[i] = p.density;
  particles.data<Field::mass>()[i] = p.mass;
  particles.data<Field::group>()[i] = p.group;
  if (auto* m = particles.data<Field::gas_content>()) m[i] = scene.groups[p.group].gas_content;
  if (auto* u = particles.data<Field::specific_energy>()) {
    u[i] = p.energy;
    if (p.energy > 0) particles.data<Field::density>()[i] = 0;  // not summed yet
  }
  if (auto* s = particles.data<Field::stress>())
    for (std::size_t k = 0; k < d * (d + 1) / 2; ++k) s[i * d * (d + 1) / 2 + k] = 0;
  if (auto* radius = particles.data<Field::radius>()) radius[i] = p.radius;
  if (auto* spin = particles.data<Field::spin>())
    for (std::size_t a = 0; a < d; ++a) spin[i * d + a] = p.spin[a];
  if (auto* pressure = particles.data<Field::pressure>()) pressure[i] = 0;
  if (auto* bonds = particles.data<Field::bonds>()) bonds[i] = 0;  // not counted yet
  if (auto* u = particles.data<Field::displacement>())
    for (std::size_t a = 0; a < d; ++a) u[i * d + a] = 0;
  if (auto* mean = particles.data<Field::velocity_mean>())
    for (std::size_t a = 0; a < d; ++a) mean[i * d + a] = p.velocity[a];
  if (auto* mean = particles.data<Field::pressure_mean>()) mean[i] = 0;
}

}  // namespace sph

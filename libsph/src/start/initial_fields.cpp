#include "start/initial_fields.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <numbers>

#include "core/random.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/laws/background.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/scene/grain_mass.hpp"
#include "sph/scene/melt_grid.hpp"

namespace sph {
namespace {

constexpr std::uint64_t radius_stream = 3;  // 0 to 2: jitter in x, y, z

const Group& first_fluid(const Scene& scene) {
  for (const Group& g : scene.groups)
    if (g.kind == GroupKind::fluid) return g;
  return scene.groups.front();
}

}  // namespace

void displace(const Scene& scene, double amplitude, NewParticle& p) {
  if (amplitude == 0) return;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
    p.position[a] += amplitude * uniform_minus_one_to_one(scene.start.seed, p.id, a);
}

double random_radius(const Scene& scene, const NewParticle& p) {
  const GrainMaterial& grain = scene.groups[p.group].grain;
  const double u = 0.5 * (uniform_minus_one_to_one(scene.start.seed, p.id, radius_stream) + 1);
  return std::min(grain.least_radius + (grain.largest_radius - grain.least_radius) * u, grain.largest_radius);
}

bool is_occupied(const Scene& scene, const GrainFill& fill, std::uint64_t id) {
  if (fill.occupied == 1) return true;
  // A seed of its own: the streams of start.seed are taken.
  const double u = uniform_minus_one_to_one(decomp::splitmix_mix(scene.start.seed), id, 0);
  return 0.5 * (u + 1) < fill.occupied;
}

InitialFields::InitialFields(const Scene& scene) : scene_(scene), scale_(position_scale(scene)) {
  if (scene.start.pressure == InitialPressure::hydrostatic) hydrostatic_.emplace(scene);
}

double InitialFields::pressure(const Double3& x) const {
  if (hydrostatic_) return (*hydrostatic_)(x);
  if (scene_.start.pressure == InitialPressure::zero) return 0;
  if (scene_.start.pressure == InitialPressure::uniform) return scene_.start.uniform_pressure;
  const double k = 4 * std::numbers::pi / scene_.start.velocity.flow_length,
               u = scene_.start.velocity.flow_speed;
  return -0.25 * first_fluid(scene_).density * u * u * (exact_cos(k * x[0]) + exact_cos(k * x[1]));
}

double InitialFields::pressure_in_place(const Double3& x) const {
  Double3 rounded{};
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene_.dim); ++a)
    rounded[a] = scale_.metres(scale_.quanta(x[a]));
  return pressure(rounded);
}

void InitialFields::set(NewParticle& p) const {
  const Scene& scene = scene_;
  const Group& g = scene.groups[p.group];
  if (g.kind == GroupKind::grain) {
    p.mass = grain_mass(g.density, p.radius);
    if (g.grain.fixed)
      p.velocity = g.wall.velocity;
    else if (scene.start.velocity.kind == InitialVelocity::uniform)
      p.velocity = scene.start.velocity.uniform;
    return;
  }
  const Double3& x = p.position;
  if (g.kind == GroupKind::melt) {
    p.mass = g.density * melt_grid(scene).volume();
    return;
  }

  if (g.kind == GroupKind::wall && scene.terms.formulation == Formulation::conservative) {
    p.density = g.density;
    p.velocity = g.wall.velocity;
  } else {
    // A body is as dense as its group in its reference state, whatever presses on it there.
    if (is_bonded(g)) p.prestress = pressure_in_place(x);
    const EosStart start = g.eos.law->start(g, is_body(g) ? 0.0 : pressure(x), outer_pressure(scene, g, x));
    p.density = start.density;
    p.energy = start.specific_energy;
    if (g.kind == GroupKind::wall) {
      p.velocity = g.wall.velocity;
    } else if (scene.start.velocity.kind == InitialVelocity::uniform) {
      p.velocity = scene.start.velocity.uniform;
    } else if (scene.start.velocity.kind == InitialVelocity::taylor_green) {
      // u = -U cos(kx) sin(ky), v = U sin(kx) cos(ky), k = 2 pi / L: decays as exp(-2 nu k^2 t)
      const double k = 2 * std::numbers::pi / scene.start.velocity.flow_length,
                   u = scene.start.velocity.flow_speed;
      p.velocity = {-u * exact_cos(k * x[0]) * exact_sin(k * x[1]),
                    u * exact_sin(k * x[0]) * exact_cos(k * x[1]), 0};
    }
  }
  p.mass = p.density * particle_volume(scene);
}

namespace {

/// Most of the state starts as 0: means, counts, inflows, stresses, and what is found once all particles are placed.
void set_state_to_zero(Particles& particles, std::size_t i) {
  for (const FieldInfo& info : field_table) {
    if (!info.state || !particles.has(info.field)) continue;
    const std::size_t size =
        static_cast<std::size_t>(components(info.shape, particles.dim())) * bytes(info.type);
    std::memset(particles.table().column(particles.column(info.field)).data() + i * size, 0, size);
  }
}

}  // namespace

void append(const Scene& scene, const NewParticle& p, const decomp::Int3& quanta, Particles& particles) {
  const std::size_t i = particles.owned(), d = static_cast<std::size_t>(scene.dim);
  particles.table().resize(i + 1, 0);
  set_state_to_zero(particles, i);
  particles.data<Field::id>()[i] = p.id;
  for (std::size_t a = 0; a < d; ++a) {
    particles.data<Field::position>()[i * d + a] = quanta[a];
    particles.data<Field::velocity>()[i * d + a] = p.velocity[a];
  }
  if (auto* density = particles.data<Field::density>()) density[i] = p.density;
  particles.data<Field::mass>()[i] = p.mass;
  particles.data<Field::group>()[i] = p.group;
  if (auto* m = particles.data<Field::gas_content>()) m[i] = scene.groups[p.group].bubbly.gas_content;
  if (auto* u = particles.data<Field::specific_energy>()) {
    u[i] = p.energy;
    if (p.energy > 0) particles.data<Field::density>()[i] = 0;  // not summed yet
    particles.data<Field::smoothing_length>()[i] = scene.kernel.smoothing_length;
  }
  if (auto* t = particles.data<Field::temperature>())
    t[i] = scene.groups[p.group].heat.temperature.value_or(0);
  if (auto* radius = particles.data<Field::radius>()) radius[i] = p.radius;
  if (auto* spin = particles.data<Field::spin>())
    for (std::size_t a = 0; a < d; ++a) spin[i * d + a] = p.spin[a];
  if (auto* pressure = particles.data<Field::pressure>()) pressure[i] = 0;
  if (auto* overload = particles.data<Field::overload>()) {
    overload[i] = -1;
    // What is fluid beside a solid at the start is a crack to it.
    particles.data<Field::failing>()[i] = scene.groups[p.group].kind == GroupKind::fluid ? 1 : 0;
  }
  if (auto* prestress = particles.data<Field::prestress>()) prestress[i] = p.prestress;
  if (auto* mean = particles.data<Field::velocity_mean>())
    for (std::size_t a = 0; a < d; ++a) mean[i * d + a] = p.velocity[a];
  if (auto* porosity = particles.data<Field::porosity>()) porosity[i] = 1;  // grains are not looked at yet
}

}  // namespace sph

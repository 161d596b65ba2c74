// What grains and fluid make of each other, from the lists of each grain: porosity, averages, forces and reactions.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>

#include "pairs/for_rows.hpp"
#include "sph/core/fixed_point.hpp"
#include "sph/core/simd_rows.hpp"
#include "sph/models/drag.hpp"

namespace sph {
namespace {

using V = Simd<double>;

constexpr double porosity_quantum = 0x1p-50;
constexpr double least_porosity = 0.1;
constexpr double least_open = 0.25;      // of the kernel beside walls: less is in a corner, or behind a face
constexpr double largest_part = 0x1p50;  // [quanta]: 8192 of them fit a sum

std::string too_strong_text(std::int64_t step, std::uint64_t grain, double force, double largest) {
  return fmt::format(
      "{}grain {}: the force of the fluid on it, {:.6g} N, is beyond the range of the sums, {:.6g} N; reduce "
      "time.dt",
      step_text(step), grain, force, largest);
}

}  // namespace

template <class Function>
void Drag::for_grains(const Particles& grains, Side side, Function function) const {
  if (side != Side::boundary)
    for (std::size_t i = 0; i < grains.owned(); ++i) function(i);
  if (side != Side::interior)
    for (std::size_t i = grains.owned(); i < grains.rows(); ++i) function(i);
}

// Grains of the halo are those of other ranks: each adds to the fluid of this rank alone.
void Drag::deposit_porosity(StepState& s, Side side) {
  const Particles &fluid = s.particles, &grains = *s.other;
  if (side != Side::boundary) deposits_.assign(fluid.owned(), 0);
  const double* radius = grains.data<Field::radius>();
  for_grains(grains, side, [&](std::size_t i) {
    near_.find_kernel(grains, i, fluid);
    const double volume = volume_of(radius[i]) / porosity_quantum;
    const std::span<const std::uint32_t> rows = near_.rows(i);
    const std::span<const double> kernel = near_.kernel(i);
    for (std::size_t k = 0; k < rows.size(); ++k)
      if (rows[k] < fluid.owned()) deposits_[rows[k]] += round_to_quanta(volume * kernel[k]);
  });
  if (side == Side::interior) return;
  double* porosity = s.particles.data<Field::porosity>();
  // Behind walls are no grains: what they leave of the kernel is all that there is.
  const double* walls = fluid.data<Field::wall_share>();
  for_movers(s.ranges, [&](std::size_t i) {
    const double open =
        walls == nullptr ? 1.0 : std::max(1 - scene_->kernel.smoothing_length * walls[i * 4 + 3], least_open);
    porosity[i] = 1 - static_cast<double>(deposits_[i]) * porosity_quantum / open;
    if (porosity[i] >= least_porosity) return;
    s.findings.add(fluid.data<Field::id>()[i], [&] {
      std::array<double, 3> at;
      for (std::size_t a = 0; a < 3; ++a)
        at[a] = constants_->scale.metres(
            constants_->wrap(static_cast<int>(a), fluid.data<Field::position>()[i * 3 + a]));
      return fmt::format(
          "{}particle {} of \"{}\" {} has {:.3g} of its volume for itself, less than {}: grains lie in each "
          "other, or are too large for kernel.smoothing_length",
          step_text(s.global.step), fluid.data<Field::id>()[i],
          scene_->groups[fluid.data<Field::group>()[i]].name, place_text(at), porosity[i], least_porosity);
    });
  });
}

// At the start, when the fluid has been placed as if it had all of the volume.
void Drag::fill_between_grains(const StepState& s) const {
  double* mass = s.particles.data<Field::mass>();
  double* density = s.particles.data<Field::density>();
  const double* porosity = s.particles.data<Field::porosity>();
  for_movers(s.ranges, [&](std::size_t i) {
    mass[i] *= porosity[i];
    density[i] *= porosity[i];
  });
}

// Times the weight of a fluid particle it is what that particle takes, the same on both sides and on all ranks.
double Drag::quanta_a_weight(double force, double share) const { return force * share / force_quantum_; }

// The kernel is looked for again where fluid of the halo, or what shifting has displaced, is elsewhere than when the
// porosity was found.
void Drag::push_grains(StepState& s, Side side) {
  const Particles& fluid = *s.other;
  Particles& grains = s.particles;
  if (side != Side::boundary) limits_ = {};
  if (side != Side::boundary) near_.find_volumes(fluid, 0, fluid.owned());
  if (side != Side::interior) near_.find_volumes(fluid, fluid.owned(), fluid.rows());
  const double* mass = grains.data<Field::mass>();
  const double* radius = grains.data<Field::radius>();
  const auto* group = grains.data<Field::group>();
  double* v = grains.data<Field::velocity>();
  double* force = grains.data<Field::fluid_force>();
  double* drag = grains.data<Field::fluid_drag>();
  double* share = grains.data<Field::fluid_share>();
  const double dt = s.global.dt, largest = largest_part * force_quantum_;
  double speed2 = 0;
  const auto push_one = [&](std::size_t i) {
    const bool fixed = scene_->groups[group[i]].grain.fixed;
    Double3 f{}, d{};
    near_.find_weights(i);
    const FluidNear::Share in = near_.share_of(i, radius[i], fluid);
    share[i] = in.per_weight;
    if (in.immersed > 0) {
      FluidAround around = near_.look_around(grains, i, fluid);
      around.immersed = in.immersed;
      const Push push = push_(around, {2 * radius[i], mass[i], v + i * 3, fixed}, dt);
      f = push.force;
      d = push.drag;
      limits_.rate = std::max(limits_.rate, push.limits.rate);
      limits_.sound = std::max(limits_.sound, push.limits.sound);
    }
    std::array<std::int64_t, 3> sum{};
    for (std::size_t a = 0; a < 3; ++a) {
      force[i * 3 + a] = f[a];
      drag[i * 3 + a] = d[a];
      if (!(std::fabs(f[a]) < largest)) {
        const std::uint64_t id = grains.data<Field::id>()[i];
        s.findings.add(id, [&] { return too_strong_text(s.global.step, id, f[a], largest); });
        force[i * 3 + a] = drag[i * 3 + a] = 0;
        continue;
      }
      const double quanta = quanta_a_weight(f[a], share[i]);
      for (const double weight : near_.weights()) sum[a] += round_to_quanta(quanta * weight);
    }
    if (fixed) return;
    double v2 = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      v[i * 3 + a] += dt * (static_cast<double>(sum[a]) * force_quantum_ / mass[i]);
      v2 += v[i * 3 + a] * v[i * 3 + a];
    }
    speed2 = larger(v2, speed2);
  };
  using enum RowClass;
  const auto find_and_push = [&](std::size_t i) {
    if (side == Side::boundary || fluid_is_displaced_) near_.find_kernel(grains, i, fluid);
    push_one(i);
  };
  if (side != Side::boundary) for_rows(s.ranges, {interior_movers, interior_walls}, find_and_push);
  if (side != Side::interior) for_rows(s.ranges, {boundary_movers, boundary_walls}, find_and_push);
  s.maxima.speed = larger(std::sqrt(speed2), s.maxima.speed);
}

void Drag::push_fluid(StepState& s, Side side) {
  Particles& fluid = s.particles;
  const Particles& grains = *s.other;
  if (side != Side::boundary) deposits_.assign(fluid.owned() * V::lanes, 0);
  const double* mass = fluid.data<Field::mass>();
  const double* force = grains.data<Field::fluid_force>();
  const double* on_grain = grains.data<Field::fluid_drag>();
  const double* share = grains.data<Field::fluid_share>();
  for_grains(grains, side, [&](std::size_t i) {
    if (share[i] == 0) return;
    if (fluid_is_displaced_ && i >= grains.owned()) near_.find_kernel(grains, i, fluid);
    near_.find_weights(i);
    const std::span<const std::uint32_t> rows = near_.rows(i);
    V quanta = V::zero();
    for (int a = 0; a < 3; ++a) {
      const std::size_t component = i * 3 + static_cast<std::size_t>(a);
      quanta.set(a, quanta_a_weight(force[component], share[i]));
      quanta.set(3 + a, quanta_a_weight(on_grain[component], share[i]));
    }
    for (std::size_t k = 0; k < rows.size(); ++k) {
      if (rows[k] >= fluid.owned()) continue;
      std::int64_t* at = deposits_.data() + std::size_t{rows[k]} * V::lanes;
      (Int64x8::load(at) - to_integers(quanta * V(near_.weights()[k]))).store(at);
    }
  });
  if (side == Side::interior) return;
  double* v = fluid.data<Field::velocity>();
  double* pull = fluid.data<Field::grain_pull>();
  double* drag = fluid.data<Field::grain_drag>();
  double speed2 = 0;
  for_movers(s.ranges, [&](std::size_t i) {
    double v2 = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double before = pull[i * 3 + a];
      pull[i * 3 + a] = static_cast<double>(deposits_[i * V::lanes + a]) * force_quantum_ / mass[i];
      drag[i * 3 + a] = static_cast<double>(deposits_[i * V::lanes + 3 + a]) * force_quantum_ / mass[i];
      v[i * 3 + a] += s.global.dt * (pull[i * 3 + a] - before);
      v2 += v[i * 3 + a] * v[i * 3 + a];
    }
    speed2 = larger(v2, speed2);
  });
  s.maxima.speed = larger(std::sqrt(speed2), s.maxima.speed);
}

}  // namespace sph

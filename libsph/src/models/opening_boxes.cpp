#include "sph/models/opening_boxes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "pairs/for_rows.hpp"
#include "sph/core/fixed_point.hpp"
#include "sph/scene/positions.hpp"
#include "sph/scene/with_kernel.hpp"

namespace sph {
namespace {

/// Rows that are led: which block of the lists is theirs, and which lane of it.
template <class Function>
void for_led(const StepState& s, Side side, Function function) {
  const std::uint32_t* buffer = s.particles.data<Field::buffer>();
  const auto lanes = static_cast<std::size_t>(s.lists->all.lanes());
  const auto look = [&](RowClass c) {
    const RowRange& r = range_of(s.ranges, c);
    for (std::size_t i = r.first; i < r.last; ++i)
      if (buffer[i] != 0) function(i, r.first_block + (i - r.first) / lanes, (i - r.first) % lanes);
  };
  if (side != Side::boundary) look(RowClass::interior_movers);
  if (side != Side::interior) look(RowClass::boundary_movers);
}

}  // namespace

OpeningBoxes::OpeningBoxes(const SphConstants& constants, const Materials& materials)
    : constants_(&constants),
      materials_(&materials),
      inlets_(constants.scene->domain.openings.inlets.size()) {
  const OpeningControl& openings = constants.scene->domain.openings;
  const auto add = [&](const auto& of) {
    const std::size_t a = axis_of(of.direction);
    const bool up = is_up(of.direction);
    boxes_.push_back({of.lower, of.upper, &of.pressure, a,
                      constants.scale.quanta(up ? of.upper[a] : of.lower[a]),
                      constants.scale.quanta(of.upper[a] - of.lower[a]), up ? 1.0 : -1.0});
  };
  for (const Inlet& inlet : openings.inlets) add(inlet);
  for (const Outlet& outlet : openings.outlets) add(outlet);
  sums_.resize(2 * boxes_.size());
  const std::vector<Group>& groups = constants.scene->groups;
  for (std::size_t k = 0; k < groups.size(); ++k) {
    if (groups[k].kind != GroupKind::fluid) continue;
    sound_ = std::fmax(sound_, constants.groups.sound_speed[k]);
    impedance_ = std::fmax(impedance_, groups[k].density * constants.groups.sound_speed[k]);
  }
}

Double3 OpeningBoxes::place(const Rows& p, std::size_t i) const {
  const auto d = static_cast<std::size_t>(p.dim());
  Double3 x{};
  for (std::size_t a = 0; a < d; ++a)
    x[a] =
        constants_->scale.metres(constants_->wrap(static_cast<int>(a), p.get<Field::position>()[i * d + a]));
  return x;
}

void OpeningBoxes::mark(const decomp::Comm& comm, Particles& particles, const GlobalState& global) const {
  const Scene& scene = *constants_->scene;
  const auto d = static_cast<std::size_t>(particles.dim());
  const Rows p(particles);
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    std::uint32_t& buffer = p.get<Field::buffer>()[i];
    buffer = 0;
    const std::uint32_t group = p.get<Field::group>()[i];
    if (scene.groups[group].kind != GroupKind::fluid) continue;
    const Double3 x = place(p, i);
    for (std::size_t k = 0; k < boxes_.size() && buffer == 0; ++k) {
      const OpeningBox& box = boxes_[k];
      const bool leads = is_inlet(k) ? static_cast<int>(group) == scene.domain.openings.inlets[k].group
                                     : !box.pressure->empty();
      if (leads && box.contains(x, d)) buffer = static_cast<std::uint32_t>(k + 1);
    }
    if (buffer == 0 || !is_inlet(buffer - 1)) continue;
    double* v = p.get<Field::velocity>() + i * d;
    std::fill_n(v, d, 0.0);
    v[boxes_[buffer - 1].axis] = boxes_[buffer - 1].sign * speed(buffer - 1, x, 0, global);
  }
  check_inlets(comm, particles);
  check_behind(comm, particles);
}

// A pressure that waves bring is gone from the mean in less than a settle_time.
void OpeningBoxes::remember(std::span<const std::int64_t> sums, GlobalState& global) const {
  const double h = constants_->scene->kernel.smoothing_length;
  const double share = std::fmin(global.dt * sound_ / (Outlet::settles_in * h), 1.0);
  for (std::size_t k = 0; k < boxes_.size(); ++k) {
    const auto of = static_cast<double>(sums[2 * k]), sum = static_cast<double>(sums[2 * k + 1]);
    double& beside = global.throughput.passages[k].beside;
    if (!(of > 0)) continue;
    if (is_pressed(k))
      beside = sound_ * (sum / of);
    else
      beside += share * (impedance_ * sound_ / h * (sum / of) - beside);
  }
}

// It would flow into the box, where nothing looks at it, between layers that are led.
void OpeningBoxes::check_behind(const decomp::Comm& comm, Particles& particles) const {
  const Scene& scene = *constants_->scene;
  const Rows p(particles);
  for (std::size_t k = 0; k < inlets_; ++k) {
    OpeningBox behind = boxes_[k];
    const double spacing = scene.start.spacing;
    (behind.sign > 0 ? behind.upper : behind.lower)[behind.axis] =
        (behind.sign > 0 ? behind.lower : behind.upper)[behind.axis];
    (behind.sign > 0 ? behind.lower : behind.upper)[behind.axis] -= behind.sign * spacing;
    std::int64_t count = 0;
    for (std::size_t i = 0; i < particles.owned(); ++i)
      if (scene.groups[p.get<Field::group>()[i]].kind == GroupKind::fluid &&
          behind.contains(place(p, i), static_cast<std::size_t>(p.dim())))
        ++count;
    if (comm.sum(count) > 0)
      throw InputError(fmt::format(
          "{}: inlet.{}: {} particles of fluid are behind its box at the start; behind it must be "
          "nothing, or a wall",
          scene.file, k, comm.sum(count)));
  }
}

// Where a layer has fewer particles than another, gaps would come in again and again; those of a file may be on their way.
void OpeningBoxes::check_inlets(const decomp::Comm& comm, const Particles& particles) const {
  const Scene& scene = *constants_->scene;
  const auto d = static_cast<std::size_t>(particles.dim());
  const std::int64_t* x = particles.data<Field::position>();
  for (std::size_t k = 0; k < inlets_; ++k) {
    const OpeningBox& box = boxes_[k];
    const double length = constants_->scale.metres(box.length);
    std::vector<std::int64_t> layers(static_cast<std::size_t>(std::llround(length / scene.start.spacing)), 0);
    const double lower = box.lower[box.axis];
    for (std::size_t i = 0; i < particles.owned(); ++i) {
      if (particles.data<Field::buffer>()[i] != k + 1) continue;
      const double along = constants_->scale.metres(x[i * d + box.axis]) - lower;
      const auto layer = static_cast<std::int64_t>(std::floor(along / scene.start.spacing));
      ++layers[static_cast<std::size_t>(
          std::clamp<std::int64_t>(layer, 0, static_cast<std::int64_t>(layers.size()) - 1))];
    }
    comm.sum(std::span<std::int64_t>(layers));
    const auto [least, most] = std::ranges::minmax(layers);
    if (most > 0 && (least == most || !scene.start.file.empty())) continue;
    throw InputError(
        fmt::format("{}: inlet.{}: its box has layers of {} to {} particles of \"{}\" at the start; paint "
                    "all of it with a "
                    "start.region, whose particles are as many in each layer of one spacing",
                    scene.file, k, least, most,
                    scene.groups[static_cast<std::size_t>(scene.domain.openings.inlets[k].group)].name));
  }
}

// Along a period a body force drives a flow: no pressure balances it.
double OpeningBoxes::head(const Double3& from, const Double3& to, std::uint32_t group, double density) const {
  const Domain& domain = constants_->scene->domain;
  const GroupTable::Weight& of = constants_->groups.weight;
  double along = 0;
  for (std::size_t a = 0; a < 3; ++a)
    if (!domain.periodic[a]) along += domain.gravity[a] * (to[a] - from[a]);
  return (density * of.share[group] - of.borne[group]) * along;
}

double OpeningBoxes::speed(std::size_t number, const Double3& at, double time,
                           const GlobalState& global) const {
  const Scene& scene = *constants_->scene;
  const Inlet& inlet = scene.domain.openings.inlets[number];
  double v = inlet.velocity.empty() ? std::fmax(0.0, global.throughput.passages[number].beside)
                                    : value_at(inlet.velocity, time);
  if (inlet.profile == InletProfile::uniform) return v;
  for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a) {
    if (a == axis_of(inlet.direction) || scene.domain.periodic[a]) continue;
    const double s = (at[a] - inlet.lower[a]) / (inlet.upper[a] - inlet.lower[a]);
    v *= std::fmax(0.0, 6 * s * (1 - s));
  }
  return v;
}

bool OpeningBoxes::is_pressed(std::size_t number) const {
  return is_inlet(number) && !boxes_[number].pressure->empty();
}

// Lists are in the order of ids: so are the sums.
OpeningBoxes::Near OpeningBoxes::near(const StepState& s, std::size_t i, std::size_t block,
                                      std::size_t lane) const {
  const Scene& scene = *constants_->scene;
  const Particles& p = s.particles;
  const auto d = static_cast<std::size_t>(p.dim());
  const std::int64_t* x = p.data<Field::position>();
  const auto* group = p.data<Field::group>();
  // Velocities change across a flow: those of the neighbours on either side would make it flatter.
  const double h = scene.kernel.smoothing_length, radius = scene.kernel_radius() / h;
  const double unit = constants_->scale.quantum, tube = 1.25 * scene.start.spacing;
  const std::size_t axis = boxes_[p.data<Field::buffer>()[i] - 1].axis;
  Near sums;
  const std::span<const std::uint32_t> entries = s.lists->all.block(block);
  for (std::size_t e = lane; e < entries.size(); e += static_cast<std::size_t>(s.lists->all.lanes())) {
    const std::size_t j = entries[e];
    if (j == i || p.data<Field::buffer>()[j] != 0 || scene.groups[group[j]].kind != GroupKind::fluid)
      continue;
    Double3 away{};
    double square = 0;
    for (std::size_t a = 0; a < d; ++a) {
      const auto quanta = static_cast<double>(x[i * d + a] - x[j * d + a]);
      away[a] = quanta * unit;
      square += quanta * quanta;
    }
    const double w = kernel_value(scene.kernel.shape, scene.dim, std::sqrt(square) * unit / h);
    if (!(w > 0)) continue;
    sums.weight += w;
    const double q = p.data<Field::pressure>()[j] + head({}, away, group[j], p.data<Field::density>()[j]);
    sums.pressure += w * q;
    const double ahead = -away[axis];
    sums.along += w * ahead;
    sums.square += w * (ahead * ahead);
    sums.slope += w * (ahead * q);
    const double aside = std::sqrt(std::fmax(0.0, square * (unit * unit) - ahead * ahead)) / tube;
    const double straight = w * kernel_value(scene.kernel.shape, scene.dim, radius * aside);
    sums.before += straight;
    sums.speed += straight * p.data<Field::velocity>()[j * d + axis];
  }
  return sums;
}

// The mean of what a kernel reaches is that of a place some way off: the pressure has grown in between. One row alone
// would not know how much.
double OpeningBoxes::pressure_of(const Near& near, std::size_t number, const GlobalState& global) const {
  return (near.pressure - global.throughput.passages[number].beside * near.along) / near.weight;
}

void OpeningBoxes::sum_up(const Near& near, std::size_t number) {
  constexpr double whole = 0x1p32;
  const double h = constants_->scene->kernel.smoothing_length;
  std::int64_t& of = sums_[2 * number];
  std::int64_t& sum = sums_[2 * number + 1];
  if (is_pressed(number)) {
    if (!(near.before > 0)) return;
    const OpeningBox& b = boxes_[number];
    of += round_to_quanta(whole);
    sum += round_to_quanta(whole * (b.sign * (near.speed / near.before) / sound_));
    return;
  }
  const double mean = near.along / near.weight;
  of += round_to_quanta(whole * ((near.square - mean * near.along) / (h * h)));
  sum += round_to_quanta(whole * ((near.slope - mean * near.pressure) / (h * impedance_ * sound_)));
}

void OpeningBoxes::pass_pressures(StepState& s, Side side) {
  if (side != Side::boundary) std::ranges::fill(sums_, 0);
  const Rows p(s.particles);
  for_led(s, side, [&](std::size_t i, std::size_t block, std::size_t lane) {
    const Near beside = near(s, i, block, lane);
    const std::size_t number = p.get<Field::buffer>()[i] - 1;
    if (beside.weight > 0) sum_up(beside, number);
    if (!is_inlet(number))
      let_out(s, i, beside);
    else if (is_pressed(number))
      press(s, i, wanted(boxes_[number], p, i, s), false);
    else if (beside.weight > 0)
      press(s, i, pressure_of(beside, number, s.global), false);
  });
}

/// The pressure that is given for the middle of a box, where particle i is.
double OpeningBoxes::wanted(const OpeningBox& box, const Rows& p, std::size_t i, const Step& step) const {
  Double3 middle{};
  const Double3 at = place(p, i);
  for (std::size_t a = 0; a < static_cast<std::size_t>(p.dim()); ++a)
    middle[a] = 0.5 * (box.lower[a] + box.upper[a]);
  return value_at(*box.pressure, step.global.time + step.global.dt) +
         head(middle, at, p.get<Field::group>()[i], p.get<Field::density>()[i]);
}

void OpeningBoxes::let_out(StepState& s, std::size_t i, const Near& beside) const {
  const Rows p(s.particles);
  const std::size_t number = p.get<Field::buffer>()[i] - 1;
  const OpeningBox& box = boxes_[number];
  double& v = p.get<Field::velocity>()[i * static_cast<std::size_t>(p.dim()) + box.axis];
  const double* sound = p.get<Field::sound_speed>();
  const double c = sound != nullptr ? sound[i] : constants_->groups.sound_speed[p.get<Field::group>()[i]];
  const double impedance = c * p.get<Field::density>()[i], before = p.get<Field::pressure>()[i];
  const Outlet& outlet = constants_->scene->domain.openings.outlets[number - inlets_];
  const double share = std::fmin(s.global.dt / outlet.settle_time, 1.0);
  const double settles = share * (wanted(box, p, i, s) - before);
  if (!(beside.before > 0)) return press(s, i, before + settles, true);
  // Where fluid is torn, or few particles are near, what they tell is no wave.
  constexpr double mach = 0.1;
  const double there = pressure_of(beside, number, s.global),
               flow = box.sign * (beside.speed / beside.before);
  const double in = before - impedance * (box.sign * v) + 2 * settles;
  const double half = 0.5 * (there + impedance * flow - in), most = mach * impedance * c;
  const double wave = std::clamp(half - impedance * flow, -most, most);
  v = box.sign * (flow + wave / impedance);
  const double higher = std::clamp(half + in - there, -most, most);
  press(s, i, there + higher, true);
}

void OpeningBoxes::press(StepState& s, std::size_t i, double pressure, bool keeps_mass) const {
  const Rows p(s.particles);
  const Group& g = constants_->scene->groups[p.get<Field::group>()[i]];
  const double* content = p.get<Field::gas_content>();
  p.get<Field::pressure>()[i] = pressure;
  const double rho = materials_->density_of(p, i, g, content != nullptr ? content[i] : 0.0, s);
  p.get<Field::density>()[i] = rho;
  if (!keeps_mass) {
    const double mass = rho * particle_volume(*constants_->scene);
    if (double* liquid = p.get<Field::liquid_mass>()) liquid[i] *= mass / p.get<Field::mass>()[i];
    p.get<Field::mass>()[i] = mass;
  }
  materials_->derive(p, i, i + 1);  // as after a restart
  find_out_of_range(*constants_, p, i, i + 1, s);
}

}  // namespace sph

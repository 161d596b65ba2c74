#include "sph/models/shifting.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/random.hpp"
#include "pairs/for_rows.hpp"
#include "sph/core/fixed_point.hpp"

namespace sph {
namespace {

// What shears a lattice disorders it at the rate w/h, and U/h is the rate at which U orders it again: less
// than a percent of a spacing is left. With 64 and 1.4 a cavity of 100 particles across breaks.
constexpr double per_parting = 256;
// In a fluid that comes to rest the particles part as fast as their noise has it, and shifting would feed on
// what it stirs.
constexpr double per_unlike = 2;
constexpr double per_sound = 0.1;  // the Mach number for which c is chosen in a weakly compressible flow
constexpr double at_rest = 0.02;
constexpr double most_of_way = 0.5;  // of U dt
constexpr double drift = 2e-4;       // of U dt

// In units of the largest difference of the step before, which are the same in every frame; what is beyond
// four of them counts as four.
constexpr double most = 4;
constexpr double way_digits = 0x1p26, first_digit = 0x1p12, next_digit = 0x1p28;

// A power of two, so that dividing by it rounds nothing.
double unit_of(double speed) {
  int exponent = 0;
  (void)std::frexp(speed, &exponent);
  return std::ldexp(1.0, exponent);
}

struct Shift {
  static constexpr FieldSet reads = Shifting::reads, writes = Shifting::writes;
  const Shifting* shifting;
  void operator()(const View<reads, writes>& p, const Step& step) const { shifting->shift(p, step); }
};

struct CommonMotionSums {
  static constexpr FieldSet reads{Field::velocity, Field::group, Field::mass, Field::density};
  static constexpr FieldSet writes{};
  const Shifting* shifting;
  void operator()(const Shifting::Motion& p, const Step& step) const { shifting->sum_up(p, step); }
};

}  // namespace

void Shifting::add_to(Builder& b) const {
  b.add_kick("shifting", Shift{this}, [this](const GlobalState& global) { return longest(global); });
}

void Shifting::add_motion_to(Builder& b) const { b.add_kick("common motion", CommonMotionSums{this}); }

void Shifting::reserve(Reduction& r) {
  in_.unlike = r.add_maximum();
  in_.motion = r.add_sums(MotionSums{}.sums.size());
  in_.volume = r.add_sums(1);
}

double Shifting::start(const decomp::Comm& comm, Particles& particles, GlobalState& global) {
  const Motion moving(particles);
  global.fluid_volume.start = global.fluid_volume.now = comm.sum(fluid_volume(moving));
  // The mean first, then the largest difference from it, then all.
  global.motion.largest = global.max_speed;
  for (int k = 0; k < 3; ++k) {
    MotionSums motion = motion_sums(moving, global);
    comm.sum(std::span<std::int64_t>(motion.sums));
    std::array<double, 1> largest{motion.largest};
    comm.max(largest);
    motion.largest = largest[0];
    global.motion = common_motion(motion, global);
  }
  return Model::start(comm, particles, global);
}

void Shifting::sum_up(const Motion& p, const Step& step) const {
  step.maxima.volume = fluid_volume(p);
  step.maxima.motion = motion_sums(p, step.global);
}

bool Shifting::report(const StepState& s, Reduction& r) {
  r[in_.unlike] = s.maxima.motion.largest;
  std::ranges::copy(s.maxima.motion.sums, r[in_.motion].begin());
  r[in_.volume][0] = s.maxima.volume;
  return true;
}

void Shifting::act(const Reduction& r, GlobalState& global) {
  MotionSums motion{{}, r[in_.unlike]};
  std::ranges::copy(r[in_.motion], motion.sums.begin());
  global.motion = common_motion(motion, global);
  if (!constants_->scene->open()) global.fluid_volume.now = r[in_.volume][0];
}

std::int64_t Shifting::fluid_volume(const Motion& p) const {
  if (constants_->scene->open()) return 0;
  const double* mass = p.get<Field::mass>();
  const double* rho = p.get<Field::density>();
  const auto* group = p.get<Field::group>();
  std::int64_t sum = 0;
  for (std::size_t i = 0; i < p.owned(); ++i)
    if (!constants_->is_wall(group[i]))
      sum += round_to_quanta(mass[i] / rho[i] * (constants_->row_scale.inverse_volume * 0x1p26));
  return sum;
}

// One particle that flies, however fast, counts as one that moves at c / 10.
MotionSums Shifting::motion_sums(const Motion& p, const GlobalState& global) const {
  const auto d = static_cast<std::size_t>(p.dim());
  const double* v = p.get<Field::velocity>();
  const auto* group = p.get<Field::group>();
  const double unit = unit_of(global.motion.largest), inverse = 1 / unit;
  MotionSums out;
  auto& sums = out.sums;
  double largest2 = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    if (constants_->is_wall(group[i])) continue;
    double square = 0;
    ++sums[0];
    for (std::size_t a = 0; a < d; ++a) {
      const double way = (v[i * d + a] - global.motion.velocity[a]) * inverse;
      sums[1 + a] += round_to_quanta(std::fmax(-most, std::fmin(way, most)) * way_digits);
      square += way * way;
    }
    largest2 = std::fmax(largest2, square);
    const double fastest = per_sound * constants_->groups.sound_speed[group[i]] * inverse;
    square = std::fmin(square, std::fmin(fastest * fastest, most * most));
    double power = square * square * (square * square) * first_digit;
    for (std::size_t k = 4; k < sums.size(); ++k) {
      const std::int64_t whole = round_to_quanta(power);
      sums[k] += whole;
      power = (power - static_cast<double>(whole)) * next_digit;
    }
  }
  out.largest = unit * std::sqrt(largest2);
  return out;
}

// The sums are about the mean of the step before. That a frame may be accelerated must not count: the eighth
// mean about the mean of now is larger than this one less the way between them (Minkowski).
CommonMotion Shifting::common_motion(const MotionSums& found, const GlobalState& global) const {
  const auto& sums = found.sums;
  const auto count = static_cast<double>(sums[0]);
  CommonMotion motion = global.motion;
  if (sums[0] == 0) return motion;
  const double unit = unit_of(global.motion.largest);
  double power = 0, square = 0;
  for (std::size_t k = sums.size(); k-- > 4;) power = power / next_digit + static_cast<double>(sums[k]);
  for (std::size_t a = 0; a < 3; ++a) {
    const double way = static_cast<double>(sums[1 + a]) / way_digits / count;
    motion.velocity[a] += unit * way;
    square += way * way;
  }
  const double mean = std::fmax(0.0, power) / first_digit / count;
  motion.largest = found.largest;
  motion.unlike = unit * std::fmax(0.0, std::sqrt(std::sqrt(std::sqrt(mean))) - std::sqrt(square));
  return motion;
}

// A fluid at rest under gravity is ordered by its own pressure, and prefers another order than S does: the
// two would stir it for ever. At rest is what parts more slowly than 0.02 sqrt(g h); tanks at rest reach
// 0.004, flows driven by their weight have 0.1.
double Shifting::speed_of(const View<reads, writes>& p, std::size_t i, const GlobalState& global,
                          double rest) const {
  const auto d = static_cast<std::size_t>(p.dim());
  const double* sums = p.get<Field::spread>() + i * (d + 2) + d;
  if (!(sums[0] > 0)) return 0;
  const double square = sums[1] / sums[0];
  if (!(square > rest)) return 0;
  const double* sound = p.get<Field::sound_speed>();
  double c = constants_->groups.sound_speed[p.get<Field::group>()[i]];
  if (sound != nullptr) c = std::fmin(c, sound[i]);
  const double parting = std::sqrt(square) * (1 - rest / square);
  return std::fmin(per_parting * parting, std::fmin(per_unlike * global.motion.unlike, per_sound * c));
}

// On a lattice, however stretched, S is 0 by symmetry: particles run along the stagnation lines of a flow in
// rows that no shift tears apart, until rounding does, too late and violently. A drift of its own for each
// particle, 2e-4 of U, does it in time.
void Shifting::shift(const View<reads, writes>& p, const Step& step) const {
  const std::size_t d = static_cast<std::size_t>(p.dim());
  std::int64_t* x = p.get<Field::position>();
  const double* spread = p.get<Field::spread>();
  const auto* id = p.get<Field::id>();
  double pull = 0;
  for (double g : constants_->scene->domain.gravity) pull += g * g;
  const double rest = at_rest * at_rest * constants_->scene->kernel.smoothing_length * std::sqrt(pull);
  const auto* group = p.get<Field::group>();
  const std::uint32_t* buffer = p.get<Field::buffer>();
  for_movers(step.ranges, [&](std::size_t i) {
    if (is_body(constants_->scene->groups[group[i]]) || (buffer != nullptr && buffer[i] != 0)) return;
    const double reach = speed_of(p, i, step.global, rest) * step.global.dt;
    if (!(reach > 0)) return;
    const double scale = -2 * constants_->scene->kernel.smoothing_length * reach;
    const double share = constants_->scene->open() ? body_forces_->disordered_share(p, i) : 1.0;
    Double3 way{};
    double length2 = 0;
    for (std::size_t a = 0; a < d; ++a) {
      way[a] =
          share * (scale * spread[i * (d + 2) + a] + drift * reach * uniform_minus_one_to_one(0, id[i], a));
      length2 += way[a] * way[a];
    }
    const double length = std::sqrt(length2);
    const double cap = length > most_of_way * reach ? most_of_way * reach / length : 1.0;
    for (std::size_t a = 0; a < d; ++a)
      x[i * d + a] += round_to_quanta(way[a] * cap / constants_->scale.quantum);
  });
}

// The margin covers the rounding to quanta.
double Shifting::longest(const GlobalState& global) const {
  const double fastest =
      *std::max_element(constants_->groups.sound_speed.begin(), constants_->groups.sound_speed.end());
  return 1.0001 * most_of_way * std::fmin(per_unlike * global.motion.unlike, per_sound * fastest) * global.dt;
}

}  // namespace sph

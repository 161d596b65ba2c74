// Shifting: particles are moved against the gradient S of their concentration (terms/shifting.hpp), by
//   delta r = -2 h U dt S, at most U dt / 2 long,
// the form of Sun et al. (2017), where U is the largest speed of the flow. Here it is local, the same in
// every frame, and 0 in rigid motion: U_i = min(256 w_i, 2 M, c / 10), w_i the rms speed at which a particle
// and its neighbours part, M = (mean of |v - mean v|^8)^(1/8) over all, the largest but for what few do.
#include <algorithm>
#include <cmath>

#include "physics/for_rows.hpp"
#include "physics/random.hpp"
#include "sph/fixed_point.hpp"
#include "sph/physics.hpp"

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
constexpr double longest = 0.5;  // of U dt
constexpr double drift = 2e-4;   // of U dt

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

}  // namespace

// One particle that flies, however fast, counts as one that moves at c / 10.
MotionSums Physics::motion_sums(const Particles& p, const GlobalState& global) const {
  const auto d = static_cast<std::size_t>(p.dim());
  const double* v = p.data<Field::velocity>();
  const auto* group = p.data<Field::group>();
  const double unit = unit_of(global.motion.largest), inverse = 1 / unit;
  MotionSums out;
  auto& sums = out.sums;
  double largest2 = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    if (is_wall(group[i])) continue;
    double square = 0;
    ++sums[0];
    for (std::size_t a = 0; a < d; ++a) {
      const double way = (v[i * d + a] - global.motion.velocity[a]) * inverse;
      sums[1 + a] += round_to_quanta(std::fmax(-most, std::fmin(way, most)) * way_digits);
      square += way * way;
    }
    largest2 = std::fmax(largest2, square);
    const double fastest = per_sound * groups_.sound_speed[group[i]] * inverse;
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
CommonMotion Physics::common_motion(const MotionSums& found, const GlobalState& global) const {
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
double Physics::shifting_speed(const Particles& p, std::size_t i, const GlobalState& global,
                               double rest) const {
  const auto d = static_cast<std::size_t>(p.dim());
  const double* sums = p.data<Field::spread>() + i * (d + 2) + d;
  if (!(sums[0] > 0)) return 0;
  const double square = sums[1] / sums[0];
  if (!(square > rest)) return 0;
  const double* sound = p.data<Field::sound_speed>();
  double c = groups_.sound_speed[p.data<Field::group>()[i]];
  if (sound != nullptr) c = std::fmin(c, sound[i]);
  const double parting = std::sqrt(square) * (1 - rest / square);
  return std::fmin(per_parting * parting, std::fmin(per_unlike * global.motion.unlike, per_sound * c));
}

// On a lattice, however stretched, S is 0 by symmetry: particles run along the stagnation lines of a flow in
// rows that no shift tears apart, until rounding does, too late and violently. A drift of its own for each
// particle, 2e-4 of U, does it in time.
void Physics::shift(Particles& p, const RowRanges& ranges, const GlobalState& global) const {
  const std::size_t d = static_cast<std::size_t>(p.dim());
  std::int64_t* x = p.data<Field::position>();
  const double* spread = p.data<Field::spread>();
  const auto* id = p.data<Field::id>();
  double pull = 0;
  for (double g : scene_->gravity) pull += g * g;
  const double rest = at_rest * at_rest * scene_->smoothing_length * std::sqrt(pull);
  for_movers(ranges, [&](std::size_t i) {
    const double reach = shifting_speed(p, i, global, rest) * global.dt;
    if (!(reach > 0)) return;
    const double scale = -2 * scene_->smoothing_length * reach;
    const double share = scene_->open ? disordered_share(p, i) : 1.0;
    Double3 way{};
    double length2 = 0;
    for (std::size_t a = 0; a < d; ++a) {
      way[a] =
          share * (scale * spread[i * (d + 2) + a] + drift * reach * uniform_minus_one_to_one(0, id[i], a));
      length2 += way[a] * way[a];
    }
    const double length = std::sqrt(length2);
    const double cap = length > longest * reach ? longest * reach / length : 1.0;
    for (std::size_t a = 0; a < d; ++a) x[i * d + a] += round_to_quanta(way[a] * cap / scale_.quantum);
  });
}

// The margin covers the rounding to quanta.
double Physics::longest_shift(const GlobalState& global) const {
  if (!scene_->terms.shifting) return 0;
  const double fastest = *std::max_element(groups_.sound_speed.begin(), groups_.sound_speed.end());
  return 1.0001 * longest * std::fmin(per_unlike * global.motion.unlike, per_sound * fastest) * global.dt;
}

// How much of a particle's S is not that of the surface near it: 1 - |grad C| / |S| with the gradient that
// belongs to its C. Negative where S is too small for that: were such particles not drawn back inwards, those
// with too large an S would take the surface outwards with them. Inside C is 1 +- 0.01 and all of S is
// disorder, hence the margin; spray is left alone.
double Physics::disordered_share(const Particles& p, std::size_t i) const {
  constexpr double inside = 0.985, margin = 0.007, spray = 0.6;
  const std::size_t d = static_cast<std::size_t>(p.dim());
  const double h = scene_->smoothing_length;
  const double* spread = p.data<Field::spread>() + i * (d + 2);
  const double volume = p.data<Field::mass>()[i] / p.data<Field::density>()[i] * row_scale_.inverse_volume;
  const double concentration = h * spread[d] + volume * own_concentration_;
  double square = 0;
  for (std::size_t a = 0; a < d; ++a) square += spread[a] * spread[a];
  if (square == 0 || concentration < spray) return 0;
  const double length = h * std::sqrt(square);
  return concentration < inside ? std::fmax(-1.0, 1 - surface_(concentration) / length)
                                : std::fmax(0.0, 1 - surface_(concentration + margin) / length);
}

// Under tension particles draw together and leave voids. In the form -(p_j - p_i) instead of -(p_j + p_i) the
// force of a constant pressure on disordered particles pushes them apart (Sun et al. 2018, tensile
// instability control): the difference to the pair force is 2 p_i V_i S_i. Not antisymmetric, so only where a
// free surface leaves no other way.
double Physics::tension_control(const Particles& p, std::size_t i) const {
  const double pressure = p.data<Field::pressure>()[i];
  if (!scene_->terms.shifting || !scene_->open || pressure >= 0) return 0;
  return 2 * pressure / p.data<Field::density>()[i] * std::fmax(0.0, disordered_share(p, i));
}

}  // namespace sph

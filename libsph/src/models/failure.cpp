#include "sph/models/failure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "models/crack_plane.hpp"
#include "pairs/for_rows.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/models/faults.hpp"
#include "sph/terms/crack.hpp"

namespace sph {
namespace {

static_assert(CrackSums::nearly == nearly_lost, "of how far lists reach");

constexpr double tip_stress = 0.70;  ///< C
/// In spacings: one particle of each row across a crack is as near to its plane. Others bear so many times more, and what
/// is on it does across any other plane.
constexpr double half_a_row = 0.5, off_the_plane = 2;
constexpr double most_closing = 0.5;  ///< so that faces keep a distance
constexpr double crumbles = 1e30;     ///< overload of what no longer spans the space

/// Of a group, 0 where that criterion is not given.
struct Limits {
  double tension = 0;          ///< s [Pa]
  double shear = 0, sine = 0;  ///< c cos phi [Pa], sin phi
  double average = 0;          ///< [s]
  bool fails = false;
};

Limits limits_of(const Group& g, double spacing) {
  const auto row = std::ranges::find_if(g.becomes, [](const Transition& t) { return t.of_failure(); });
  if (row == g.becomes.end()) return {};
  const FailureLimits& f = row->failure;
  const double angle = f.friction_angle * (std::numbers::pi / 180);
  Limits out{.sine = exact_sin(angle), .average = row->average, .fails = true};
  out.tension = f.toughness ? tip_stress * *f.toughness / std::sqrt(spacing) : f.tensile_strength.value_or(0);
  out.shear = f.cohesion ? *f.cohesion * exact_cos(angle) : 0.0;
  return out;
}

/// `most`, `least`: principal stresses [Pa], in two dimensions of those in the plane; `tension` [Pa].
double overload(const Limits& limits, double largest, double least, double tension, double inside) {
  double most = -1;
  if (limits.tension > 0) most = std::max(most, (tension + inside) / limits.tension - 1);
  if (limits.shear > 0) {
    const double shear = 0.5 * (largest - least), mean = 0.5 * (largest + least) + inside;
    most = std::max(most, (shear + mean * limits.sine) / limits.shear - 1);
  }
  return most;
}

struct Failures {
  static constexpr FieldSet reads =
      FaultView::reads | FieldSet{Field::crack_sums,     Field::stress,       Field::pressure,
                                  Field::bonds,          Field::wet_pressure, Field::group,
                                  Field::borne_by_fluid, Field::prestress};
  static constexpr FieldSet writes{Field::overload,     Field::crack,         Field::crack_distance,
                                   Field::crack_planes, Field::crack_closing, Field::failing};
  const SphConstants* constants;
  std::vector<Limits> limits;  ///< by group

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim()), planes = d + d * (d + 1) / 2;
    const double* sums = p.get<Field::crack_sums>();
    const auto* group = p.get<Field::group>();
    for_movers(step.ranges, [&](std::size_t i) {
      const double* s = sums + i * (2 + d + planes);
      double& beyond = p.get<Field::overload>()[i];
      const Limits& own = limits[group[i]];
      // Beside what has just failed the overload is that of before.
      const bool changed = weight_of(s + 2 + d, p.dim()) > 0;
      const bool fails = own.fails && beyond > 0 && s[1] == 0 && !changed;
      p.get<Field::failing>()[i] = fails ? 1 : 0;
      if (!is_bonded(constants->scene->groups[group[i]])) return;
      if (s[0] > 0)
        find_fault(*constants, p, i, step,
                   "has bonds nearly as long as lists reach: the body is stretched beyond "
                   "terms.largest_stretch; raise "
                   "it or reduce time.dt");
      if (!own.fails) return;
      for (std::size_t a = 0; a < d; ++a) p.get<Field::crack>()[i * d + a] += s[2 + a];
      for (std::size_t k = 0; k < planes; ++k) p.get<Field::crack_planes>()[i * planes + k] += s[2 + d + k];
      if (changed) close(p, i);
      if (fails) return follow(p, i);
      const double now = p.get<Field::bonds>()[i] == 1 ? crumbles : overload_of(p, i, own);
      if (own.average > 0 && now < crumbles)
        beyond += std::fmin(step.global.dt / own.average, 1.0) * (now - beyond);
      else
        beyond = now;
    });
  }

  void close(const View<reads, writes>& p, std::size_t i) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double* crack = p.get<Field::crack>() + i * d;
    double square = 0;
    for (std::size_t a = 0; a < d; ++a) square += crack[a] * crack[a];
    if (!(square > 0)) return;
    CrackPlane plane;
    for (std::size_t a = 0; a < d; ++a) plane.normal[a] = crack[a] / std::sqrt(square);
    const double before = p.get<Field::prestress>() != nullptr ? p.get<Field::prestress>()[i] : 0.0;
    const double strain = strain_across(
        plane, in_space(p.get<Field::stress>() + i * (d * (d + 1) / 2), p.dim()),
        p.get<Field::pressure>()[i] - before, constants->scene->groups[p.get<Field::group>()[i]]);
    double& closing = p.get<Field::crack_closing>()[i];
    closing = std::max(closing, std::min(-strain, most_closing));
  }

  [[nodiscard]] double overload_of(const View<reads, writes>& p, std::size_t i, const Limits& own) const {
    const SymmetricTensor stress = stress_of(p, i);
    const PrincipalAxes principal = principal_axes(stress);
    const double largest = principal.values[0],
                 least = principal.values[static_cast<std::size_t>(p.dim()) - 1];
    const double inside = p.get<Field::wet_pressure>()[i];
    double tension = 0;
    if (!is_beside_cracks(p, i)) {
      tension = tension_across(first_plane(p, i, stress), stress);
    } else {
      tension = (largest + inside) / off_the_plane - inside;
      if (const CrackPlane plane = plane_of(planes_of(p, i), p.dim()); is_on(plane))
        tension = std::max(tension, tension_across(plane, stress));
    }
    return overload(own, largest, least, tension, inside);
  }

  void follow(const View<reads, writes>& p, std::size_t i) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const SymmetricTensor stress = stress_of(p, i);
    CrackPlane plane = turned(first_plane(p, i, stress), stress, p.get<Field::wet_pressure>()[i]);
    if (is_beside_cracks(p, i)) {
      if (const CrackPlane before = plane_of(planes_of(p, i), p.dim()); is_on(before))
        plane = gone_on(before, plane);
      else
        plane = plane_of_tension(stress, {});
    }
    std::copy_n(plane.normal.begin(), d, p.get<Field::crack>() + i * d);
    p.get<Field::crack_distance>()[i] = plane.distance;
  }

  static CrackPlane first_plane(const View<reads, writes>& p, std::size_t i, const SymmetricTensor& stress) {
    const auto d = static_cast<std::size_t>(p.dim());
    return plane_of_tension(stress, {p.get<Field::crack>() + i * d, d});
  }

  static const double* planes_of(const View<reads, writes>& p, std::size_t i) {
    const auto d = static_cast<std::size_t>(p.dim());
    return p.get<Field::crack_planes>() + i * (d + d * (d + 1) / 2);
  }
  /// Of sums of planes: 0 where nothing has failed.
  static double weight_of(const double* planes, int dim) {
    return std::accumulate(planes + dim, planes + 2 * dim, 0.0);
  }
  static bool is_beside_cracks(const View<reads, writes>& p, std::size_t i) {
    return weight_of(planes_of(p, i), p.dim()) > 0;
  }
  [[nodiscard]] bool is_on(const CrackPlane& plane) const {
    const Scene& s = *constants->scene;
    return std::fabs(plane.distance) * s.bond_width() <= half_a_row * s.start.spacing;
  }

  [[nodiscard]] SymmetricTensor stress_of(const View<reads, writes>& p, std::size_t i) const {
    const auto d = static_cast<std::size_t>(p.dim()), n = d * (d + 1) / 2;
    double stress[6];
    for (std::size_t k = 0; k < n; ++k)
      stress[k] = p.get<Field::stress>()[i * n + k] +
                  constants->scene->kernel.smoothing_length * p.get<Field::borne_by_fluid>()[i * n + k] -
                  (k < d ? p.get<Field::pressure>()[i] : 0.0);
    return in_space(stress, p.dim());
  }
};

}  // namespace

void add_failure(Builder& b) {
  const Scene& s = b.scene();
  std::vector<Limits> limits;
  for (const Group& g : s.groups) limits.push_back(limits_of(g, s.start.spacing));
  b.add_kick("failures", Failures{&b.constants(), std::move(limits)});
}

}  // namespace sph

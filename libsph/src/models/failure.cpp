#include "sph/models/failure.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "pairs/for_rows.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/laws/principal_stress.hpp"
#include "sph/models/faults.hpp"
#include "sph/terms/crack.hpp"

namespace sph {
namespace {

static_assert(CrackSums::nearly == nearly_lost, "of how far lists reach");

constexpr double tip_stress = 0.70;  ///< C
constexpr double crumbles = 1e30;    ///< overload of what no longer spans the space

/// Of a group, 0 where that criterion is not given.
struct Limits {
  double tension = 0;          ///< s [Pa]
  double shear = 0, sine = 0;  ///< c cos phi [Pa], sin phi
  bool fails = false;
};

Limits limits_of(const Group& g, double spacing) {
  const auto row = std::ranges::find_if(g.becomes, [](const Transition& t) { return t.of_failure(); });
  if (row == g.becomes.end()) return {};
  const FailureLimits& f = row->failure;
  const double angle = f.friction_angle * (std::numbers::pi / 180);
  Limits out{.sine = exact_sin(angle), .fails = true};
  out.tension = f.toughness ? tip_stress * *f.toughness / std::sqrt(spacing) : f.tensile_strength.value_or(0);
  out.shear = f.cohesion ? *f.cohesion * exact_cos(angle) : 0.0;
  return out;
}

/// The largest and the smallest [Pa], in two dimensions of those in the plane.
struct Extremes {
  double most, least;
};

Extremes principal(const double* deviator, double pressure, int dim) {
  if (dim == 3) {
    const PrincipalAxes p =
        principal_axes({deviator[0], deviator[1], deviator[2], deviator[3], deviator[4], deviator[5]});
    return {p.values[0] - pressure, p.values[2] - pressure};
  }
  const double mean = 0.5 * (deviator[0] + deviator[1]) - pressure, half = 0.5 * (deviator[0] - deviator[1]);
  const double radius = std::sqrt(half * half + deviator[2] * deviator[2]);
  return {mean + radius, mean - radius};
}

/// The largest tension across planes that a crack would follow from `n`, which is where others have failed; across any if
/// none have.
double opening_stress(const double* deviator, double pressure, const double* n, int dim, double most) {
  double square = 0;
  for (int a = 0; a < dim; ++a) square += n[a] * n[a];
  if (square == 0) return most;
  if (dim == 2) {
    const double across =
        deviator[0] * (n[1] * n[1]) - 2 * (deviator[2] * (n[0] * n[1])) + deviator[1] * (n[0] * n[0]);
    return across / square - pressure;
  }
  // P s P less so much of n n that it comes last, P = 1 - n n.
  SymmetricTensor projected{};
  double along[3] = {}, twice = 0, size = 0;
  const auto s = [&](int a, int b) { return deviator[symmetric_index(std::min(a, b), std::max(a, b), 3)]; };
  for (int a = 0; a < 3; ++a)
    for (int b = 0; b < 3; ++b) {
      along[a] += s(a, b) * n[b] / square;
      size += std::fabs(s(a, b));
    }
  for (int a = 0; a < 3; ++a) twice += along[a] * n[a] / square;
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b)
      projected[static_cast<std::size_t>(symmetric_index(a, b, 3))] =
          s(a, b) - along[a] * n[b] - along[b] * n[a] + (twice - 2 * size / square) * (n[a] * n[b]);
  return principal_axes(projected).values[0] - pressure;
}

double overload(const Limits& limits, Extremes s, double tension, double inside) {
  double most = -1;
  if (limits.tension > 0) most = std::max(most, (tension + inside) / limits.tension - 1);
  if (limits.shear > 0) {
    const double shear = 0.5 * (s.most - s.least), mean = 0.5 * (s.most + s.least) + inside;
    most = std::max(most, (shear + mean * limits.sine) / limits.shear - 1);
  }
  return most;
}

struct Failures {
  static constexpr FieldSet reads =
      FaultView::reads | FieldSet{Field::crack_sums,   Field::stress, Field::pressure,      Field::bonds,
                                  Field::wet_pressure, Field::group,  Field::borne_by_fluid};
  static constexpr FieldSet writes{Field::overload, Field::crack, Field::failing};
  const SphConstants* constants;
  std::vector<Limits> limits;  ///< by group

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double* sums = p.get<Field::crack_sums>();
    const auto* group = p.get<Field::group>();
    for_movers(step.ranges, [&](std::size_t i) {
      const double* s = sums + i * (2 + d);
      double& beyond = p.get<Field::overload>()[i];
      const Limits& own = limits[group[i]];
      const bool fails = own.fails && beyond > 0 && s[1] == 0;
      p.get<Field::failing>()[i] = fails ? 1 : 0;
      if (!is_bonded(constants->scene->groups[group[i]])) return;
      if (s[0] > 0)
        find_fault(*constants, p, i, step,
                   "has bonds nearly as long as lists reach: the body is stretched beyond "
                   "terms.largest_stretch; raise "
                   "it or reduce time.dt");
      if (!own.fails) return;
      for (std::size_t a = 0; a < d; ++a) p.get<Field::crack>()[i * d + a] += s[2 + a];
      beyond = p.get<Field::bonds>()[i] == 1 ? crumbles : overload_of(p, i, own);
    });
  }

  [[nodiscard]] double overload_of(const View<reads, writes>& p, std::size_t i, const Limits& own) const {
    const auto d = static_cast<std::size_t>(p.dim()), n = d * (d + 1) / 2;
    const double pressure = p.get<Field::pressure>()[i];
    SymmetricTensor stress{};  // and pressure
    for (std::size_t k = 0; k < n; ++k)
      stress[k] = p.get<Field::stress>()[i * n + k] +
                  constants->scene->kernel.smoothing_length * p.get<Field::borne_by_fluid>()[i * n + k];
    const Extremes all = principal(stress.data(), pressure, p.dim());
    const double tension =
        opening_stress(stress.data(), pressure, p.get<Field::crack>() + i * d, p.dim(), all.most);
    return overload(own, all, tension, p.get<Field::wet_pressure>()[i]);
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

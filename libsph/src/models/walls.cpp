// Walls: rows of particles that stay where they are, with the pressure of what is beside them and a velocity
// that lets it slip or not.
#include <algorithm>
#include <cmath>
#include <memory>

#include "pairs/for_rows.hpp"
#include "sph/models/models.hpp"
#include "sph/models/wall_distance.hpp"
#include "sph/models/wall_pressures.hpp"
#include "sph/terms/wall.hpp"

namespace sph {
namespace {

// Fluid that is torn keeps its density while its neighbours part, so that no pressure stops it before a wall,
// and one below 0 draws it in. Here walls stop it, without spring or rebound: where the way is y to 0.4
// spacings before a face, no particle moves towards it faster than c y / 10h, and beyond that not at all,
// whatever the other forces. So walls take energy and never give any, at any time step; what is behind a face
// comes out by its pressure. In corners, where the walls' gradient is less than their share tells, rest has a
// larger share. With grains in the fluid it is no force, which they would take their share of, but `at_once` a
// velocity.
template <bool at_once>
struct Hold {
  static constexpr FieldSet reads =
      BodyForces::reads | FieldSet{Field::wall_share,  Field::mass,  Field::velocity,
                                   Field::sound_speed, Field::group, Field::force};
  static constexpr FieldSet writes{at_once ? Field::velocity : Field::force};
  const SphConstants* constants;
  const BodyForces* body_forces;
  std::shared_ptr<const WallDistance> distance;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    constexpr double approach = 0.1, flat = 0.96, inside = 0.05;
    const Scene& scene = *constants->scene;
    const double dt = step.global.dt;
    const auto d = static_cast<std::size_t>(p.dim());
    const double h = scene.kernel.smoothing_length, before = 0.4 * scene.start.spacing / h;
    const double* share = p.template get<Field::wall_share>();
    const double* mass = p.template get<Field::mass>();
    const auto* v = p.template get<Field::velocity>();
    const double* sound = p.template get<Field::sound_speed>();
    const auto* group = p.template get<Field::group>();
    const auto* force = p.template get<Field::force>();
    for_movers(step.ranges, [&](std::size_t i) {
      const double* s = share + i * (d + 1);
      if (!(s[d] > 0) || scene.groups[group[i]].kind != GroupKind::fluid) return;
      const Double3 body = (*body_forces)(p, i, step);
      double square = 0, way = 0;
      for (std::size_t a = 0; a < d; ++a) {
        square += s[a] * s[a];
        way += (v[i * d + a] + dt * (force[i * d + a] / mass[i] + body[a])) * s[a];
      }
      const double length = std::sqrt(square);
      if (!(h * length > inside)) return;
      const double straight = h * length / distance->gradient(h * s[d]);
      const double face = straight > flat ? -before : distance->depth_in_corner();
      const double c = sound != nullptr ? sound[i] : constants->groups.sound_speed[group[i]];
      const double most = c * std::fmax(approach * (face - distance->depth(h * s[d])), 0.0);
      const double excess = way / length - most;
      if (!(excess > 0)) return;
      for (std::size_t a = 0; a < d; ++a)
        if constexpr (at_once)
          p.template get<Field::velocity>()[i * d + a] -= excess * (s[a] / length);
        else
          p.template get<Field::force>()[i * d + a] -= mass[i] * excess / dt * (s[a] / length);
    });
  }
};

// A flow that is 0 at the wall and 1 at the particle, straight between: its gradient is the normal over the
// distance, in units of 1/h. Particles nearer than a quarter of their spacing count as being there. Where
// walls on both sides leave less than half of the gradient that belongs to their share there is no normal: 0.
// Of what they hardly reach any will do.
struct WallSlopes {
  static constexpr FieldSet reads{Field::wall_share};
  static constexpr FieldSet writes{Field::wall_slope};
  const Scene* scene;
  std::shared_ptr<const WallDistance> distance;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    constexpr double nearest = 0.25, flat = 0.5, little = 0.01;
    const auto d = static_cast<std::size_t>(p.dim());
    const double h = scene->kernel.smoothing_length;
    const double* share = p.get<Field::wall_share>();
    double* slope = p.get<Field::wall_slope>();
    for_movers(step.ranges, [&](std::size_t i) {
      const double* s = share + i * (d + 1);
      double square = 0;
      for (std::size_t a = 0; a < d; ++a) square += s[a] * s[a];
      const double length = std::sqrt(square), away = (*distance)(h * s[d]);
      const bool normal =
          length > 0 && (h * s[d] < little || h * length >= flat * distance->gradient(h * s[d]));
      const double factor =
          normal ? -1 / (std::fmax(away, nearest * scene->start.spacing / h) * length) : 0.0;
      for (std::size_t a = 0; a < d; ++a) slope[i * d + a] = factor * s[a];
    });
  }
};

}  // namespace

// What a caller gives the wall is taken for what it gives the fluid there: its weight is that of the reference density.
void WallPressures::operator()(const View<reads, writes>& p, const Step& step) const {
  const std::size_t d = static_cast<std::size_t>(p.dim());
  const double* sums = p.get<Field::wall_sums>();
  const double* by_density = p.get<Field::wall_sums_by_density>();
  double* pressures = p.get<Field::wall_pressures>();
  double* pressure = p.get<Field::pressure>();
  double* mirror = p.get<Field::wall_mirror>();
  double* v = p.get<Field::velocity>();
  const auto* group = p.get<Field::group>();
  for (RowClass c : {RowClass::interior_walls, RowClass::boundary_walls}) {
    const RowRange& r = range_of(step.ranges, c);
    for (std::size_t i = r.first; i < r.last; ++i) {
      const double* s = sums + i * (2 + 2 * d);
      const Group& g = scene->groups[group[i]];
      const bool wet = s[0] > 0;
      pressure[i] = wet ? s[1] / s[0] : 0.0;
      if (wet && step.given != nullptr) {
        double along = 0;
        for (std::size_t a = 0; a < d; ++a) along += step.given[i * d + a] * s[2 + d + a];
        pressure[i] -= density * scene->kernel.smoothing_length * along / s[0];
      }
      if (pressures != nullptr)
        for (std::size_t k = 0; k < 2; ++k) {
          const double* of = by_density + 4 * i + 2 * k;
          pressures[2 * i + k] = of[0] > 0 ? of[1] / of[0] : 0.0;
        }
      if (mirror != nullptr && step.global.step == 0) {
        double square = 0;
        for (std::size_t a = 0; a < d; ++a) square += s[2 + d + a] * s[2 + d + a];
        mirror[i] = wet ? (*of_wall)(std::sqrt(square) / s[0], s[0]) : 1.0;
      }
      // Between a fluid and a wall that slips the viscous force is then that of its own mean: no shear. The
      // velocity across the wall is taken along, though its mirror image would be the exact one: it is
      // small, because the continuity sum sees the wall at rest, and changes the normal viscous stress
      // alone, which the pressure balances.
      for (std::size_t a = 0; a < d; ++a) {
        const double mean = wet ? s[2 + a] / s[0] : g.wall.velocity[a];
        v[i * d + a] = g.wall.slip ? mean : g.wall.velocity[a] - mirror[i] * (mean - g.wall.velocity[a]);
      }
    }
  }
}

WallPressures wall_pressures(Builder& b) {
  const Scene& s = b.scene();
  WallPressures update{&s, nullptr, 0};
  const auto is_fluid = [](const Group& g) { return g.kind == GroupKind::fluid; };
  if (const auto first = std::ranges::find_if(s.groups, is_fluid);
      std::ranges::all_of(s.groups,
                          [&](const Group& g) { return !is_fluid(g) || g.density == first->density; }) &&
      first != s.groups.end())
    update.density = first->density;
  if (std::ranges::any_of(s.groups,
                          [](const Group& g) { return g.kind == GroupKind::wall && !g.wall.slip; })) {
    update.of_wall = std::make_shared<const WallMirror>(s, s.kernel.smoothing_length);
    b.add_fields({Field::wall_mirror});
  }
  return update;
}

void add_walls(Builder& b, bool weighted) {
  const Scene& s = b.scene();
  const bool mixture = has_drag(s);
  std::vector<Term> terms{mixture ? term<MixtureWallExtrapolation> : term<WallExtrapolation>};
  if (weighted)
    terms.push_back(mixture ? term<MixtureWallExtrapolationByDensity> : term<WallExtrapolationByDensity>);
  b.add_sums("walls", terms, Builder::Rows::walls);
  b.add_update("wall pressures", wall_pressures(b));
}

void add_wall_share(Builder& b) { b.add_sums("wall distance", {term<WallShare>}); }

void add_wall_slopes(Builder& b) {
  const Scene& s = b.scene();
  b.add_fields({Field::wall_slope});
  b.add_update("wall slopes",
               WallSlopes{&s, std::make_shared<const WallDistance>(
                                  s.kernel.shape, s.dim, s.start.spacing / s.kernel.smoothing_length)});
}

void add_walls_that_hold(Builder& b) {
  const Scene& s = b.scene();
  const auto distance = std::make_shared<const WallDistance>(s.kernel.shape, s.dim,
                                                             s.start.spacing / s.kernel.smoothing_length);
  if (has_drag(s))
    b.add_update("walls hold", Hold<true>{&b.constants(), &b.body_forces(), distance});
  else
    b.add_update("walls hold", Hold<false>{&b.constants(), &b.body_forces(), distance});
}

}  // namespace sph

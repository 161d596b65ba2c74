#include "models/damping_limit.hpp"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <numbers>
#include <type_traits>
#include <vector>

#include "sph/core/exact_math.hpp"
#include "sph/core/kernels.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/laws/melt_viscosity.hpp"

namespace sph {
namespace {

constexpr double disorder = 1.15, disorder_of_bulk = 1.33;

/// What acts in one material, in units of h and its sound speed.
struct Rates {
  double sound = 0, diffusion = 0, laplacian = 0, symmetric = 0, artificial = 0, bulk = 0;
};

struct Neighbour {
  Double3 x;          ///< [h]
  double r2, weight;  ///< -V f
};

template <class Kernel>
std::vector<Neighbour> neighbours(int dim, double q) {
  const auto in = [q]<int D>(std::integral_constant<int, D>) {
    std::vector<Neighbour> out;
    const int reach = static_cast<int>(Kernel::radius / q) + 1, across = D == 3 ? reach : 0;
    const double volume = D == 3 ? q * q * q : q * q;
    for (int a = -reach; a <= reach; ++a)
      for (int b = -reach; b <= reach; ++b)
        for (int c = -across; c <= across; ++c) {
          const double r2 = (a * a + b * b + c * c) * (q * q), r = std::sqrt(r2);
          if (r2 == 0 || r >= Kernel::radius) continue;
          const double slope = Kernel::template normalisation<D> * Kernel::template slope<D>(r);
          out.push_back({{a * q, b * q, c * q}, r2, -volume * slope / r});
        }
    return out;
  };
  return dim == 2 ? in(std::integral_constant<int, 2>{}) : in(std::integral_constant<int, 3>{});
}

std::vector<Neighbour> neighbours(const Scene& scene) {
  const double q = scene.start.spacing / scene.kernel.smoothing_length;
  switch (scene.kernel.shape) {
    case KernelShape::wendland_c2:
      return neighbours<WendlandC2>(scene.dim, q);
    case KernelShape::wendland_c4:
      return neighbours<WendlandC4>(scene.dim, q);
    case KernelShape::quintic:
      break;
  }
  return neighbours<Quintic>(scene.dim, q);
}

/// Sums of one wave vector over the lattice, and of one direction n of the velocity.
struct Mode {
  double laplacian, along_gradient2, stretch, artificial;
};

/// All k of one octant, and of each the directions that the largest rates take: along D, k and the axes.
class Modes {
 public:
  explicit Modes(const Scene& scene) : dim_(static_cast<std::size_t>(scene.dim)), near_(neighbours(scene)) {
    for (const Neighbour& n : near_) {
      second_ += n.weight * n.r2 / scene.dim;
      fourth_ += n.weight * n.r2 * n.r2 / scene.dim;
    }
    const int steps = scene.dim == 2 ? 16 : 8;
    const double most = std::numbers::pi * scene.kernel.smoothing_length / scene.start.spacing;
    for (int a = 0; a <= steps; ++a)
      for (int b = 0; b <= a; ++b)
        for (int c = 0; c <= (scene.dim == 3 ? b : 0); ++c)
          if (a > 0) add({a * most / steps, b * most / steps, c * most / steps});
  }
  [[nodiscard]] bool stable(const Rates& r, double step) const {
    return std::all_of(modes_.begin(), modes_.end(), [&](const Mode& m) {
      const double s2 = r.sound * r.sound * step * step * m.along_gradient2;
      const double a = disorder * step * r.diffusion * m.laplacian;
      const double b = step * (disorder * (r.laplacian * m.laplacian / second_ +
                                           r.symmetric * m.stretch / fourth_ + r.artificial * m.artificial) +
                               disorder_of_bulk * r.bulk * m.along_gradient2);
      return a < 2 && b < 2 && s2 < (2 - a) * (2 - b);
    });
  }

 private:
  void add(const Double3& k) {
    Double3 gradient{};
    double laplacian = 0;
    std::vector<double> held(near_.size());
    for (std::size_t i = 0; i < near_.size(); ++i) {
      const Neighbour& n = near_[i];
      const double phase = k[0] * n.x[0] + k[1] * n.x[1] + k[2] * n.x[2], wave = exact_sin(phase);
      held[i] = n.weight * (1 - exact_cos(phase));
      laplacian += held[i];
      for (std::size_t a = 0; a < 3; ++a) gradient[a] += n.weight * n.x[a] * wave;
    }
    add(gradient, laplacian, held, gradient);
    add(k, laplacian, held, gradient);
    for (std::size_t a = 0; a < dim_; ++a) {
      Double3 axis{};
      axis[a] = 1;
      add(axis, laplacian, held, gradient);
    }
  }
  void add(const Double3& way, double laplacian, const std::vector<double>& held, const Double3& gradient) {
    const auto dot = [](const Double3& a, const Double3& b) {
      return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
    };
    const double length2 = dot(way, way), along = dot(way, gradient);
    if (!(length2 > 1e-18)) return;
    Mode m{laplacian, along * along / length2, 0, 0};
    for (std::size_t i = 0; i < held.size(); ++i) {
      const double part = dot(way, near_[i].x), q = held[i] * part * part / length2;
      m.stretch += q;
      m.artificial += q / (near_[i].r2 + 0.01);
    }
    modes_.push_back(m);
  }

  std::size_t dim_;
  std::vector<Neighbour> near_;
  double second_ = 0, fourth_ = 0;  ///< moments of the lattice, as in sph/terms/viscosity.hpp
  std::vector<Mode> modes_;
};

/// A copy of the scene in which one value is another.
using Change = std::function<void(Scene&, double)>;
struct Key {
  std::string name;
  double value;
  Change set;
};

std::vector<Key> keys_of(const Scene& scene) {
  std::vector<Key> keys{{"terms.density_diffusion", scene.terms.density_diffusion,
                         [](Scene& s, double x) { s.terms.density_diffusion = x; }},
                        {"terms.artificial_viscosity", scene.terms.artificial_viscosity,
                         [](Scene& s, double x) { s.terms.artificial_viscosity = x; }}};
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    const Group& group = scene.groups[g];
    if (group.viscosity_law.varies())
      keys.push_back({"group." + group.name + ".viscosity_law.most", viscosity_at_start(group),
                      [g](Scene& s, double x) { s.groups[g].viscosity_law.most = x; }});
    else
      keys.push_back({"group." + group.name + ".viscosity", group.viscosity,
                      [g](Scene& s, double x) { s.groups[g].viscosity = x; }});
    keys.push_back({"group." + group.name + ".bulk_viscosity", group.viscosity_law.bulk,
                    [g](Scene& s, double x) { s.groups[g].viscosity_law.bulk = x; }});
  }
  return keys;
}

std::vector<Rates> rates_of(const Scene& scene, const std::vector<double>& sounds) {
  std::vector<Rates> all;
  const double h = scene.kernel.smoothing_length;
  const bool ida = scene.terms.formulation == Formulation::ida;
  for (std::size_t k = 0; k < scene.groups.size(); ++k) {
    const Group& g = scene.groups[k];
    if ((g.kind == GroupKind::wall && !ida) || is_body(g)) continue;  // it has sums of its own, or of others
    const bool solid = g.kind == GroupKind::solid;
    const double eta = g.viscosity_law.varies() ? viscosity_at_start(g) : g.viscosity;
    const double nu = scene.terms.viscous.implicit ? 0 : eta / g.density;
    Rates r;
    r.sound = sounds[k] / h;
    r.diffusion =
        solid || g.eos.law->kind == EosKind::ideal_gas ? 0 : 2 * scene.terms.density_diffusion * r.sound;
    r.artificial = 0.5 * scene.terms.artificial_viscosity * r.sound;
    r.bulk = g.viscosity_law.bulk / g.density / (h * h);
    if (ida)  // eq. (9) of the velocity gradient: no pairwise viscosity
      r.bulk += 2 * nu / (h * h);
    else if (scene.terms.viscous.form == ViscosityForm::symmetric)
      r.symmetric = 2 * (scene.dim + 2) * nu / (h * h);
    else
      r.laplacian = 2 * nu / (h * h);
    all.push_back(r);
  }
  return all;
}

bool stable(const Modes& modes, const Scene& scene, const std::vector<double>& sounds, double step) {
  const std::vector<Rates> all = rates_of(scene, sounds);
  return std::all_of(all.begin(), all.end(), [&](const Rates& r) { return modes.stable(r, step); });
}

/// The largest x, up to `most`, for which holds(x), however small that is.
template <class Holds>
double largest(double most, Holds&& holds) {
  if (holds(most)) return most;
  if (!holds(0)) return 0;
  double lo = 0, hi = most;
  for (int bits = 0; bits < 40 && hi > 0;) {
    const double x = 0.5 * (lo + hi);
    (holds(x) ? lo : hi) = x;
    if (lo > 0) ++bits;
  }
  return lo;
}

}  // namespace

DampingLimit damping_limit(const Scene& scene, const std::vector<double>& sounds, double step) {
  DampingLimit limit{std::numeric_limits<double>::infinity(), "", 0, 0};
  if (scene.of_grains() || has_dry_bodies(scene)) return limit;
  const Modes modes(scene);
  const double enough = 4 * step;  // what is beyond need not be known
  const auto longest = [&](const Scene& s) {
    return largest(enough, [&](double dt) { return stable(modes, s, sounds, dt); });
  };
  const double found = longest(scene);
  if (found >= enough) return limit;
  limit.step = found;
  double longest_without = 0;
  for (const Key& key : keys_of(scene)) {
    if (!(key.value > 0)) continue;
    Scene changed = scene;
    key.set(changed, 0);
    const double without = longest(changed);
    if (without <= longest_without) continue;
    longest_without = without;
    limit.key = key.name;
    limit.value = key.value;
    limit.most = largest(key.value, [&](double x) {
      key.set(changed, x);
      return stable(modes, changed, sounds, step);
    });
  }
  return limit;
}

}  // namespace sph

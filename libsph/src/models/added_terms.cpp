// Terms that are switched on by a number, and what their sums do: an acceleration is a force before the kick;
// a drift moves particles after it, with the velocities that the next step moves them with.
#include <cmath>

#include "pairs/for_rows.hpp"
#include "sph/core/fixed_point.hpp"
#include "sph/models/models.hpp"
#include "sph/terms/added_term.hpp"

namespace sph {
namespace {

struct Accelerate {
  static constexpr FieldSet reads{Field::added, Field::mass};
  static constexpr FieldSet writes{Field::force};
  double strength;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double *sum = p.get<Field::added>(), *mass = p.get<Field::mass>();
    double* force = p.get<Field::force>();
    for_movers(step.ranges, [&](std::size_t i) {
      for (std::size_t a = 0; a < d; ++a) force[i * d + a] += mass[i] * (strength * sum[i * d + a]);
    });
  }
};

/// No particle differs more from another than twice the fastest; it is a bound on the way where a kernel's
/// sum is above 1.
double longest_added_drift(double strength, const GlobalState& global) {
  return 1.0001 * (2 * strength * global.max_speed) * global.dt;
}

struct Drift {
  static constexpr FieldSet reads{Field::added, Field::buffer};
  static constexpr FieldSet writes{Field::position};
  double strength, h, quantum;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double* sum = p.get<Field::added>();
    std::int64_t* x = p.get<Field::position>();
    const double dt = step.global.dt, most = 2 * strength * step.global.max_speed;
    const std::uint32_t* buffer = p.get<Field::buffer>();
    for_movers(step.ranges, [&](std::size_t i) {
      if (buffer != nullptr && buffer[i] != 0) return;
      double square = 0;
      for (std::size_t a = 0; a < d; ++a) square += sum[i * d + a] * sum[i * d + a];
      const double speed = strength * h * std::sqrt(square);
      const double scale = strength * h * (speed > most ? most / speed : 1.0);
      for (std::size_t a = 0; a < d; ++a)
        x[i * d + a] += round_to_quanta(scale * sum[i * d + a] * dt / quantum);
    });
  }
};

template <class Function>
void for_each_on(const Scene& scene, Effect effect, Function function) {
  for (std::size_t k = 0; k < scene.terms.added.size(); ++k)
    if (const AddedTerm& t = *added_terms()[k]; scene.terms.added[k] > 0 && t.effect == effect)
      function(t, scene.terms.added[k]);
}

}  // namespace

void add_accelerations(Builder& b) {
  for_each_on(b.scene(), Effect::acceleration, [&](const AddedTerm& t, double strength) {
    b.add_sums(std::string(t.word), {t.term});
    b.add_update(std::string(t.word) + " in forces", Accelerate{strength});
  });
}

bool has_drifts(const Scene& scene) {
  bool found = false;
  for_each_on(scene, Effect::drift, [&](const AddedTerm&, double) { found = true; });
  return found;
}

void add_drifts(Builder& b) {
  for_each_on(b.scene(), Effect::drift, [&](const AddedTerm& t, double strength) {
    b.add_kick(b.sums_over_pairs(std::string(t.word), {t.term}));
    b.add_kick(std::string(t.word) + " drift",
               Drift{strength, b.scene().kernel.smoothing_length, b.constants().scale.quantum},
               [strength](const GlobalState& global) { return longest_added_drift(strength, global); });
  });
}

}  // namespace sph

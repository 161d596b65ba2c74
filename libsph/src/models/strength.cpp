// Strength of updated-Lagrangian solids (sph/laws/yielding.hpp), after the elastic change of a step.
#include <cmath>
#include <optional>

#include "pairs/for_rows.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/laws/yielding.hpp"
#include "sph/models/models.hpp"

namespace sph {
namespace {

struct Strengths {
  static constexpr FieldSet reads = Materials::reads | FieldSet{Field::mass};
  static constexpr FieldSet writes{Field::stress,  Field::pressure,       Field::plastic_volume,
                                   Field::opening, Field::plastic_strain, Field::plastic_work};
  const Scene* scene;
  const Materials* materials;
  std::vector<std::optional<Yielding>> of_group;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim()), n = d * (d + 1) / 2;
    const auto* group = p.get<Field::group>();
    for_movers(step.ranges, [&](std::size_t i) {
      if (const auto& strength = of_group[group[i]])
        yield(p, i, scene->groups[group[i]], *strength, p.get<Field::stress>() + i * n);
    });
  }

  void yield(const View<reads, writes>& p, std::size_t i, const Group& g, const Yielding& strength,
             double* s) const {
    double &pressure = p.get<Field::pressure>()[i], &e = p.get<Field::plastic_volume>()[i];
    double& opening = p.get<Field::opening>()[i];
    const double rho = p.get<Field::density>()[i], mass = p.get<Field::mass>()[i];
    const auto at_pressure = [&](double above) {
      return g.eos.law->density(g, above + scene->domain.surface_pressure) / rho - 1;
    };
    const double before = e;
    if (opening > 0) {
      const double closes =
          std::fmin(opening, std::fmax(e - at_pressure(strength.closed_pressure(s, pressure)), 0.0));
      opening -= closes;
      e -= closes;
      materials->derive_pressure(p, i, i + 1);
    }
    const double closed = e;
    const Yielding::End end = strength.bring_back(s, pressure, p.get<Field::plastic_strain>()[i]);
    if (!end.yields && closed == before) return;
    if (end.yields && end.pressure != pressure) e = at_pressure(end.pressure);
    opening += std::fmax(e - closed, 0.0) * end.opening_share;
    materials->derive_pressure(p, i, i + 1);
    p.get<Field::plastic_strain>()[i] += end.plastic_shear;
    const double felt = rho * (1 + e), stored = g.eos.bulk_modulus / g.density * g.eos.law->energy(g, felt);
    p.get<Field::plastic_work>()[i] +=
        mass * (end.shear_work / rho - (pressure / felt + stored) * (e - before));
  }
};

}  // namespace

void add_strength(Builder& b) {
  const Scene& s = b.scene();
  Strengths update{&s, &b.materials(), {}};
  for (const Group& g : s.groups) {
    update.of_group.emplace_back();
    if (g.solid.strength) update.of_group.back().emplace(g, s.dim, s.start.spacing);
  }
  b.add_fields({Field::plastic_volume, Field::opening, Field::plastic_strain, Field::plastic_work});
  b.add_update("strength", std::move(update));
}

}  // namespace sph

// Gas that a particle has from walls which let it pass (terms/gas_flow.hpp), less what escapes through a free surface,
// linear in the particle's pressure.
#pragma once

#include <memory>

#include "sph/models/surface_escape.hpp"

namespace sph {

struct GasOutside {
  static constexpr FieldSet reads = SurfaceEscape::reads | FieldSet{Field::group, Field::wall_gas,
                                                                    Field::gas_mobility, Field::gas_pressure};
  using Rows = View<reads, FieldSet{}>;
  const SphConstants* constants;
  std::shared_ptr<const SurfaceEscape> surface;  ///< nullptr: there is none

  /// If the particle's pressure were `trial` [kg/s].
  [[nodiscard]] double rate(const Rows& p, std::size_t i, double trial) const {
    const double* walls = p.get<Field::wall_gas>();
    const double of_walls =
        walls != nullptr ? walls[2 * i] - walls[2 * i + 1] * (trial - p.get<Field::gas_pressure>()[i]) : 0.0;
    return of_walls - escape(p, i) * (trial > 0 ? trial : 0.0);
  }
  /// How much less there is with a pressure that is 1 Pa higher [kg/s/Pa].
  [[nodiscard]] double slope(const Rows& p, std::size_t i) const {
    const double* walls = p.get<Field::wall_gas>();
    return (walls != nullptr ? walls[2 * i + 1] : 0.0) + escape(p, i);
  }

 private:
  [[nodiscard]] double escape(const Rows& p, std::size_t i) const {
    if (surface == nullptr) return 0;
    const double b = p.get<Field::gas_mobility>()[i];
    if (!(b > 0 && p.get<Field::gas_pressure>()[i] > 0)) return 0;
    const Group& g = constants->scene->groups[p.get<Field::group>()[i]];
    const double volume = p.get<Field::mass>()[i] / p.get<Field::density>()[i];
    return g.bubbly.permeability.coefficient * b * volume * (*surface)(p, i);
  }
};

}  // namespace sph

// What all models of fluids and solids share: the constants of a scene in the units of its pair rows.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sph/pairs/pass_context.hpp"
#include "sph/plan/stage.hpp"
#include "sph/scene/positions.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

struct SphConstants {
  /// Of scenes of grains only `scene` and `scale` are set.
  SphConstants(const Scene& of, const PositionScale& position_scale);

  /// What a sum over pairs needs besides its terms.
  [[nodiscard]] PassContext context(Particles& particles, const NeighbourLists& lists,
                                    decomp::LargeVector<std::byte>& rows, double dt) const;
  /// ... of a pass in double precision, whatever that of the scene.
  [[nodiscard]] PassContext double_context(Particles& particles, const NeighbourLists& lists,
                                           decomp::LargeVector<std::byte>& rows, double dt) const;
  /// What bonds join was no further apart in the reference state, nor seems so in rows of less precision [quanta].
  [[nodiscard]] double longest_bond() const;
  [[nodiscard]] bool is_wall(std::uint32_t group) const {
    return scene->groups[group].kind == GroupKind::wall;
  }

  const Scene* scene;
  PositionScale scale;
  Wrap wrap;
  GroupTable groups;
  RowScale row_scale{};
  TermConstants<double> terms{};
  double bond_factor = 0;  ///< scale of a sum over bonds of V_j W'/|X| X X (terms/bonds.hpp)
  double gradient_factor = 0, force_factor = 0, diffusion_factor = 0;  ///< as PassContext has them
  double own_concentration = 0;  ///< V W(0) of a particle of volume spacing^D
  double kernel_at_zero = 0;     ///< W(0) without its factor
};

}  // namespace sph

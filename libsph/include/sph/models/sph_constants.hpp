// What all models of fluids and solids share: the constants of a scene in the units of its pair rows.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sph/pass_context.hpp"
#include "sph/plan/stage.hpp"
#include "sph/scene.hpp"

namespace sph {

struct SphConstants {
  /// Of scenes of grains only `scene` and `scale` are set.
  SphConstants(const Scene& of, const PositionScale& position_scale);

  /// What a sum over pairs needs besides its terms.
  [[nodiscard]] PassContext context(Particles& particles, const NeighbourLists& lists,
                                    decomp::LargeVector<std::byte>& rows, double dt) const;
  [[nodiscard]] bool is_wall(std::uint32_t group) const {
    return scene->groups[group].kind == GroupKind::wall;
  }

  const Scene* scene;
  PositionScale scale;
  Wrap wrap;
  GroupTable groups;
  RowScale row_scale{};
  TermConstants<double> terms{};
  double gradient_factor = 0, force_factor = 0, diffusion_factor = 0;  ///< as PassContext has them
  double own_concentration = 0;  ///< V W(0) of a particle of volume spacing^D
  double kernel_at_zero = 0;     ///< W(0) without its factor
};

/// Fixed-point scale of a scene: the finest power of two with which the domain spans at most 2^61 quanta and
/// the support at most 2^50, so that pair distances convert to double exactly.
[[nodiscard]] PositionScale position_scale(const Scene& scene);
/// Extent of the domain in quanta, along a period what is wrapped.
[[nodiscard]] std::array<std::int64_t, 3> domain_length(const Scene& scene, const PositionScale& scale);
[[nodiscard]] Wrap wrap_of(const Scene& scene, const PositionScale& scale);
/// Rows of single precision hold positions without so many low bits.
[[nodiscard]] int row_position_shift(const Scene& scene, const PositionScale& scale);

}  // namespace sph

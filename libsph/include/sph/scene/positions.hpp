// The numbers that positions of a scene are: whole quanta of length, wrapped along its periods.
#pragma once

#include <array>
#include <cstdint>

#include "sph/core/particles.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Fixed-point scale of a scene: the finest power of two with which the domain spans at most 2^61 quanta and
/// the support at most 2^50, so that pair distances convert to double exactly.
[[nodiscard]] PositionScale position_scale(const Scene& scene);
/// Extent of the domain in quanta, along a period what is wrapped.
[[nodiscard]] std::array<std::int64_t, 3> domain_length(const Scene& scene, const PositionScale& scale);
[[nodiscard]] Wrap wrap_of(const Scene& scene, const PositionScale& scale);
/// A mover of this group is outside the domain, through faces that delete it alone (domain.leaves). Bodies cannot lose a
/// part so.
[[nodiscard]] bool is_deleted(const Scene& scene, const PositionScale& scale, const Group& group,
                              const std::int64_t* position);
/// Rows of single precision hold positions without so many low bits.
[[nodiscard]] int row_position_shift(const Scene& scene, const PositionScale& scale);

}  // namespace sph

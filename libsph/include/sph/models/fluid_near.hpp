// The fluid around each grain: lists of its rows, the kernel's weights of one grain's list, and the averages that they
// give. Asked for one grain after another: find_kernel() or find_weights(), then what wants them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sph/models/drag_force.hpp"
#include "sph/models/sph_constants.hpp"
#include "sph/pairs/set_pair.hpp"

namespace sph {

class FluidNear {
 public:
  FluidNear(const Scene& scene, const PositionScale& scale, const SphConstants& constants);

  /// Of all grains, those of the halo included.
  void rebuild(const Particles& grains, const ListSetting& setting);
  /// Rows of the fluid near a grain, and of walls, in the order of ids.
  [[nodiscard]] std::span<const std::uint32_t> rows(std::size_t grain) const {
    return std::span(entries_).subspan(first_[grain], first_[grain + 1] - first_[grain]);
  }

  /// Of rows [first, last) of the fluid; what is wall takes no part.
  void find_volumes(const Particles& fluid, std::size_t first, std::size_t last);
  /// Kernel of a grain at the rows in its list, and volumes times it.
  void find_kernel(const Particles& grains, std::size_t i, const Particles& fluid);
  void find_weights(const Particles& grains, std::size_t i, const Particles& fluid);
  [[nodiscard]] std::span<const double> kernel() const { return kernel_; }
  [[nodiscard]] std::span<const double> weights() const { return weights_; }

  struct Share {
    double per_weight;  ///< 1 over the sum of the weights, 0 if there is no fluid
    double immersed;    ///< share of the grain that is in the fluid
  };
  [[nodiscard]] Share share_of(std::size_t grain, double radius, const Particles& fluid) const;
  [[nodiscard]] FluidAround look_around(const Particles& grains, std::size_t i, const Particles& fluid) const;

 private:
  const Scene* scene_;
  const SphConstants* constants_;
  PositionScale scale_;
  double surface_slope_;  ///< of the share of the kernel that is fluid, its surface being at the centre [1/h]
  std::vector<std::uint64_t> first_;      ///< of each grain's entries
  std::vector<std::uint32_t> entries_;    ///< rows of the fluid
  std::vector<double> kernel_, weights_;  ///< of one grain's entries
  std::vector<double> volumes_;           ///< of the fluid's rows
};

}  // namespace sph

// The fluid around each grain: lists of its rows, the kernel at those within its support, and the averages that the
// kernel gives. What find_kernel() finds stays until it is asked again: positions are the same in all passes of a
// step, but where shifting displaces the fluid. Weights are those of one grain at a time: find_weights(), then what wants
// them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "decomp/memory.hpp"
#include "sph/models/drag_force.hpp"
#include "sph/models/sph_constants.hpp"
#include "sph/pairs/set_pair.hpp"

namespace sph {

class FluidNear {
 public:
  FluidNear(const Scene& scene, const PositionScale& scale, const SphConstants& constants);

  /// Of all grains, those of the halo included.
  void rebuild(const Particles& grains, const ListSetting& setting);
  /// How many rows are looked at for a grain.
  [[nodiscard]] std::size_t listed(std::size_t grain) const { return first_[grain + 1] - first_[grain]; }

  /// Looks for the rows within the kernel's support around a grain, and for the kernel there.
  void find_kernel(const Particles& grains, std::size_t i, const Particles& fluid);
  /// As they were found: rows of the fluid and of walls, in the order of ids.
  [[nodiscard]] std::span<const std::uint32_t> rows(std::size_t grain) const {
    return {rows_.data() + first_[grain], found_[grain]};
  }
  [[nodiscard]] std::span<const double> kernel(std::size_t grain) const {
    return {kernel_.data() + first_[grain], found_[grain]};
  }

  /// Of rows [first, last) of the fluid; what is wall takes no part.
  void find_volumes(const Particles& fluid, std::size_t first, std::size_t last);
  /// Volumes times the kernel, at a grain's rows.
  void find_weights(std::size_t grain);
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
  std::vector<std::uint64_t> first_;         ///< of each grain's entries
  std::vector<std::uint32_t> entries_;       ///< rows of the fluid, and as many lanes more
  std::vector<std::uint32_t> found_;         ///< of each grain, how many are within the support
  decomp::LargeVector<std::uint32_t> rows_;  ///< ... these, from first_ on
  decomp::LargeVector<double> kernel_;       ///< ... and the kernel there
  std::vector<double> weights_;              ///< of one grain
  std::vector<double> volumes_;              ///< of the fluid's rows
};

}  // namespace sph

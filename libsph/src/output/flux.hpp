// What flows through a rectangle normal to an axis, in 2D a line: the mean over a slab around it,
//     sum m v_n w(r_n),    w(r) = 15/(16 s) (1 - (r/s)^2)^2, |r| < s,
// of the particles within its edges; s is two smoothing lengths, of a grain four radii, less where particles come or go nearer
// than that, but no less than a quarter of it: nearer still it misses what is not there. What has passed since some time ago is its
// integral exactly, but for what is in the slab now and was then: d/dt sum m Theta(r_n) = sum m v_n w(r_n), Theta' = w.
// Sums are exact: the same bits on any number of ranks.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string>
#include <vector>

#include "decomp/exact_sum.hpp"
#include "output/particle_values.hpp"

namespace sph {

class Flux {
 public:
  static constexpr std::size_t sums = 2;

  Flux(const Simulation& simulation, const Monitor& monitor);
  /// Positive towards greater coordinates [kg/s, m^3/s; in 2D per metre of depth].
  [[nodiscard]] static std::vector<std::string> names() { return {"mass_rate", "volume_rate"}; }
  /// Of a particle; nothing of what is held, and of cells.
  void add(const ParticleValues& of, std::size_t row, std::span<decomp::ExactSum> to) const;

 private:
  [[nodiscard]] double weight(const ParticleValues& of, std::size_t row) const;
  /// Of a rectangle between two corners.
  void find_clear_way(const Double3& one, const Double3& other);
  void keep_from(double place);

  const Scene* scene_;
  Wrap wrap_;
  double quantum_;
  std::size_t d_, normal_ = 0;
  std::array<std::int64_t, 3> lower_{}, upper_{};  ///< of the rectangle [quanta], the same along its normal
  double place_ = 0;                               ///< of the rectangle along its normal [m]
  double clear_ = std::numeric_limits<double>::infinity();  ///< way to where particles come or go [m]
};

}  // namespace sph

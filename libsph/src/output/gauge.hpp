// What a fluid is at a point, whatever particles are there. With w = V W(x - x_j) of the fluid's particles within the
// support, a plane is fitted to what they carry (moving least squares, Lancaster & Salkauskas 1981; as DualSPHysics's
// gauges are, Crespo et al. 2015, sums over fluids alone): exact for fields that are linear in space, so that a gauge on a
// wall reads the pressure there, not half a kernel before it. Where particles do not tell a slope it is their mean.
//   cover = sum w is 1 inside, 1/2 at a plane face. Below `least_cover` there is nothing to read: nan.
//   A level is how far above its point, against gravity, the fluid last covers half of what walls, bodies and solids leave of a
//   kernel; 0 where there is none, nan where the line is in a wall. On walls, in corners and slots it may be.
// Sums are exact: the same bits on any number of ranks.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "decomp/exact_sum.hpp"
#include "output/particle_values.hpp"

namespace sph {

class Gauge {
 public:
  static constexpr double least_cover = 0.1;

  Gauge(const Simulation& simulation, const Monitor& monitor);
  [[nodiscard]] static std::vector<std::string> names(const Simulation& simulation, const Monitor& monitor);

  [[nodiscard]] std::size_t sums() const { return points_.size() * sums_of_point_; }
  /// Of a particle.
  void add(const ParticleValues& of, std::size_t row, std::span<decomp::ExactSum> sums) const;
  /// What the sums over all particles say.
  void append(std::span<const double> sums, std::vector<double>& to) const;

 private:
  void add_at(const ParticleValues& of, std::size_t row, std::size_t point,
              std::span<decomp::ExactSum> sums) const;
  void append_point(std::span<const double> sums, std::vector<double>& to) const;
  [[nodiscard]] double level(std::span<const double> covers) const;

  const Scene* scene_;
  Wrap wrap_;
  double quantum_;
  bool is_level_;
  std::size_t d_;
  std::size_t quantities_ = 0;  ///< that are fitted
  std::size_t sums_of_point_;
  double normalisation_;
  double apart_ = 0;                                 ///< points of a level [m]
  std::vector<std::array<std::int64_t, 3>> points_;  ///< [quanta]
};

}  // namespace sph

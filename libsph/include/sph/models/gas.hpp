// Ideal gases: density from the places of the particles, energy from compression, viscosity and conduction,
// kernels that follow the volumes.
#pragma once

#include <vector>

#include "sph/models/builder.hpp"

namespace sph {

/// What a gas says of itself for the next time step.
using GasView = View<FieldSet{Field::density, Field::specific_energy, Field::velocity,
                              Field::smoothing_length, Field::group},
                     FieldSet{}>;
/// Of rows [first, last): `sound` is h times the largest (c + |v|) / h_i, and `viscosity` takes h_i for h
/// likewise.
void look_at_gas(const SphConstants& constants, const GasView& particles, std::size_t first, std::size_t last,
                 StepMaxima& maxima);

void add_gas(Builder& builder);
/// After the kick.
void add_heat(Builder& builder);

/// How far lists must reach for kernels of widths of their own, and when they have outgrown them.
class GasReach {
 public:
  explicit GasReach(const Scene& scene) : scene_(&scene) {}
  /// Of each row [m], the ways of the particles left aside.
  [[nodiscard]] const std::vector<double>& find(const Particles& particles);
  /// Largest growth of the owned particles' reach since they were listed, at the end of the step to come.
  [[nodiscard]] double growth(const Particles& particles) const;

 private:
  const Scene* scene_;
  std::vector<double> listed_;  ///< when lists were made [m]
};

}  // namespace sph

// What acts between the particles of fluids and solids: [terms], and the equations and arithmetic of all terms.
#pragma once

#include <vector>

#include "sph/scene/fluid_scene.hpp"
#include "sph/scene/gas_scene.hpp"
#include "sph/scene/solid_scene.hpp"

namespace sph {

enum class Formulation { conservative, ida };
enum class Precision { double_, mixed };

/// Of heat and of gas that flows.
struct ExchangeTerms {
  bool motion = true;         ///< false: nothing moves
  bool gas_escape = true;     ///< through free surfaces
  bool viscous_heat = false;  ///< friction heats
  bool implicit_conduction = false,
       implicit_gas_flow = false;  ///< of the end of the step: they limit no step
  double tolerance = 1e-6;         ///< of these, a share of what a step changes
  friend bool operator==(const ExchangeTerms&, const ExchangeTerms&) = default;
};

struct Terms {
  Formulation formulation = Formulation::conservative;
  Precision precision = Precision::double_;
  double density_diffusion = 0.1;   ///< delta
  double artificial_viscosity = 0;  ///< alpha
  ExchangeTerms exchange;
  bool shifting = false;
  PressureWeights pressure_weights = PressureWeights::volume;
  ViscousForces viscous;
  InterfaceTension surface_tension;
  GasTerms gas;
  BondTerms bonds;
  std::vector<double> added;  ///< strengths of the terms of added_term.hpp, in their order; 0: off
  friend bool operator==(const Terms&, const Terms&) = default;
};

}  // namespace sph

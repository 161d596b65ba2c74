// Everything that a compiled pass over pairs needs besides its terms (pair_pass.hpp).
#pragma once

#include <cstddef>

#include "decomp/memory.hpp"
#include "sph/core/particles.hpp"
#include "sph/pairs/fluid_blocks.hpp"
#include "sph/pairs/neighbour_lists.hpp"
#include "sph/pairs/pair_values.hpp"

namespace sph {

/// Of terms/viscosity.hpp.
template <class T>
struct ViscousConstants {
  T uniform;               ///< eta / h where all groups share it, times `laplacian` [Pa s/m]
  T laplacian, symmetric;  ///< scales of the two forms
};
/// Of terms/shock.hpp.
template <class T>
struct ShockConstants {
  T quadratic_viscosity;  ///< beta
  T conduction;           ///< alpha_u
};
/// Of terms/tension_jump.hpp.
template <class T>
struct JumpConstants {
  T damping;              ///< beta
  T background_pressure;  ///< twice p_b [Pa]
};
/// Of terms/bonds.hpp.
template <class T>
struct BondConstants {
  T range;          ///< largest distance of two bonded particles / h
  T position_unit;  ///< of the rows, over the h_b of the kernel of bonds
  T ratio;          ///< h / h_b ...
  T force;          ///< ... to the power of D + 1, as forces of bonds grow with it ...
  T viscosity;      ///< ... and of D + 2
};
/// Of terms/body_contact.hpp.
template <class T>
struct BodyContactConstants {
  T range;          ///< distance at which bodies touch / h
  T force, energy;  ///< scales
};

/// Constants of the scene that terms read, in the scaled units of pair_rows.hpp.
template <class T>
struct TermConstants {
  T gravity[3];            ///< g h [m^2/s^2]
  T density;               ///< rho_0 where there is one fluid, less what a background bears of it [kg/m^3]
  T inverse_sound_speed;   ///< where there is one fluid [s/m]
  T artificial_viscosity;  ///< alpha
  T inverse_w_spacing;     ///< 1 / w(spacing/h), unnormalised kernel
  T half_step;             ///< dt / 2h [s/m]
  ViscousConstants<T> viscous;
  ShockConstants<T> shock;
  JumpConstants<T> jump;
  BondConstants<T> bonds;
  BodyContactConstants<T> contact;
};

/// Everything a compiled pass needs besides its terms.
struct PassContext {
  Particles* particles;
  const NeighbourLists* lists;
  const GroupTable* groups;
  RowScale scale;
  TermConstants<double> constants;
  double gradient_factor;                ///< spacing^D alpha_D / h^(D+1): scale of a sum of V_j grad W
  double force_factor;                   ///< spacing^(2D) alpha_D / h^(D+1): scale of a sum of V_i V_j grad W
  double diffusion_factor;               ///< 2 delta h spacing^D alpha_D / h^(D+2)
  decomp::LargeVector<std::byte>* rows;  ///< scratch, used from aligned_scratch() on
  const NeighbourLists* bonds = nullptr;  ///< those of `lists` that bonds may join; none: all may
  const NeighbourLists* walls = nullptr;  ///< those of `lists` between what moves and walls; none: all may be
  const FluidBlocks* fluid = nullptr;     ///< of `lists`; none: it may be in any
};

/// 64-byte aligned start of the scratch, grown to `bytes`.
[[nodiscard]] std::byte* aligned_scratch(decomp::LargeVector<std::byte>& scratch, std::size_t bytes);

}  // namespace sph

// What laws of strength have in common: a stress beyond the yield surface is brought back onto it along a plastic
// strain (return mapping: de Souza Neto, Peric & Owen 2008, chapter 8). Tension is positive. Isotropic elasticity with
// K and G in space and in plane strain alike; the plastic strain keeps the volume or adds to it.
#pragma once

namespace sph {

/// Of a material at one moment. All of them >= 0, dilatancy at most friction: then a return never gives energy.
struct StrengthConstants {
  double sin_friction = 0, cos_friction = 1;
  double sin_dilatancy = 0;
  double cohesion = 0;          ///< c [Pa]
  double tensile_strength = 0;  ///< [Pa], where the cone's tip is lower that counts; may be infinite
  double bulk_modulus = 0, shear_modulus = 0;  ///< K, G > 0 [Pa]
  bool in_plane = false;                       ///< plane strain
};

/// The greatest tension on all sides that shear strength lets be, c cos(phi)/sin(phi); infinite without friction [Pa].
[[nodiscard]] double cone_tip(const StrengthConstants& constants);

}  // namespace sph

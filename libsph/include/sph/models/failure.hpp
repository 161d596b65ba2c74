// Where total-Lagrangian solids fail (Ida, 4.4: magma-driven fracture). A particle's overload is how far beyond its
// strength it is, over the strength s: with principal stresses sigma_1 >= sigma_3, tension positive, and p the pressure of
// the fluid beside it, which is in its cracks,
//   (sigma_t + p) / s - 1,     s = C K_Ic / sqrt(spacing), or given                                      tension
//   ((sigma_1 - sigma_3)/2 + (sigma_1 + sigma_3 + 2 p)/2 sin phi) / (c cos phi) - 1           Mohr and Coulomb
// the larger of the two. sigma_t is sigma_1, or beside what is fluid from the start the hoop stress, the largest across planes
// that contain the direction n from there (Erdogan & Sih 1963): sigma_1 is as large 60 degrees off the line of a crack, and
// would turn it. Beside what has failed it is that across the crack's plane, for particles on it; half of sigma_1 for any.
// Stress beside the tip of a crack grows as 1 / sqrt(spacing), so that the first fixes K_Ic at any
// spacing; C is found with pressurised cracks (Sneddon 1946). A particle that is beyond its strength, and bonded to none
// that is further, becomes fluid: cracks stay one row wide. It has the pressure beside it; its neighbours' bonds to it are
// gone, and those across the crack are cut (terms/crack.hpp). One whose bonds left do not span the space follows it.
// A lattice that breaks at once rings, and the next particle bears up to twice what it would at rest: a crack that has begun to
// grow runs on down to half of K_Ic. Where the overload is a mean over some times that sound takes to cross a spacing it grows as at rest.
#pragma once

#include "sph/models/builder.hpp"

namespace sph {

/// At the end of a step; before transitions, which have the particles join their fluid.
void add_failure(Builder& builder);

}  // namespace sph

// Keys of [group.motion].
#pragma once

#include "keys/conditions.hpp"

namespace sph::keys {

inline constexpr auto motion_keys = std::to_array<Key>({
    {"velocity", curve_of_time, "Along direction, straight between times [m/s].", Default{"0"}},
    {"direction", Vector{dimension::none}, "Of the velocity; of any length.",
     at<&PrescribedMotion::direction>},
    {"amplitude", Vector{dimension::length},
     "Of an oscillation: amplitude sin(2 pi frequency t), beside the velocity.",
     at<&PrescribedMotion::amplitude>},
    {"frequency", Number{dimension::rate, not_negative}, "Of the oscillation.",
     at<&PrescribedMotion::frequency>},
    {"spin", curve_of_time,
     "Angular velocity about axis, in 2D about z, straight between times [rad/s], or in \"rpm\", revolutions "
     "a "
     "minute.",
     Default{"0"}},
    {"axis", Vector{dimension::none}, "Of the spin, in 3D, right-handed; of any length.",
     at<&PrescribedMotion::axis>,
     Condition{[](const Scene& s) { return s.dim == 3; }, "three dimensions", "in two dimensions it is z"}},
    {"centre", Vector{dimension::length}, "A point of the axis, which moves with the body.",
     at<&PrescribedMotion::centre>},
});
inline constexpr Table<PrescribedMotion> motion{
    {"group.motion", false, "A rigid solid moves so, whatever acts on it.", motion_keys}};

}  // namespace sph::keys

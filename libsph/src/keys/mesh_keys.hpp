// Keys of [[mesh]].
#pragma once

#include "keys/conditions.hpp"

namespace sph::keys {

inline constexpr auto mesh_keys = std::to_array<Key>({
    {"name", Text{}, "A letter, then letters, digits, _ or -.", at<&MeshWall::name>, required},
    {"material", NameOf{"group", false, true}, "A group of grains, with or without diameter.",
     index_at<&MeshWall::group>, required},
    {"file", File{},
     "STL (text or binary) or OBJ, its path from the folder of the scene. Vertices at the same place are "
     "one; a facet "
     "without area is refused. Grains touch both sides.",
     at<&MeshWall::file>, required},
    {"content", Text{},
     "Hash of the file: a run goes on with the file that it began with. Written by the program.",
     at<&MeshWall::content>, Default{"of the file as it is"}},
    {"scale", Number{dimension::length, positive}, "A unit of the file, \"1 mm\" say.", at<&MeshWall::scale>},
    {"origin", Vector{dimension::length}, "Where the origin of the file is at the start.",
     at<&MeshWall::origin>},
    {"smooth_angle", Number{dimension::none, {.least = 0, .most = 89, .is = "it is an angle in degrees,"}},
     "In degrees: what a grain touches at directions so near to each other is one surface, with one contact, "
     "the "
     "deepest. More than between facets of what should be round, less than at edges that should not.",
     at<&MeshWall::smooth_angle>},
    {"begin", Number{dimension::time, not_negative}, "From then on it is there.", at<&MeshWall::begin>},
    {"end", Number{dimension::time, positive}, "From then on it is not.", at<&MeshWall::end>,
     Default{"never"}},
    {"velocity", curve_of_time, "Along direction, straight between times [m/s].", Default{"0"}},
    {"direction", Vector{dimension::none},
     "Of the velocity, or along which a servo or a mass moves; of any length.",
     at<&MeshWall::motion, &PrescribedMotion::direction>},
    {"force", Number{dimension::force},
     "Along direction: a servo moves until it presses on the grains with this; a mass is pushed by it.",
     at<&MeshWall::drive, &MeshDrive::force>, Default{"required of a servo; 0"}},
    {"servo_gain", Number{dimension::speed_per_force, positive}, "Of a servo: speed per excess of force.",
     at<&MeshWall::drive, &MeshDrive::servo_gain>, Default{"no servo"}},
    {"mass", Number{dimension::mass, positive},
     "Of a mesh that moves along direction by gravity, the grains and the force: a piston, a lid.",
     at<&MeshWall::drive, &MeshDrive::mass>, Default{"none"}},
    {"largest_speed", Number{dimension::speed, positive}, "Of a servo or a mass: it goes no faster.",
     at<&MeshWall::drive, &MeshDrive::largest_speed>, Default{"required of both"}},
    {"amplitude", Vector{dimension::length},
     "Of an oscillation: amplitude sin(2 pi frequency t), beside the velocity.",
     at<&MeshWall::motion, &PrescribedMotion::amplitude>},
    {"frequency", Number{dimension::rate, not_negative}, "Of the oscillation.",
     at<&MeshWall::motion, &PrescribedMotion::frequency>},
    {"spin", curve_of_time,
     "Angular velocity about axis, straight between times [rad/s], or in \"rpm\", revolutions a minute.",
     Default{"0"}},
    {"axis", Vector{dimension::none}, "Of the spin, right-handed; of any length.",
     at<&MeshWall::motion, &PrescribedMotion::axis>},
    {"centre", Vector{dimension::length}, "A point of the axis, which moves with the mesh.",
     at<&MeshWall::motion, &PrescribedMotion::centre>},
});
inline constexpr Table<MeshWall> mesh{
    {"mesh", true, "A wall of triangles from a file, which may move as it is told.", mesh_keys}};

}  // namespace sph::keys

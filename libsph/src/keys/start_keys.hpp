// Keys of [start] and of the tables in it.
#pragma once

#include "keys/conditions.hpp"

namespace sph::keys {

inline constexpr auto region_keys = std::to_array<Key>({
    {"group", NameOf{"group", true}, "What it paints; \"none\" leaves it empty.", index_at<&Region::group>,
     required},
    {"shape", Words{region_shape_words}, "What it covers.", at<&Region::shape>},
    {"lower", Vector{dimension::length}, "Of a box: lower <= x < upper.", at<&Region::lower>,
     where("shape", "box"), required},
    {"upper", Vector{dimension::length}, "Of a box.", at<&Region::upper>, where("shape", "box"), required},
    {"centre", Vector{dimension::length}, "Of a ball: |x - centre| < radius.", at<&Region::centre>,
     where("shape", "ball"), required},
    {"from", Vector{dimension::length},
     "Of a cylinder or cone: one end of its axis, which is parallel to x, y or z; in two dimensions they are "
     "a box and a trapezium.",
     at<&Region::from>, among("shape", "cylinder", "cone"), required},
    {"to", Vector{dimension::length}, "The other end.", at<&Region::to>, among("shape", "cylinder", "cone"),
     required},
    {"radius", Number{dimension::length, not_negative}, "Of a ball, a cylinder or a cone at `from`.",
     at<&Region::radius>, among("shape", "ball", "cylinder", "cone"), required},
    {"top_radius", Number{dimension::length, not_negative}, "Of a cone at `to`.", at<&Region::top_radius>,
     where("shape", "cone")},
    {"points", corners_of_polygon,
     "Of a polygon, in two dimensions: its corners one after the other; the last is joined to the first.",
     where("shape", "polygon"), required},
    {"file", File{},
     "Of a mesh, in three dimensions: STL (text or binary) or OBJ, its path from the folder of the scene, of "
     "closed "
     "surfaces; where two of them enclose a place it is outside. Coordinates are read in single precision: "
     "keep "
     "them near the origin of the file.",
     at<&Region::mesh, &RegionMesh::file>, where("shape", "mesh"), required},
    {"content", Text{},
     "Hash of the file: a run goes on with the file that it began with. Written by the program.",
     at<&Region::mesh, &RegionMesh::content>, where("shape", "mesh"), Default{"of the file as it is"}},
    {"scale", Number{dimension::length, positive}, "A unit of the file, \"1 mm\" say.",
     at<&Region::mesh, &RegionMesh::scale>, where("shape", "mesh")},
    {"origin", Vector{dimension::length}, "Where the origin of the file is.",
     at<&Region::mesh, &RegionMesh::origin>, where("shape", "mesh")},
});
inline constexpr Table<Region> region{
    {"start.region", true, "A lattice point belongs to the last region that contains it.", region_keys}};

inline constexpr auto layer_keys = std::to_array<Key>({
    {"group", NameOf{"group"}, "What lies there.", index_at<&Layer::group>, required},
    {"top", Number{dimension::length}, "Height of its top against gravity, of the first that of the surface.",
     at<&Layer::top>, required},
    {"pressure", Number{dimension::pressure, not_negative},
     "Of the first layer at its top, above domain.surface_pressure: what a plug held that has just gone.",
     at<&Layer::pressure>},
});
inline constexpr Table<Layer> layer{
    {"start.layer", true, "Hydrostatic pressure: fluids on top of each other, from the surface downwards.",
     layer_keys}};

inline constexpr auto tile_keys = std::to_array<Key>({
    {"file", File{}, "A snapshot of a run of grains, or a particle file.", at<&Tile::file>, required},
    {"repeat", Copies{},
     "Copies along each axis, like [4, 2, 1]; where there are several, a copy is as long as its share of "
     "the domain.",
     at<&Tile::repeat>, required},
});
inline constexpr Table<Tile> tile{
    {"start.tile", false, "A settled packing of grains side by side.", tile_keys}};

inline constexpr auto fill_keys = std::to_array<Key>({
    {"group", NameOf{"group", false, true}, "A group of grains.", index_at<&GrainFill::group>, required},
    {"lower", Vector{dimension::length}, "Extent that is filled.", at<&GrainFill::lower>, required},
    {"upper", Vector{dimension::length}, "Its other corner.", at<&GrainFill::upper>, required},
    {"spacing", Number{dimension::length, positive}, "Between the grains of a cubic lattice.",
     at<&GrainFill::spacing>, required},
    {"jitter",
     Number{dimension::none, {.least = 0, .most = 0.5, .below_most = true, .is = "it is in spacings,"}},
     "Uniform random displacement in each direction, in spacings; start.seed draws it.",
     at<&GrainFill::jitter>},
    {"occupied",
     Number{dimension::none,
            {.least = 0, .most = 1, .above_least = true, .is = "it is a share of the points,"}},
     "Share of these points that get a grain; start.seed draws them.", at<&GrainFill::occupied>},
});
inline constexpr Table<GrainFill> fill{
    {"start.grains", true, "Grains in a fluid or in melts: a lattice of their own, in a box.", fill_keys}};

inline constexpr auto start_keys = std::to_array<Key>({
    {"spacing", Number{dimension::length, positive}, "dx, the distance between particles at the start.",
     Default{"required; of grains 1.1 of the largest diameter"}},
    {"file", File{},
     "Instead of a lattice: HDF5 or CSV with id, x, v, group, rho, m, u, of grains id, x, v, group, radius "
     "and perhaps spin (CSV: id,x,y,z,vx,vy,vz,group,radius,wx,wy,wz). HDF5 may also have stress, in 3D "
     "with an attribute components = \"xx yy zz xy yz xz\", as in snapshots.",
     at<&Start::file>},
    {"tile", Inner{&tile}, "Instead of a lattice: a settled packing of grains side by side.",
     of_grains_alone},
    {"lattice", Words{lattice_kind_words},
     "\"square\" is cubic in 3D. The close packing is \"hexagonal\" in 2D, with neighbours 1.0745699318235 "
     "spacings apart along x and rows 0.9306048591021 apart, of which a period holds an even number, and "
     "\"fcc\" in 3D, 1.122 apart, whose cubes are 4^(1/3) = 1.5874010519682 spacings long: a period holds "
     "whole ones.",
     at<&Start::lattice, &LatticeFill::kind>, of_lattices},
    {"origin", Vector{dimension::length}, "A corner of a lattice cell: particles sit at its centre.",
     at<&Start::lattice, &LatticeFill::origin>, of_lattices, Default{"lower"}},
    {"lower", Vector{dimension::length}, "Extent that is filled.", at<&Start::lattice, &LatticeFill::lower>,
     of_lattices, Default{"the domain's"}},
    {"upper", Vector{dimension::length}, "Its other corner.", at<&Start::lattice, &LatticeFill::upper>,
     of_lattices, Default{"the domain's"}},
    {"jitter",
     Number{dimension::none, {.least = 0, .most = 0.5, .below_most = true, .is = "it is in spacings,"}},
     "Uniform random displacement of movers in each direction, in spacings. Flows without a surface need "
     "about 0.05.",
     at<&Start::lattice, &LatticeFill::jitter>, of_lattices},
    {"seed", Whole{}, "Of the jitter, and of the radii of grains.", at<&Start::seed>},
    {"free_surface", Flag{}, "With a file: whether there is one.", at<&Start::free_surface>, of_fluids,
     Default{"true unless all axes are periodic"}},
    {"velocity",
     Special{
         R"("rest", "taylor_green" or an array of speeds)", R"("rest")",
         R"({"anyOf": [{"enum": ["rest", "taylor_green"]}, {"type": "array", "items": {"type": ["number", "string"]}}]})"},
     "Of all movers [m/s]. Grains start with \"rest\" or an array; those of a file or a tile have their own.",
     Default{"\"rest\""}},
    {"flow_speed", Number{dimension::speed, positive}, "Of \"taylor_green\": its largest speed U.",
     at<&Start::velocity, &StartVelocity::flow_speed>, of_fluids},
    {"flow_length", Number{dimension::length, positive}, "Of \"taylor_green\": its period L.",
     at<&Start::velocity, &StartVelocity::flow_length>, of_fluids},
    {"pressure", Words{initial_pressure_words},
     "\"uniform\": all matter begins compressed, and a closed box keeps it so; \"taylor_green\" goes with "
     "that velocity.",
     at<&Start::pressure>, of_fluids},
    {"uniform_pressure", Number{dimension::pressure, not_negative},
     "Of \"uniform\", above domain.surface_pressure or the background's. Confines what moves along a period, "
     "where no hydrostatic pressure can, if it is above what gravity pulls apart there: the weight less the "
     "background's, over a period.",
     at<&Start::uniform_pressure>, of_fluids, where("pressure", "uniform"), required},
    {"surface_height", Number{dimension::length},
     "Hydrostatic: height of zero pressure, against gravity, under the first fluid.", of_fluids,
     Default{"required there, or layers"}},
    {"layer", Inner{&layer}, "Hydrostatic, instead of surface_height.", of_fluids},
    {"region", Inner{&region}, "Paints the lattice.", of_lattices,
     Default{"required, unless file or tile is given"}},
    {"grains", Inner{&fill}, "Places grains in a fluid or in melts.", of_mixtures,
     Default{"required of them"}},
});
inline constexpr Table<Start> start{
    {"start", false, "The first state: a lattice painted by regions, a file, or a tile of grains.",
     start_keys}};

}  // namespace sph::keys

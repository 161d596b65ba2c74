// The first state of a scene: [start] and the tables in it.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "sph/scene/grain_scene.hpp"

namespace sph {

enum class RegionShape { everywhere, box, ball, cylinder, cone, polygon, mesh };

class MeshVolume;

/// Closed triangles.
struct RegionMesh {
  std::string file;                          ///< STL or OBJ
  std::string content;                       ///< hash of what was read when the run began
  double scale = 1;                          ///< metres of a unit of the file
  Double3 origin{};                          ///< where the origin of the file is [m]
  std::shared_ptr<const MeshVolume> volume;  ///< what was read
  friend bool operator==(const RegionMesh& a, const RegionMesh& b) {
    return a.file == b.file && a.content == b.content && a.scale == b.scale && a.origin == b.origin;
  }
};

/// Painter's rule: a lattice point belongs to the last region that contains it. group -1 leaves it empty.
struct Region {
  int group = -1;
  RegionShape shape = RegionShape::everywhere;
  Double3 lower{}, upper{};  ///< box: lower <= x < upper [m]
  Double3 centre{};          ///< ball: |x - centre| < radius [m]
  Double3 from{}, to{};      ///< cylinder, cone: ends of the axis, which is that of a coordinate [m]
  double radius = 0;         ///< of a cone at `from` ...
  double top_radius = 0;     ///< ... and at `to`
  std::vector<std::array<double, 2>> points;  ///< polygon: its corners [m]
  RegionMesh mesh;
  friend bool operator==(const Region&, const Region&) = default;
};

/// Cubic in 3D; close packings, hexagonal in 2D, face-centred cubic in 3D.
enum class LatticeKind { square, hexagonal, fcc };
inline constexpr double fcc_edge = 1.5874010519681994;       ///< 4^(1/3): of a cube of 4 points, in spacings
inline constexpr double hexagonal_edge = 1.074569931823542;  ///< sqrt(2/sqrt(3)): between points of a row
inline constexpr double hexagonal_rows = 1.861209718204198;  ///< sqrt(3) of these: two rows

/// A lattice that regions paint.
struct LatticeFill {
  LatticeKind kind = LatticeKind::square;
  Double3 origin{};          ///< a corner of a lattice cell: points sit at origin + (k + 1/2) spacing [m]
  Double3 lower{}, upper{};  ///< extent that is filled [m]
  std::vector<Region> regions;
  double jitter = 0;  ///< amplitude of a uniform displacement of movers, in spacings
  friend bool operator==(const LatticeFill&, const LatticeFill&) = default;
};

enum class InitialVelocity { rest, uniform, taylor_green };
enum class InitialPressure { zero, uniform, hydrostatic, taylor_green };

/// Of all movers.
struct StartVelocity {
  InitialVelocity kind = InitialVelocity::rest;
  Double3 uniform{};       ///< [m/s]
  double flow_speed = 1;   ///< U of the Taylor-Green flow [m/s]
  double flow_length = 1;  ///< its period [m]
  friend bool operator==(const StartVelocity&, const StartVelocity&) = default;
};

/// One of the still fluids on top of each other under which a hydrostatic pressure builds up.
struct Layer {
  int group = -1;
  double top = 0;       ///< height against gravity [m]; of the first that of the surface
  double pressure = 0;  ///< of the first at its top, above that of the surface [Pa]
  friend bool operator==(const Layer&, const Layer&) = default;
};

struct Start {
  double spacing = 0;  ///< dx [m]
  // Either a lattice painted by regions ...
  LatticeFill lattice;
  // ... or a file with columns id, x, v, group, rho, m (HDF5 or CSV).
  std::string file;
  std::optional<bool> free_surface;  ///< file: is there one? Default: unless all axes are periodic
  std::vector<GrainFill> fills;      ///< of grains beside fluids
  Tile tile;                         ///< ... or, grains only, a packing repeated side by side
  std::uint64_t seed = 0;            ///< of the jitter, and of the radii of grains

  StartVelocity velocity;
  InitialPressure pressure = InitialPressure::zero;
  double uniform_pressure = 0;  ///< uniform: above that of the surface, or of the background [Pa]
  std::vector<Layer> layers;    ///< hydrostatic: from the surface downwards
  bool has_surface = false;  ///< resolved: fluids and solids have a free surface, as far as the start shows
  friend bool operator==(const Start&, const Start&) = default;
};

}  // namespace sph

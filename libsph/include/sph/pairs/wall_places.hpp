// Walls as the search and the pass see them: planes, and meshes of triangles, with where they are now.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "sph/core/particles.hpp"
#include "sph/pairs/triangle_surface.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

/// Partner keys of walls lie above all ids of particles: of planes wall_key | plane, of facets
/// wall_key | (mesh + 1) << 32 | facet.
inline constexpr std::uint64_t wall_key = largest_id + 1;

/// What the key of a wall says.
struct WallName {
  explicit WallName(std::uint64_t key)
      : wall((key & ~wall_key) >> 32 == 0 ? key & ~wall_key : ((key & ~wall_key) >> 32) - 1),
        facet((key & ~wall_key) >> 32 == 0 ? none : static_cast<std::uint32_t>(key)) {}
  static constexpr std::uint32_t none = ~std::uint32_t{0};
  std::uint64_t wall;   ///< which plane, or which mesh
  std::uint32_t facet;  ///< none: of a plane
  [[nodiscard]] bool is_facet() const { return facet != none; }
};

/// A grain or a wall, in the words of messages.
[[nodiscard]] std::string text_of_partner(const Scene& scene, std::uint64_t key);

struct PlaneNow {
  std::array<std::int64_t, 3> point;  ///< [quanta]
  std::array<double, 3> normal, velocity;
  std::uint32_t group;
  bool present;
};

/// Of a point from a plane, along its normal [m].
[[nodiscard]] double distance_from(const PlaneNow& plane, const std::int64_t* x, double quantum);

/// Bounds of places, each included [quanta].
struct PlaceBox {
  std::array<std::int64_t, 3> lower, upper;
  PlaceBox(const RowPlaces& x, std::size_t first, std::size_t last);
};

/// The planes that are, and of which distance_from() a place in the box may be less than `reach`, ascending.
void find_near(std::span<const PlaneNow> planes, const PlaceBox& box, double reach, double quantum,
               std::vector<std::uint32_t>& out);

/// A surface about its centre, turned and moved: x = centre + way + R x_0.
struct MeshNow {
  const TriangleSurface* surface;
  std::array<std::int64_t, 3> centre;  ///< [quanta]
  Point3 way;                          ///< [m]
  std::array<Point3, 3> rotation;      ///< rows of R
  Point3 velocity, spin;               ///< of the centre [m/s], about it [rad/s]
  Point3 lightness;  ///< its square along a normal is 1 / mass of a mesh that a contact there moves [kg^-1/2]
  double smooth_cosine;  ///< of the angle between facets that a grain touches as one
  std::uint32_t group;
  bool present;  ///< grains touch it
  bool listed;   ///< ... or may before the lists are made anew

  [[nodiscard]] Point3 in_frame(const std::int64_t* x, double quantum) const;
  [[nodiscard]] Point3 turned(const Point3& x) const;
};

/// Lists number what a grain can touch of walls: the planes, then the facets of all meshes.
class WallNumbers {
 public:
  WallNumbers() = default;
  WallNumbers(std::size_t planes, std::span<const MeshNow> meshes);
  struct Facet {
    std::size_t mesh;
    std::uint32_t facet;
  };
  [[nodiscard]] bool is_facet(std::uint32_t number) const { return number >= planes_ && number < end_; }
  [[nodiscard]] Facet facet(std::uint32_t number) const;
  [[nodiscard]] std::uint32_t first(std::size_t mesh) const { return first_[mesh]; }
  [[nodiscard]] std::uint64_t key(std::uint32_t number) const;

 private:
  std::uint32_t planes_ = 0, end_ = 0;
  std::vector<std::uint32_t> first_;  ///< of each mesh
};

struct WallsNow {
  std::vector<PlaneNow> planes;
  std::vector<MeshNow> meshes;
};

}  // namespace sph

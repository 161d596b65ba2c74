// Where a grain touches a mesh: at points nearer to its centre than all of the surface around them. A face has one where the
// centre is above it; an edge or vertex, if it is the nearest of all facets that have it. Of such points that a
// grain sees in nearly the same direction (facets of a drum, say) it touches the nearest alone: a smooth surface is one contact.
// Potential energy is continuous but where the angle between two points, of which one at least is of an edge or vertex, passes that
// of smoothness while both are overlapped. What a contact remembers passes from facet to facet, to one that shares a
// vertex or lies nearly in the same plane.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "sph/pairs/contact_lists.hpp"

namespace sph {

struct FacetContact {
  std::size_t entry;  ///< of the list: group * lanes + lane
  std::size_t from;   ///< the entry whose history it has
  double distance;    ///< of the grain's centre [m]
  Point3 away;        ///< unit vector, from the surface to the grain
  Point3 velocity;    ///< of the surface there [m/s]
  std::size_t mesh;
};

/// Where grains are and how large they are, in columns or in lines.
class GrainPlaces {
 public:
  explicit GrainPlaces(const Particles& grains)
      : x_(reinterpret_cast<const std::byte*>(grains.data<Field::position>())),
        radius_(grains.data<Field::radius>()),
        x_bytes_(3 * sizeof(double)),
        radius_width_(1) {}
  explicit GrainPlaces(const double* motion)
      : x_(reinterpret_cast<const std::byte*>(motion)),
        radius_(motion + 3),
        x_bytes_(GrainLines::motion_width * sizeof(double)),
        radius_width_(GrainLines::motion_width) {}
  [[nodiscard]] std::array<std::int64_t, 3> x(std::size_t row) const {
    return position_in(x_ + row * x_bytes_);
  }
  [[nodiscard]] double radius(std::size_t row) const { return radius_[row * radius_width_]; }

 private:
  const std::byte* x_;
  const double* radius_;
  std::size_t x_bytes_, radius_width_;
};

class FacetContacts {
 public:
  FacetContacts() = default;
  /// `walls` must outlive it.
  FacetContacts(const WallsNow& walls, double quantum)
      : meshes_(walls.meshes), numbers_(walls.planes.size(), walls.meshes), quantum_(quantum) {}

  [[nodiscard]] bool any() const { return !meshes_.empty(); }
  [[nodiscard]] std::span<const MeshNow> meshes() const { return meshes_; }

  /// Contacts of a block of a list. `facets`: its runs, which keep what there was to see; nothing depends on what they kept.
  std::span<const FacetContact> look(const ContactGroups& list, FacetRuns& facets, const ContactBlock& block,
                                     const GrainPlaces& grains);
  /// Of a whole list.
  std::span<const FacetContact> look(const ContactGroups& list, const GrainPlaces& grains);
  /// Of the block looked at last: a facet of this group touches.
  [[nodiscard]] bool any_in(std::size_t group) const { return touching_[group - first_group_] != 0; }
  /// That of an entry; nullptr if it does not touch.
  [[nodiscard]] const FacetContact* at(std::size_t entry) const;
  /// Moves what contacts remember to the entries that have it from now on.
  void hand_over(ContactGroups& list, std::size_t history) const;

 private:
  struct Candidate {
    std::size_t entry;
    std::uint32_t facet;
    NearPoint near;
    bool kept;
  };
  void look_at_run(const ContactGroups& list, std::span<const std::uint32_t> near, std::size_t mesh,
                   const Point3& at, double radius);
  void find_near(const ContactGroups& list, FacetRun& run, std::uint32_t* near, const Point3& at,
                 double radius) const;
  void keep_nearest(const MeshNow& mesh);
  void add(const MeshNow& mesh, std::size_t number, const Candidate& candidate, const Point3& x);
  void find_histories(const ContactGroups& list, const MeshNow& mesh, std::size_t found);

  std::span<const MeshNow> meshes_;
  WallNumbers numbers_;
  double quantum_ = 0;
  std::size_t first_group_ = 0;          ///< of those looked at
  std::vector<std::uint8_t> touching_;   ///< [groups] bit l: lane l touches
  std::vector<std::uint32_t> of_entry_;  ///< [groups * lanes] its place in found_
  std::vector<FacetContact> found_;
  std::vector<Candidate> candidates_;
};

}  // namespace sph

// Where bonds see the particles of clamps, and what these give back of the forces on them (terms/clamp.hpp): of bonds alone.
// Contacts and viscosity act on a clamp where it is and leave their force with it.
#pragma once

#include <memory>

#include "sph/models/builder.hpp"
#include "sph/models/wall_mirror.hpp"

namespace sph {

class Clamps {
 public:
  explicit Clamps(const Scene& scene);
  /// Before the deformation is known.
  void add_shifts(Builder& builder) const;
  /// After the forces of bonds are.
  void add_reactions(Builder& builder) const;

 private:
  std::shared_ptr<const WallMirror> mirror_;
};

}  // namespace sph

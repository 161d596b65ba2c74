// The scene: everything a run is made of, read from one TOML file and resolved (all defaults filled in, all
// quantities SI). A record for each table of the file; what one model alone reads stands in the header of that
// model. The next state is a function of the present state and this struct alone; `decomposition` and `output`
// may change the speed and the files of a run, never a bit of its particles.
#pragma once

#include <string>
#include <vector>

#include "sph/core/error.hpp"
#include "sph/scene/frame_scene.hpp"
#include "sph/scene/grain_scene.hpp"
#include "sph/scene/group_scene.hpp"
#include "sph/scene/run_scene.hpp"
#include "sph/scene/start_scene.hpp"
#include "sph/scene/term_scene.hpp"

namespace sph {

struct Scene {
  std::string name;
  std::string file;  ///< where it was read from
  int dim = 2;
  Domain domain;
  KernelControl kernel;
  std::vector<Group> groups;
  GrainScene grains;
  Start start;
  Terms terms;
  TimeControl time;
  Decomposition decomposition;
  OutputControl output;

  /// There is a free surface, and particles are shifted.
  [[nodiscard]] bool open() const { return terms.shifting && start.has_surface; }
  /// Fluids, and grains that act on them.
  [[nodiscard]] bool is_mixture() const { return has_grains() && has_matter(); }
  /// Melts, and grains in them.
  [[nodiscard]] bool is_suspension() const { return has_grains() && has_melt(); }
  [[nodiscard]] bool has_grains_in_flow() const { return is_mixture() || is_suspension(); }
  /// Of grains alone.
  [[nodiscard]] bool of_grains() const { return has_grains() && !has_matter() && !has_melt(); }
  [[nodiscard]] bool has_grains() const { return has_kind(GroupKind::grain); }
  [[nodiscard]] bool has_melt() const { return has_kind(GroupKind::melt); }
  [[nodiscard]] bool has_matter() const;          ///< fluids or solids
  [[nodiscard]] double largest_diameter() const;  ///< of grains, 0 if there are none [m]
  [[nodiscard]] double kernel_radius() const;     ///< 0 if there is no matter [m]
  [[nodiscard]] double bond_width() const;        ///< smoothing length of the kernel of bonds [m]
  /// Range of interaction [m]: the kernel's radius or the largest diameter of the grains, whichever is more; of melts
  /// alone a cell.
  [[nodiscard]] double support() const;
  [[nodiscard]] double list_range()
      const;  ///< how far pairs of the lists may be apart [m]: support(), or more
  [[nodiscard]] bool has_kind(GroupKind k) const;
  [[nodiscard]] bool has_gas_flow() const;  ///< through bubbly magma
  [[nodiscard]] bool has_exchange() const { return has_heat() || has_gas_flow() || has_water_diffusion(); }
  [[nodiscard]] bool has_water_diffusion() const;                      ///< of what is dissolved in it
  [[nodiscard]] bool has_heat() const;                                 ///< its fluids and solids have
  [[nodiscard]] bool total_lagrangian() const;                         ///< its solids are
  [[nodiscard]] int group_index(const std::string& group_name) const;  ///< -1 if there is none
  friend bool operator==(const Scene&, const Scene&) = default;
};

[[nodiscard]] double particle_volume(const Scene& scene);  ///< spacing^dim [m^dim]
/// There are total-Lagrangian solids in a fluid, or alone.
[[nodiscard]] bool has_wet_bodies(const Scene& scene);
[[nodiscard]] bool has_dry_bodies(const Scene& scene);
/// Some of them deform; some do not.
[[nodiscard]] bool has_bonds(const Scene& scene);
[[nodiscard]] bool has_rigid_bodies(const Scene& scene);
/// Bodies, or bodies and walls, can touch each other.
[[nodiscard]] bool has_body_contacts(const Scene& scene);
/// Of each group the index of the rigid body that its particles belong to, -1 if to none.
[[nodiscard]] std::vector<int> rigid_bodies_of(const Scene& scene);
/// Some of them can fail.
[[nodiscard]] bool has_failure(const Scene& scene);

/// Reads and resolves a scene; `overrides` are "a.b=v" texts of --set, applied before anything is checked.
/// If `end` has any it is taken instead of the scene's, which is checked all the same.
/// Throws InputError "file:line:column: key: what is wrong; what would be right" for the first problem found.
[[nodiscard]] Scene read_scene(const std::string& path, const std::vector<std::string>& overrides,
                               const End& end = {});
/// The same from text already in memory (`name` stands for the file in messages). `begins`: looks at the files that it names too,
/// which a run that goes on needs no more.
[[nodiscard]] Scene parse_scene(const std::string& text, const std::string& name,
                                const std::vector<std::string>& overrides, const End& end = {},
                                bool begins = false);
/// The resolved scene as TOML: reading it back gives the same scene. Stored in every file.
[[nodiscard]] std::string to_toml(const Scene& scene);

}  // namespace sph

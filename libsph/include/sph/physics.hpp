// What a scene computes: the fields it needs and its ordered list of passes and local updates. Which halo
// refresh goes before which pass is derived from what the passes read; nothing here knows about ranks.
#pragma once

#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "sph/eos.hpp"
#include "sph/findings.hpp"
#include "sph/fusions.hpp"
#include "sph/particles.hpp"
#include "sph/scene.hpp"
#include "sph/surface_gradient.hpp"
#include "sph/wall_distance.hpp"
#include "sph/wall_mirror.hpp"

namespace sph {

/// Maxima that travel in the step's one reduction; part of the state where the next step depends on them.
struct StepMaxima {
  double speed = 0;         ///< [m/s]
  double acceleration = 0;  ///< [m/s^2]
  std::int64_t volume = 0;  ///< of this rank's fluid, see FluidVolume; a sum
  double sound = 0;         ///< of ideal gases; 0: not looked at yet [m/s]
  double viscosity = 0;     ///< eta / rho of ideal gases [m^2/s]
  MotionSums motion{};      ///< of this rank's particles that move
};

/// Largest c dt / h of a run, c the sound speed of the stiffest group: beyond it the integrator is unstable.
[[nodiscard]] inline double courant_limit(const Scene& scene) {
  return scene.total_lagrangian() ? 1.0 : 1.2;  // contacts and the stiffest allowed hourglass control
}
/// What is recommended, and the default of time.cfl.
inline constexpr double courant_recommended = 0.8;

class ViscositySolver;

struct Pass {
  std::string name;
  const Fusion* fusion;
  bool movers, walls;  ///< rows it runs over
  FieldSet reads;      ///< of neighbours, so needed in the halo
  std::function<void(Particles&, const RowRanges&, const GlobalState&)>
      update;                               ///< local update after it; may be empty
  FieldSet changes;                         ///< fields the update, or the solver, changes
  std::shared_ptr<ViscositySolver> solver;  ///< has the pass repeated until it has converged; may be empty
};

class Physics {
 public:
  Physics(const Scene& scene, const PositionScale& scale);

  [[nodiscard]] FieldSet fields() const { return fields_; }
  [[nodiscard]] const std::vector<Pass>& passes() const { return passes_; }
  [[nodiscard]] PassContext context(Particles& particles, const NeighbourLists& lists,
                                    decomp::LargeVector<std::byte>& rows, double dt) const;

  /// Pressure and what else follows from the state of a particle alone.
  void derive(Particles& particles, std::size_t first, std::size_t last) const;

  /// x += v dt, rounded to quanta, for movers.
  void advance(Particles& particles, const RowRanges& ranges, double dt) const;

  /// Gravity and what else accelerates a mover besides the pair forces [m/s^2].
  [[nodiscard]] Double3 body_acceleration(const Particles& particles, std::size_t row) const;

  /// v += (F/m + g) dt for movers; walls get their own velocity back; shifting. Then changes of group.
  [[nodiscard]] StepMaxima integrate(Particles& particles, const RowRanges& ranges,
                                     const GlobalState& global) const;

  /// How far the partners of each row may be before the next rebuild, in metres, the ways of the particles
  /// left aside; empty where that is the same for all.
  [[nodiscard]] std::vector<double> reaches(const Particles& particles) const;
  /// Largest growth of the owned particles' reach since they were `listed`, at the end of the step to come.
  [[nodiscard]] double growth(const Particles& particles, std::span<const double> listed) const;

  /// Fields integrate() changes.
  [[nodiscard]] FieldSet integrated() const;

  /// Largest step the integrator takes [s], from the maxima of the step before.
  [[nodiscard]] double time_step(const StepMaxima& maxima) const;
  /// Bounds on how far advance() and the shifting in integrate() move any particle, from the maxima known
  /// at the start of the step [m].
  [[nodiscard]] double longest_advance(const GlobalState& global) const;
  [[nodiscard]] double longest_shift(const GlobalState& global) const;
  /// ... and on how far from its place a pass takes a particle to be: where it was half a step ago [m].
  [[nodiscard]] double longest_look_back(const GlobalState& global) const;
  /// Faster than that nothing flies that the scene could mean [m/s].
  [[nodiscard]] double speed_limit() const;
  /// Speed, sound and viscosity of this rank's particles at the start.
  [[nodiscard]] StepMaxima maxima_at_start(const Particles& particles) const;
  /// Of this rank's particles that move, where the scene shifts them; see FluidVolume.
  [[nodiscard]] std::int64_t fluid_volume(const Particles& particles) const;
  /// Of this rank's particles that move, about the mean known before; and what the sums over all ranks say.
  [[nodiscard]] MotionSums motion_sums(const Particles& particles, const GlobalState& global) const;
  [[nodiscard]] CommonMotion common_motion(const MotionSums& found, const GlobalState& global) const;
  /// c dt / h for the stiffest group: what `check` warns about above 0.8 and refuses above the limit.
  [[nodiscard]] double courant_number(double dt) const;

  /// Of this step: what no particle may be.
  [[nodiscard]] const Findings& findings() const { return findings_; }

  [[nodiscard]] const Double3& wall_velocity(std::uint32_t group) const {
    return scene_->groups[group].wall_velocity;
  }
  [[nodiscard]] bool is_wall(std::uint32_t group) const {
    return scene_->groups[group].kind == GroupKind::wall;
  }

 private:
  void set_sph_constants();
  void build_conservative();
  void add_walls(bool weighted);
  void find_walls_nearby();
  void build_implicit_viscosity(bool walls);
  void add_curvature();
  void build_ida();
  void build_gas();
  void build_total_lagrangian();
  void update_movers(Particles&, std::size_t first, std::size_t last, const GlobalState&) const;
  [[nodiscard]] double disordered_share(const Particles&, std::size_t row) const;
  [[nodiscard]] double tension_control(const Particles&, std::size_t row) const;
  static double filling(const GlobalState&);
  void update_walls(Particles&, const RowRanges&, const GlobalState&) const;
  void hold_off(Particles&, const RowRanges&, double dt) const;
  void find_curvature(Particles&, const RowRanges&) const;
  void average_curvature(Particles&, const RowRanges&) const;
  void find_walls(Particles&, const RowRanges&) const;
  void update_ida(Particles&, std::size_t first, std::size_t last, double dt) const;
  template <int D>
  void update_bonds(Particles&, std::size_t first, std::size_t last, const GlobalState&) const;
  void check_bonds(Particles&, std::size_t row, double count, double shape, const GlobalState&) const;
  void find_fault(const Particles&, std::size_t row, const GlobalState&, const std::string& what) const;
  [[nodiscard]] double shifting_speed(const Particles&, std::size_t row, const GlobalState&,
                                      double rest) const;
  void shift(Particles&, const RowRanges&, const GlobalState&) const;
  void update_gas(Particles&, const RowRanges&, const GlobalState&) const;
  void heat(Particles&, const RowRanges&, const GlobalState&, StepMaxima&) const;
  void look_at_gas(const Particles&, std::size_t first, std::size_t last, StepMaxima&) const;
  void change_group(Particles&, std::size_t row) const;
  void average(Particles&, const GlobalState&) const;
  void add_pass(std::string name, const std::vector<Term>& terms, bool movers, bool walls);

  const Scene* scene_;
  PositionScale scale_;
  bool gas_;  ///< there is an ideal gas
  FieldSet fields_;
  std::vector<Pass> passes_;
  GroupTable groups_;
  std::vector<BubblyEos> bubbly_;  ///< by group; used where the group's eos says so
  bool bulk_viscous_ = false;
  std::vector<int> transitions_;  ///< groups whose particles may change group
  RowScale row_scale_;
  SurfaceGradient surface_;
  std::optional<WallMirror> mirror_;           ///< where walls do not slip
  std::optional<WallDistance> wall_distance_;  ///< beside implicit viscosity
  TermConstants<double> constants_;
  double gradient_factor_, force_factor_, diffusion_factor_;
  double own_concentration_;  ///< V W(0) of a particle of volume spacing^D
  double kernel_at_zero_;     ///< W(0) without its factor
  mutable Findings findings_;
};

/// Fixed-point scale of a scene: the finest power of two with which the domain spans at most 2^61 quanta and
/// the support at most 2^50, so that pair distances convert to double exactly.
[[nodiscard]] PositionScale position_scale(const Scene& scene);
/// Rows of single precision hold positions without so many low bits.
[[nodiscard]] int row_position_shift(const Scene& scene, const PositionScale& scale);

}  // namespace sph

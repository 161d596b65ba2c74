// What a scene of fluids and solids computes: the fields it needs and the stages of its plan. Nothing here
// knows about ranks.
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
#include "sph/models/model.hpp"
#include "sph/particles.hpp"
#include "sph/scene.hpp"
#include "sph/surface_gradient.hpp"
#include "sph/wall_distance.hpp"
#include "sph/wall_mirror.hpp"

namespace sph {

/// Largest c dt / h of a run, c the sound speed of the stiffest group: beyond it the integrator is unstable.
[[nodiscard]] inline double courant_limit(const Scene& scene) {
  return scene.total_lagrangian() ? 1.0 : 1.2;  // contacts and the stiffest allowed hourglass control
}
/// What is recommended, and the default of time.cfl.
inline constexpr double courant_recommended = 0.8;

class Physics final : public Model {
 public:
  Physics(const Scene& scene, const PositionScale& scale);

  void reserve(Reduction& reduction) override;
  [[nodiscard]] bool report(const StepState& state, Reduction& reduction) override;
  void guard(const decomp::Comm& comm, const StepState& state, const Reduction& reduction) const override;
  void act(const Reduction& reduction, GlobalState& global) override;
  void set_step(const Reduction& reduction, GlobalState& global) const override;
  [[nodiscard]] double longest_look_back(const GlobalState& global) const override;
  [[nodiscard]] double growth(const Reduction& reduction) const override { return reduction[growth_]; }
  [[nodiscard]] double speed_limit() const override;

  [[nodiscard]] FieldSet fields() const { return fields_; }
  [[nodiscard]] const Plan& plan() const { return plan_; }
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
  [[nodiscard]] const std::vector<double>& find_reaches(const Particles& particles);

  /// Largest step the integrator takes [s], from the maxima of the step before.
  [[nodiscard]] double time_step(const StepMaxima& maxima) const;
  /// Bounds on how far advance() and the shifting in integrate() move any particle, from the maxima known
  /// at the start of the step [m].
  [[nodiscard]] double longest_advance(const GlobalState& global) const;
  [[nodiscard]] double longest_shift(const GlobalState& global) const;
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
  /// Largest growth of the owned particles' reach since they were listed, at the end of the step to come.
  [[nodiscard]] double growth_since_listed(const Particles&) const;
  void average(Particles&, const GlobalState&) const;
  /// Rows that a stage runs over.
  enum class Rows : std::uint8_t { movers, walls, all };
  using Update = std::function<void(Particles&, const RowRanges&, const GlobalState&)>;
  [[nodiscard]] Stage sums_over_pairs(std::string name, const std::vector<Term>& terms, Rows rows);
  void add_sums(std::string name, const std::vector<Term>& terms, Rows rows = Rows::movers);
  void add_update(std::string name, FieldSet writes, Update update);
  void add_drift();
  void add_kick();

  const Scene* scene_;
  PositionScale scale_;
  bool gas_;  ///< there is an ideal gas
  FieldSet fields_;
  Plan plan_;
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
  double own_concentration_;    ///< V W(0) of a particle of volume spacing^D
  double kernel_at_zero_;       ///< W(0) without its factor
  std::vector<double> listed_;  ///< reaches of the rows when they were listed, where each has its own [m]
  Reduction::Maximum faults_, sound_, viscosity_, growth_, unlike_;
  Reduction::Sums motion_, volume_;  ///< none where particles are not shifted
  mutable Findings findings_;
};

/// Fixed-point scale of a scene: the finest power of two with which the domain spans at most 2^61 quanta and
/// the support at most 2^50, so that pair distances convert to double exactly.
[[nodiscard]] PositionScale position_scale(const Scene& scene);
/// Rows of single precision hold positions without so many low bits.
[[nodiscard]] int row_position_shift(const Scene& scene, const PositionScale& scale);

}  // namespace sph

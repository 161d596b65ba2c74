// The scene: everything a run is made of, read from one TOML file and resolved (all defaults filled in, all
// quantities SI). The next state is a function of the present state and this struct alone; the members of
// `Decomposition` and `Output` may change the speed and the files of a run, never a bit of its particles.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "sph/core/error.hpp"
#include "sph/scene/grain_scene.hpp"

namespace sph {

enum class Formulation { conservative, ida };
enum class Precision { double_, mixed };
enum class KernelShape { quintic, wendland_c2, wendland_c4 };

enum class GroupKind { fluid, solid, wall, grain };
/// What the pressure depends on besides the density: nothing, the gas content, the internal energy.
enum class EosKind { barotropic, bubbly, ideal_gas };
struct EquationOfState;  // laws/eos/law.hpp
[[nodiscard]] const EquationOfState* linear_eos();
struct DragLaw;  // laws/drag/law.hpp
[[nodiscard]] const DragLaw* no_drag();
/// updated: stress follows the rate of strain; total: it is a function of the deformation since the start.
enum class Lagrangian { updated, total };

/// One material. Particles name it by its index in Scene::groups.
struct Group {
  std::string name;
  GroupKind kind = GroupKind::fluid;
  const EquationOfState* eos = linear_eos();
  double density = 0;                                 ///< rho_0 at zero pressure [kg/m^3]
  double bulk_modulus = 0;                            ///< K, or K_l of the liquid [Pa]
  double viscosity = 0;                               ///< eta [Pa s]
  double bulk_viscosity = 0;                          ///< zeta, Ida eq. (9) [Pa s]
  double shear_modulus = 0;                           ///< mu, solids [Pa]; lambda = K - 2/3 mu
  LawConstants eos_constants{};                       ///< of the equation of state, in the order of its keys
  double heat_ratio = 0;                              ///< gamma of an ideal gas [1]
  double start_pressure = 0;                          ///< of an ideal gas, at rho_0; K = gamma p_0 [Pa]
  double gas_content = 0;                             ///< m, Ida eq. (14) [1]
  double gas_rt = 0;                                  ///< R T, Ida eq. (13) [m^2/s^2]
  double solubility_pressure = 0;                     ///< p_s [Pa]
  double solubility_exponent = 1;                     ///< gamma [1]
  std::optional<double> fragmentation_void_fraction;  ///< psi_f: above it a particle joins fragments_to
  int fragments_to = -1;                              ///< index of the spray group, -1 if none
  Lagrangian lagrangian = Lagrangian::updated;        ///< solids
  int clamps = -1;          ///< walls: index of the total-Lagrangian solid that is bonded to them, -1 if none
  Double3 wall_velocity{};  ///< walls, fixed grains: of the material, the particles stay where they are [m/s]
  bool slip = false;        ///< walls: no shear on what flows past
  GrainMaterial grain;      ///< kind = grain; of the values above it has name, density and wall_velocity
  friend bool operator==(const Group&, const Group&) = default;
};

/// Moves as a fluid or a solid, not as grains.
[[nodiscard]] inline bool is_matter(const Group& g) {
  return g.kind == GroupKind::fluid || g.kind == GroupKind::solid;
}

enum class RegionShape { everywhere, box, ball };

/// Painter's rule: a lattice point belongs to the last region that contains it. group -1 leaves it empty.
struct Region {
  int group = -1;
  RegionShape shape = RegionShape::everywhere;
  Double3 lower{}, upper{};  ///< box: lower <= x < upper [m]
  Double3 centre{};          ///< ball: |x - centre| < radius [m]
  double radius = 0;
  friend bool operator==(const Region&, const Region&) = default;
};

enum class LatticeKind { square, hexagonal };
enum class InitialVelocity { rest, uniform, taylor_green };
enum class InitialPressure { zero, hydrostatic, taylor_green };

/// One of the still fluids on top of each other under which a hydrostatic pressure builds up.
struct Layer {
  int group = -1;
  double top = 0;  ///< height against gravity [m]; of the first that of zero pressure
  friend bool operator==(const Layer&, const Layer&) = default;
};

/// Grains in a fluid: a cubic lattice of its own fills a box.
struct GrainFill {
  int group = -1;            ///< of grains
  Double3 lower{}, upper{};  ///< points sit at lower + (k + 1/2) spacing, below upper [m]
  double spacing = 0;        ///< [m]
  friend bool operator==(const GrainFill&, const GrainFill&) = default;
};

struct Start {
  // Either a lattice painted by regions ...
  LatticeKind lattice = LatticeKind::square;
  Double3 lattice_origin{};  ///< a corner of a lattice cell: points sit at origin + (k + 1/2) spacing [m]
  Double3 lower{}, upper{};  ///< extent that is filled [m]
  std::vector<Region> regions;
  double jitter = 0;  ///< amplitude of a uniform displacement of movers, in spacings
  std::uint64_t seed = 0;
  // ... or a file with columns id, x, v, group, rho, m (HDF5 or CSV).
  std::string file;
  std::optional<bool> free_surface;  ///< file: is there one? Default: unless all axes are periodic
  std::vector<GrainFill> fills;      ///< of grains beside fluids
  Tile tile;                         ///< ... or, grains only, a packing repeated side by side

  InitialVelocity velocity = InitialVelocity::rest;
  Double3 uniform_velocity{};  ///< [m/s]
  double flow_speed = 1;       ///< U of the Taylor-Green flow [m/s]
  double flow_length = 1;      ///< its period [m]
  InitialPressure pressure = InitialPressure::zero;
  std::vector<Layer> layers;  ///< hydrostatic: from the surface downwards
  friend bool operator==(const Start&, const Start&) = default;
};

/// A stress in a layer as thick as the kernel, or the jump of the pressure (terms/surface_tension.hpp,
/// terms/tension_jump.hpp).
enum class TensionForm { stress, jump };

/// Between the particles of two groups of fluid.
struct InterfaceTension {
  std::array<int, 2> between{-1, -1};  ///< groups; -1: there is none
  double coefficient = 0;              ///< sigma [N/m]
  TensionForm form = TensionForm::stress;
  friend bool operator==(const InterfaceTension&, const InterfaceTension&) = default;
};

/// How the pressures of a pair are summed: p_i + p_j, or each weighted by the other's density.
enum class PressureWeights { volume, density };
/// See sph/terms/viscosity.hpp.
enum class ViscosityForm { laplacian, symmetric };

/// How a fluid and the grains in it act on each other.
struct DragControl {
  const DragLaw* law = no_drag();
  bool own_disturbance = true;  ///< what a grain itself does to the fluid around it is taken out
  friend bool operator==(const DragControl&, const DragControl&) = default;
};

struct Terms {
  double density_diffusion = 0.1;   ///< delta
  double artificial_viscosity = 0;  ///< alpha
  double quadratic_viscosity = 0;   ///< beta, against strong shocks
  double conduction = 0;            ///< alpha_u, of ideal gases
  bool shifting = false;
  ViscosityForm viscosity = ViscosityForm::laplacian;
  bool implicit_viscosity = false;    ///< viscous forces of the end of the step: they limit no time step
  double viscosity_tolerance = 1e-4;  ///< of implicit viscosity, see models/viscosity.cpp
  PressureWeights pressure_weights = PressureWeights::volume;
  InterfaceTension surface_tension;
  double hourglass = 0.3;        ///< total-Lagrangian solids: stiffness against hourglass modes / modulus
  double largest_stretch = 1.2;  ///< of their bonds, as far as the lists reach
  std::vector<double> added;     ///< strengths of the terms of added_term.hpp, in their order; 0: off
  friend bool operator==(const Terms&, const Terms&) = default;
};

struct TimeControl {
  std::optional<double> dt;     ///< fixed step [s]; otherwise from cfl
  double cfl = 0.8;             ///< dt = cfl h / (c + u)
  std::optional<double> until;  ///< stop at the first step with t >= until [s]
  std::optional<std::int64_t> steps;
  friend bool operator==(const TimeControl&, const TimeControl&) = default;
};

enum class CutRule { fixed, literal, quasi_newton, hybrid, chaos, replay };
enum class CostSource { time, counts };

struct Decomposition {
  std::array<int, 2> cut_axes{0, 1};  ///< row axis, column axis
  double skin = 0.2;                  ///< of the kernel's radius
  int rebuild_every = 0;              ///< 0: when a particle may leave the skin; n: also every n steps
  bool overlap = true;                ///< compute the interior while halo messages travel
  CutRule cuts = CutRule::quasi_newton;
  CostSource cost = CostSource::time;
  std::uint64_t chaos_seed = 1;
  int slow_rank = 0;    ///< for tests of the balance: this rank ...
  double slowness = 1;  ///< ... takes so many times as long
  std::string record;   ///< file to write the cuts of each rebuild to, or empty
  std::string replay;
  friend bool operator==(const Decomposition&, const Decomposition&) = default;
};

enum class MonitorKind { particle, group, energy, momentum, wall, contacts };

struct Monitor {
  std::string name;
  MonitorKind kind = MonitorKind::particle;
  std::optional<std::uint64_t> id;  ///< particle: this id ...
  std::optional<Double3>
      nearest_to;  ///< ... or the one nearest this point at the start, lowest id on ties [m]
  int group = -1;  ///< group: averages over it
  int wall = -1;   ///< wall: its place, velocity and the force of the grains on it
  friend bool operator==(const Monitor&, const Monitor&) = default;
};

struct OutputControl {
  double snapshot_interval = 0;           ///< [s] of scene time; 0: only the last state
  double series_interval = 0;             ///< [s] of scene time; 0: every step
  double checkpoint_interval = 600;       ///< [s] of wall time; 0: none but the last
  double status_interval = 2;             ///< [s] of wall time
  double average_time = 0;                ///< window of the running time averages in snapshots [s]; 0: none
  bool average_space = false;             ///< kernel averages over same-group neighbours in snapshots
  bool contacts = false;                  ///< grains: snapshots hold the contacts with their forces
  std::int64_t sort_limit = 100'000'000;  ///< rows up to which snapshots are sorted by id
  int checkpoint_files = 0;               ///< 0: one per 512 ranks
  std::vector<Monitor> monitors;
  friend bool operator==(const OutputControl&, const OutputControl&) = default;
};

struct Scene {
  std::string name;
  std::string file;  ///< where it was read from
  int dim = 2;
  Formulation formulation = Formulation::conservative;
  Precision precision = Precision::double_;
  KernelShape kernel = KernelShape::quintic;
  double spacing = 0;           ///< dx [m]
  double smoothing_length = 0;  ///< h [m]; quintic support 3h, Wendland 2h
  // Of the smoothing length of a particle of an ideal gas, over h.
  double least_growth = 1, largest_growth = 1;
  Double3 lower{}, upper{};  ///< domain [m]
  std::array<bool, 3> periodic{};
  Double3 gravity{};            ///< [m/s^2]
  double central_pull = 0;      ///< acceleration towards pull_centre over the distance from it [1/s^2]
  Double3 pull_centre{};        ///< [m]
  double surface_pressure = 0;  ///< added to the pressure of every equation of state [Pa]
  std::vector<Group> groups;
  ContactControl contact;  ///< grains only, as are walls and stages
  DragControl drag;        ///< of grains in a fluid
  std::vector<Wall> walls;
  std::vector<WallStage> stages;
  Start start;
  bool free_surface = false;  ///< there is one, as far as the start shows
  bool open = false;          ///< there is, and particles are shifted
  Terms terms;
  TimeControl time;
  Decomposition decomposition;
  OutputControl output;

  /// Fluids, and grains that act on them.
  [[nodiscard]] bool is_mixture() const { return has_grains() && has_matter(); }
  /// Of grains alone.
  [[nodiscard]] bool of_grains() const { return has_grains() && !has_matter(); }
  [[nodiscard]] bool has_grains() const { return has_kind(GroupKind::grain); }
  [[nodiscard]] bool has_matter() const;          ///< fluids or solids
  [[nodiscard]] double largest_diameter() const;  ///< of grains, 0 if there are none [m]
  [[nodiscard]] double kernel_radius() const;     ///< 0 if there is no matter [m]
  /// Range of interaction [m]: the kernel's radius or the largest diameter of the grains, whichever is more.
  [[nodiscard]] double support() const;
  [[nodiscard]] double list_range()
      const;  ///< how far pairs of the lists may be apart [m]: support(), or more
  [[nodiscard]] bool has_kind(GroupKind k) const;
  [[nodiscard]] bool total_lagrangian() const;                         ///< its solids are
  [[nodiscard]] int group_index(const std::string& group_name) const;  ///< -1 if there is none
  friend bool operator==(const Scene&, const Scene&) = default;
};

/// Reads and resolves a scene; `overrides` are "a.b=v" texts of --set, applied before anything is checked.
/// Throws InputError "file:line:column: key: what is wrong; what would be right" for the first problem found.
[[nodiscard]] Scene read_scene(const std::string& path, const std::vector<std::string>& overrides);
/// The same from text already in memory (`name` stands for the file in messages).
[[nodiscard]] Scene parse_scene(const std::string& text, const std::string& name,
                                const std::vector<std::string>& overrides);
/// The resolved scene as TOML: reading it back gives the same scene. Stored in every file.
[[nodiscard]] std::string to_toml(const Scene& scene);

}  // namespace sph

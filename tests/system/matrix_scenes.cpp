#include "matrix_scenes.hpp"

#include <algorithm>
#include <stdexcept>

#include "sph/laws/contact/law.hpp"
#include "sph/laws/eos/law.hpp"

namespace equivalence {
namespace {

struct Source {
  std::string_view name, file;
  std::vector<std::string> overrides;
};

std::vector<std::string> both(std::vector<std::string> some, const std::vector<std::string>& more) {
  some.insert(some.end(), more.begin(), more.end());
  return some;
}

/// The bubbly cylinder in a wider box, softer, thrown and disordered.
const std::vector<std::string> thrown{"domain.lower=[-12, -4]",
                                      "domain.upper=[60, 76]",
                                      "group.melt.bulk_modulus=",
                                      "group.melt.sound_speed=160",
                                      "group.cylinder.bulk_modulus=5e7",
                                      "group.spray.bulk_modulus=5e7",
                                      "time.dt=",
                                      "time.cfl=0.6",
                                      "start.jitter=0.1",
                                      "start.velocity=[2, 2]",
                                      "start.region.3.centre=[22, 32]",
                                      "group.cylinder.becomes.0.void_fraction_above=0.35"};
/// ... with heat.
const std::vector<std::string> warm = both(
    thrown, {"group.melt.temperature=1200", "group.cylinder.heat={specific_heat=1000, conductivity=1e6}",
             "group.spray.heat={specific_heat=1000, conductivity=1e6}", "group.cylinder.temperature=1500",
             "group.spray.temperature=1500", "group.wall.temperature=900"});

const std::vector<Source>& sources() {
  static const std::vector<Source> table{
      // XSPH moves particles once more, after the kick
      {"fluid2d",
       "apps/buoyant_cylinder/fluid.toml",
       {"group.melt.bulk_modulus=", "group.melt.sound_speed=160",
        "group.cylinder.bulk_modulus=", "group.cylinder.sound_speed=200", "group.cylinder.bulk_viscosity=300",
        "time.dt=", "time.cfl=0.7", "start.jitter=0.05", "start.velocity=[2, -0.5]",
        "terms.artificial_viscosity=0.02", "terms.xsph=0.3"}},
      {"solid2d",
       "apps/buoyant_cylinder/solid.toml",
       {"domain.lower=[-12, -4]", "domain.upper=[60, 76]",
        "group.melt.bulk_modulus=", "group.melt.sound_speed=160", "group.cylinder.bulk_modulus=5e7",
        "group.cylinder.lagrangian=updated", "time.dt=2e-3", "start.jitter=0.1", "start.velocity=[3, -1]"}},
      {"gas2d", "apps/buoyant_cylinder/gas.toml", thrown},
      {"ida2d",
       "apps/buoyant_cylinder/fluid.toml",
       {"formulation=ida", "group.melt.bulk_modulus=", "group.melt.sound_speed=160",
        "group.cylinder.bulk_modulus=", "group.cylinder.sound_speed=200", "time.dt=2e-3",
        "start.velocity=[2, -1]"}},
      // shifting, doubly periodic, not square, so that 16 cells fit with few particles; periods that are no
      // whole number of the units of rows in single precision
      {"flow2d",
       "benchmarks/accuracy/taylor_green.toml",
       {"domain.upper=[2.1, 0.7]", "start.flow_length=0.7", "time.until=", "time.steps=1"}},
      // tension between fluids of different density and viscosity
      {"bubble2d",
       "benchmarks/accuracy/rising_bubble.toml",
       {"start.velocity=[2, 0.3]", "time.until=", "time.steps=1"}},
      // tension as a jump of the pressure: two passes more, each with its halo refresh
      {"jump2d",
       "benchmarks/accuracy/rising_bubble.toml",
       {"start.velocity=[2, 0.3]", "time.until=", "time.steps=1", "terms.surface_tension.form=jump"}},
      // viscous forces of the end of the step: a solver with its own halo refreshes and reductions
      {"viscous2d",
       "benchmarks/accuracy/rising_bubble.toml",
       {"start.velocity=[2, 0.3]", "time.until=", "time.steps=1", "terms.implicit_viscosity=true",
        "group.liquid.viscosity=1000"}},
      {"viscous3d",
       "tests/scenes/box3d_fluid.toml",
       {"group.melt.viscosity=1e5", "terms.implicit_viscosity=true", "terms.viscosity=symmetric"}},
      // shifting beside a free surface, walls that slip
      {"fluid3d", "tests/scenes/box3d_fluid.toml", {"terms.shifting=true", "group.wall.slip=true"}},
      // thrown about in a closed tank: walls that hold torn fluid, shifting beside a free surface
      {"dam2d",
       "benchmarks/accuracy/dam_break.toml",
       {"domain.upper=[5.866, 2.6]", "start.spacing=0.05", "start.lower=[-0.2, -0.2]",
        "start.upper=[5.575, 2.2]", "start.velocity=[5, -3]", "start.region.1.upper=[5.375, 2]",
        "start.region.2.upper=[4, 1]", "terms.shifting=true", "time.until=", "time.steps=1"}},
      // smaller balls: those of the file fill the channel and push melt through its walls
      {"solid3d",
       "tests/scenes/box3d_solid.toml",
       {"start.velocity=[3, 0, 0]", "start.region.3.radius=1.3", "start.region.4.radius=1.3"}},
      {"gas3d", "tests/scenes/box3d_gas.toml", {"group.magma.becomes.0.void_fraction_above=0.09"}},
      // heat that melts and freezes, gas that flows and escapes: exchanges in double precision on lists of either
      {"exchange2d", "apps/buoyant_cylinder/gas.toml",
       both(warm, {"group.melt.heat={specific_heat=1200, conductivity=5e6, latent_heat=3e5, solidus=1100, "
                   "liquidus=1250}",
                   "group.wall.gas_pressure=2e4", "group.cylinder.permeability={coefficient=1e-9}",
                   "group.spray.permeability={coefficient=1e-8}"})},
      // the same by temperatures and pressures of the end of the step, far beyond the explicit limits
      {"implicit2d", "apps/buoyant_cylinder/gas.toml",
       both(warm, {"group.melt.heat={specific_heat=1200, conductivity=5e8, latent_heat=3e5, solidus=1100, "
                   "liquidus=1250}",
                   "group.wall.gas_pressure=2e4", "group.cylinder.permeability={coefficient=1e-8}",
                   "group.spray.permeability={coefficient=1e-7}", "terms.implicit_conduction=true",
                   "terms.implicit_gas_flow=true"})},
      // viscosities that follow the state, explicit beside walls, friction that heats, what is warm rises
      {"laws2d", "apps/buoyant_cylinder/gas.toml",
       both(warm, {"group.melt.heat={specific_heat=1200, conductivity=5e6, latent_heat=3e5, solidus=1100, "
                   "liquidus=1250, expansion=1e-3}",
                   "group.melt.viscosity_law={law=\"exponential\", fall=0.01, reference_temperature=1200, "
                   "crystals=\"einstein_roscoe\", most=2e4}",
                   "group.cylinder.viscosity=",
                   "group.cylinder.viscosity_law={law=\"hess_dingwell\", least=10, most=2e4}",
                   "group.spray.viscosity_law={law=\"constant\", bubbles=\"stretched\"}",
                   "terms.viscous_heat=true"})},
      // melt that freezes and rock that melts, magma that fragments and heals, after a while
      {"freezing2d", "tests/scenes/freezing2d.toml", {"time.steps=1"}},
      // boxes that renew what flows through them, a background, walls that cool and radiate, means that are state
      {"through2d", "tests/scenes/through2d.toml", {"time.steps=1"}},
      // ... where what is dissolved spreads, and takes heat and momentum along
      {"water2d",
       "tests/scenes/through2d.toml",
       {"time.steps=1", "group.magma.water_diffusivity=20", "group.spray.exsolution_time=0.1",
        "group.spray.water_diffusivity=5"}},
      {"laws3d",
       "tests/scenes/box3d_gas.toml",
       {"group.magma.becomes.0.void_fraction_above=0.09", "group.magma.viscosity=",
        "group.magma.viscosity_law={law=\"hess_dingwell\", temperature=1100, bubbles=\"round\", most=2e3}",
        "terms.implicit_viscosity=true", "terms.viscosity=symmetric"}},
      {"exchange3d",
       "tests/scenes/box3d_gas.toml",
       {"group.magma.becomes.0.void_fraction_above=0.09",
        "group.magma.permeability={law=\"percolation\", coefficient=1e-8, threshold=0.01}",
        "group.spray.permeability={law=\"kozeny_carman\", coefficient=1e-8}", "group.wall.gas_pressure=0"}},
      {"water3d",
       "tests/scenes/box3d_gas.toml",
       {"group.magma.becomes.0.void_fraction_above=0.09", "group.magma.exsolution_time=0.1",
        "group.magma.water_diffusivity=3", "group.spray.exsolution_time=0.05",
        "group.spray.water_diffusivity=1"}},
      {"implicit3d",
       "tests/scenes/box3d_gas.toml",
       {"group.magma.becomes.0.void_fraction_above=0.09",
        "group.magma.permeability={law=\"percolation\", coefficient=1e-7, threshold=0.01, "
        "closing_threshold=0.005}",
        "group.spray.permeability={law=\"kozeny_carman\", coefficient=1e-7, inertial_coefficient=1e-10, "
        "inertial_exponent=0}",
        "group.wall.gas_pressure=0", "terms.implicit_gas_flow=true"}},
      // ideal gases: energy is state, and the time step follows the hottest particle
      {"blast2d", "tests/scenes/blast2d.toml", {}},
      // kernels of all widths: lists go by the wider of a pair
      {"blast2d_wide",
       "tests/scenes/blast2d.toml",
       {"kernel.least_growth=0.3", "kernel.largest_growth=1.15", "domain.periodic=[true, true]",
        "domain.lower=[0, 0]", "domain.upper=[1.3, 0.3]", "start.region.0.group=air"}},
      // total-Lagrangian: clamped, in contact, through a periodic face
      {"bodies2d", "tests/scenes/bodies2d.toml", {}},
      {"bodies3d", "tests/scenes/bodies3d.toml", {}},
      // ... in a fluid
      {"wet2d", "tests/scenes/wet2d.toml", {}},
      {"wet3d",
       "tests/scenes/bodies3d.toml",
       {"group.light.kind=fluid",
        "group.light.lagrangian=", "group.light.poisson_ratio=", "group.light.viscosity=500",
        "start.region.1={group=\"light\", shape=\"box\", lower=[0, 3, 2], upper=[76, 11, 9]}",
        "start.region.2={group=\"bar\", shape=\"box\", lower=[0, 5, 2], upper=[76, 9, 5]}",
        "start.region.3={group=\"clamp\", shape=\"box\", lower=[38, 5, 2], upper=[40, 9, 5]}",
        "start.region.5={group=\"clamp\", shape=\"box\", lower=[0, 5, 2], upper=[2, 9, 5]}"}},
      // rigid bodies in a fluid: sums of forces, parts of two materials, contacts, through periodic faces
      {"rigid2d", "tests/scenes/rigid2d.toml", {}},
      {"rigid3d", "tests/scenes/rigid3d.toml", {}},
      // ... one of which moves as it is told
      {"led3d",
       "tests/scenes/rigid3d.toml",
       {"group.gate.held=", "group.gate.start_velocity=", "group.gate.start_spin=",
        "group.gate.motion={velocity=[[0, 2], [0.1, -3]], direction=[1, 0.2, 0], amplitude=[0, 0.2, 0.1], "
        "frequency=4, spin=[[0, 0.5], [0.2, -1]], axis=[1, 1, 3], centre=[38, 7, 5]}"}},
      // updated-Lagrangian solids that yield, alone and in melt
      {"slope2d", "tests/scenes/slope2d.toml", {}},
      {"rock3d",
       "tests/scenes/box3d_solid.toml",
       {"start.velocity=[3, 0, 0]", "start.region.3.radius=1.3",
        "start.region.4={group=\"rock\", shape=\"mesh\", scale=1.5, origin=[58, 4, 4], "
        "file=\"" PEPERITE_SOURCE_DIR "/tests/scenes/ring.obj\"}",
        "group.rock.strength={cohesion=500, friction_angle=25, dilatancy_angle=10, tensile_strength=400}"}},
      // ... that crack: what fails becomes fluid
      {"crack2d", "tests/scenes/crack2d.toml", {}},
      {"crack3d",
       "tests/scenes/bodies3d.toml",
       {"group.light.kind=fluid",
        "group.light.lagrangian=", "group.light.poisson_ratio=", "group.light.viscosity=500",
        "group.bar.becomes=[{group=\"light\", tensile_strength=5e4, keeps=\"volume\"}]",
        "start.region.1={group=\"light\", shape=\"box\", lower=[0, 3, 2], upper=[76, 11, 9]}",
        "start.region.2={group=\"bar\", shape=\"box\", lower=[0, 5, 2], upper=[76, 9, 5]}",
        "start.region.3={group=\"clamp\", shape=\"box\", lower=[38, 5, 2], upper=[40, 9, 5]}",
        "start.region.5={group=\"clamp\", shape=\"box\", lower=[0, 5, 2], upper=[2, 9, 5]}"}},
      // particles come and go: water, magma with gas and heat, under rock that fails
      {"open2d", "tests/scenes/open2d.toml", {}},
      {"open3d", "tests/scenes/open3d.toml", {}},
      {"open_wet2d", "tests/scenes/open_wet2d.toml", {}},
      // two sets of particles that act on each other, with contacts that remember
      {"mixture", "tests/scenes/grains_in_melt.toml", {}},
      {"linear", "tests/scenes/grains_pour.toml", {}},
      {"hertz",
       "tests/scenes/grains_pour.toml",
       {"contact.law=hertz", "group.sand.normal_stiffness=", "group.sand.young_modulus=1e6",
        "group.sand.poisson_ratio=0.3", "group.sand.rolling_friction=0.1"}},
      // a history that is the same from both sides of a contact
      {"latched",
       "tests/scenes/grains_pour.toml",
       {"contact.law=walton_braun", "contact.tangential_damping="}},
      {"smooth", "tests/scenes/grains_pour.toml", {"group.sand.friction=", "contact.tangential_damping="}},
      {"sizes", "tests/scenes/grains_sizes.toml", {}},
      {"glued", "tests/scenes/grains_glued.toml", {}},
      {"servo", "tests/scenes/grains_servo.toml", {}},
      // walls of triangles that turn, shake, come and go; contacts pass from facet to facet
      {"meshes", "tests/scenes/grains_mesh.toml", {}},
      // grains come and go, and their contacts with them
      {"silo",
       "tests/scenes/grains_silo.toml",
       {"outlet=[{lower=[17e-3, 3e-3, 0], upper=[20e-3, 8e-3, 1e-3]}, "
        "{lower=[14e-3, 3e-3, 0], upper=[17e-3, 8e-3, 1e-3], every=\"0.3 ms\"}]"}},
      // cells that no cut moves
      {"melts2d", "tests/scenes/melts2d.toml", {"time.dt=0.2"}},
      // grains that the flow on them carries for some steps: what is between two flows is state
      {"chamber", "tests/scenes/chamber.toml", {}},
      {"chamber_open",
       "tests/scenes/chamber.toml",
       {"domain.periodic=[true, true, false]", "group.crystal.friction=", "group.crystal.rolling_friction=",
        "drag.law=beetstra", "melt.diffusivity=0", "group.heavy.temperature=", "melt.expansion=",
        "melt.viscosity_fall=", "melt.side=[{side=\"z1\", slip=false}]",
        "start.grains=[{group=\"crystal\", lower=[0, 0, 2], "
        "upper=[32, 16, 14], spacing=1.3333333333333333, jitter=0.05}]"}},
  };
  return table;
}

}  // namespace

sph::Scene scene_of(const Row& row) {
  const Source& source = *std::find_if(sources().begin(), sources().end(),
                                       [&](const Source& s) { return s.name == row[Factor::scene]; });
  std::vector<std::string> overrides = source.overrides;
  if (row.family == Family::sph) overrides.push_back("precision=" + std::string(row[Factor::precision]));
  overrides.push_back("decomposition.overlap=" +
                      std::string(row[Factor::overlap] == "on" ? "true" : "false"));
  const std::string_view list = row[Factor::list];
  overrides.push_back(std::string("decomposition.skin=") + (list == "small"   ? "0.05"
                                                            : list == "large" ? "0.59"
                                                                              : "0.2"));
  overrides.push_back("decomposition.rebuild_every=" + std::string(list == "every" ? "1" : "0"));
  return sph::read_scene(std::string(PEPERITE_SOURCE_DIR) + "/" + std::string(source.file), overrides);
}

namespace {

/// Grains that a fluid pushes.
std::int64_t dragged_grains(const sph::Particles& particles) {
  const double* force = particles.data<sph::Field::fluid_force>();
  std::int64_t n = 0;
  for (std::size_t i = 0; force != nullptr && i < particles.owned(); ++i) n += force[i * 3 + 2] != 0 ? 1 : 0;
  return n;
}

}  // namespace

Liveliness liveliness(const sph::Simulation& simulation) {
  const sph::Particles& particles = simulation.particles();
  const sph::OpeningControl& openings = simulation.scene().domain.openings;
  const std::uint32_t* group = particles.data<sph::Field::group>();
  const double* psi = particles.data<sph::Field::void_fraction>();
  const double* strain = particles.data<sph::Field::strain_energy>();
  const double* plastic = particles.data<sph::Field::plastic_strain>();
  Liveliness out{simulation.rebuilds()};
  const std::vector<sph::Passage>& passages = simulation.global().throughput.passages;
  for (std::size_t k = 0; k < passages.size(); ++k)
    (openings.comes_in(k) ? out.come : out.gone) += passages[k].count;
  if (const sph::Grains* grains = simulation.grains()) {
    out.contacts = grains->pairs().lists().pairs().contacts();
    out.contacts_begun = grains->pairs().counters().created;
    out.contacts_ended = grains->pairs().counters().ended;
    out.histories_kept = grains->pairs().counters().carried;
    for (const sph::WallState& wall : simulation.global().walls) out.walls_moved |= wall.offset[2] != 0;
    if (simulation.scene().is_mixture()) out.dragged = dragged_grains(particles);
    return out;
  }
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    for (const sph::Group& g : simulation.scene().groups)
      for (const sph::Transition& row : g.becomes)
        if (row.group == static_cast<int>(group[i])) ++out.spray;
    if (plastic != nullptr) out.yielded += plastic[i] > 0 ? 1 : 0;
    if (psi != nullptr) out.void_fraction = std::max(out.void_fraction, psi[i]);
    if (strain == nullptr) continue;
    if (is_bonded(simulation.scene().groups[group[i]])) out.unstrained += strain[i] == 0 ? 1 : 0;
    if (is_rigid(simulation.scene().groups[group[i]])) out.touched += strain[i] > 0 ? 1 : 0;
  }
  return out;
}

void check_lively(const sph::Scene& scene, const Liveliness& start, const Liveliness& end) {
  const auto quiet = [&](const std::string& what) {
    throw std::runtime_error(scene.name + " is too quiet for a test: " + what);
  };
  if (scene.has_melt() && !scene.has_grains()) return;  // no cell ever goes anywhere
  if (end.rebuilds < start.rebuilds + 2) quiet("its lists were not rebuilt twice");
  constexpr std::int64_t some = 50;
  if (scene.is_mixture() && end.dragged < some) quiet("few grains are dragged");
  if (scene.has_grains()) {
    const bool rough = sph::contact_fusion(scene).history > 0;  // smooth grains count nothing
    if (!rough && end.contacts < some) quiet("few grains touch");
    if (rough && end.contacts_begun < some) quiet("few contacts began");
    if (rough && end.contacts_ended < some) quiet("few contacts ended");
    if (rough && end.histories_kept < some) quiet("few contacts outlived a rebuild");
    const bool servo = std::any_of(scene.grains.walls.begin(), scene.grains.walls.end(),
                                   [](const sph::Wall& wall) { return wall.force.has_value(); });
    if (servo && !end.walls_moved) quiet("no wall moved");
    if (!scene.domain.openings.insertions.empty() && (end.come < some || end.gone < some))
      quiet("few grains come and go");
    return;
  }
  constexpr std::int64_t few = 10;
  if (!scene.domain.openings.inlets.empty() && end.come < few) quiet("few particles came in");
  if (!scene.domain.openings.inlets.empty() && scene.terms.shifting && end.gone < few) quiet("few left");
  if (end.unstrained > 0) quiet("a body meets no other");
  if (sph::has_rigid_bodies(scene) && start.touched + end.touched == 0) quiet("rigid bodies touch nothing");
  if (sph::has_strength(scene.groups) && end.yielded < some) quiet("little rock has yielded");
  if (!has_eos(scene, sph::EosKind::bubbly)) return;
  if (end.void_fraction <= 0) quiet("no gas came out of solution");
  if (end.spray <= start.spray) quiet("no particle changed its group");
}

bool has_boundary(const sph::Simulation& simulation) {
  return simulation.sets().front().ranges[static_cast<std::size_t>(sph::RowClass::boundary_movers)].rows() >
         0;
}

void check_shared_out(const sph::Simulation& simulation, std::int64_t shared) {
  if (simulation.sets().front().owners) return;  // cells have halos of their own
  const auto fail = [&](const std::string& what) {
    throw std::runtime_error(simulation.scene().name + " is no test of many ranks: " + what);
  };
  const decomp::Int3& cells = simulation.distribution().grid().cells();
  const sph::Decomposition& d = simulation.scene().decomposition;
  if (std::max(cells[static_cast<std::size_t>(d.cut_axes[0])],
               cells[static_cast<std::size_t>(d.cut_axes[1])]) < 16)
    fail("neither cut axis has 16 cells");
  const decomp::Comm& comm = simulation.comm();
  if (comm.size() == 1) return;
  if (comm.sum(shared) == 0) fail("no rank needed a halo");
  // Random cuts may leave most ranks without particles at any one time; so may those that follow times of
  // microseconds while other jobs disturb them.
  const bool random = d.cuts == sph::CutRule::chaos || d.cuts == sph::CutRule::replay;
  const std::int64_t owners = comm.sum(std::int64_t{simulation.particles().owned() > 0});
  const bool measured = d.cuts != sph::CutRule::fixed && d.cost == sph::CostSource::time;
  if (!random && !measured && 2 * owners <= comm.size()) fail("most ranks are without particles");
  // Few are asked for by large lists between two restarts.
  const bool often = simulation.rebuilds() > 3;
  if (random && often && comm.sum(simulation.distribution().migrated()) == 0) fail("no particle migrated");
}

}  // namespace equivalence

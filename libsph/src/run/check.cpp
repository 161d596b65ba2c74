// peperite check: what a scene is and what running it costs, without running it.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <numeric>
#include <optional>

#include "models/damping_limit.hpp"
#include "models/stability.hpp"
#include "run/cost.hpp"
#include "run/memory_need.hpp"
#include "run/mesh_texts.hpp"
#include "run/plan_text.hpp"
#include "run/run_start.hpp"
#include "run/speed_warnings.hpp"
#include "sph/laws/drag/law.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/models/grain_limits.hpp"
#include "sph/models/suspension_need.hpp"
#include "sph/scene/grain_mass.hpp"
#include "sph/start/placement.hpp"
#include "sph/step/simulation.hpp"
#include "start/start_count.hpp"
#include "start/start_densities.hpp"
#include "start/start_overlaps.hpp"
#include "start/start_sounds.hpp"

namespace sph {
namespace {

constexpr std::int64_t particles_worth_a_rank = 2000;

std::string listed(FieldSet fields, int dim) {
  std::string out;
  for (Field f : fields.list())
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", info(f).name, width(f, dim));
  return out;
}

/// With particles on this machine if they are few: what only a start itself shows is then found too.
enum class Placed { no, rows, contacts };

Placed worth_placing(const Scene& scene, const StartCount& count, bool fits) {
  constexpr std::int64_t few = 2'000'000;
  if (!fits) return Placed::no;
  if (scene.has_grains() && may_overlap(scene) && count.all <= few) return Placed::contacts;
  const bool lattice = scene.start.file.empty();
  return lattice && (scene.has_grains() || count.all > few) ? Placed::no : Placed::rows;
}

/// What the particles say once they are there.
struct Beginning {
  StartCount count;
  double speed = 0;
  std::vector<double> sounds{};  ///< of fluids and solids

  /// Of another set of particles.
  void add(const Beginning& more) {
    if (count.by_group.empty()) {
      *this = more;
      return;
    }
    count.all += more.count.all;
    speed = std::max(speed, more.speed);
    if (sounds.empty()) sounds = more.sounds;
    for (std::size_t g = 0; g < count.by_group.size(); ++g) {
      if (more.count.by_group[g] == 0) continue;  // a group is of one set
      count.by_group[g] = more.count.by_group[g];
      count.heights[g] = more.count.heights[g];
    }
  }
};

Beginning start_of(const decomp::Comm& comm, const Scene& scene, const Particles& particles,
                   const PositionScale& scale) {
  Beginning out;
  out.count.by_group.assign(scene.groups.size(), 0);
  out.count.heights.resize(scene.groups.size());
  const auto d = static_cast<std::size_t>(scene.dim);
  const auto* group = particles.data<Field::group>();
  const auto* x = particles.data<Field::position>();
  const double* v = particles.data<Field::velocity>();
  std::array<double, 1> speed2{};
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    ++out.count.by_group[group[i]];
    Double3 at{};
    double v2 = 0;
    for (std::size_t a = 0; a < d; ++a) {
      at[a] = scale.metres(x[i * d + a]);
      v2 += v[i * d + a] * v[i * d + a];
    }
    out.count.heights[group[i]].add(scene, at);
    speed2[0] = std::max(speed2[0], v2);
  }
  comm.sum(std::span<std::int64_t>(out.count.by_group));
  Height::unite(comm, out.count.heights);
  comm.max(speed2);
  out.count.all = std::accumulate(out.count.by_group.begin(), out.count.by_group.end(), std::int64_t{0});
  out.speed = std::sqrt(speed2[0]);
  return out;
}

/// Finds what is wrong in the rows of a file or between grains.
Beginning place(const decomp::Comm& comm, const Scene& scene, Placed how) {
  if (how == Placed::contacts) {
    const Simulation simulation(comm, scene);
    return start_of(comm, scene, simulation.particles(), simulation.scale());
  }
  const PositionScale scale = position_scale(scene);
  const Parts parts(comm, scene, scale);
  Distribution distribution(comm, scene, scale);
  Beginning start;
  for (const Parts::Set& set : parts.sets) {
    Particles particles(scene.dim, set.fields);
    place_particles(scene, scale, distribution, particles);
    Beginning of_set = start_of(comm, scene, particles, scale);
    if (set.fields.has(Field::radius)) {
      check_start_speeds(comm, scene, particles);
    } else if (!set.owners) {
      check_start_densities(comm, scene, particles);
      of_set.sounds = fastest_sounds(comm, scene, particles);
    }
    start.add(of_set);
  }
  return start;
}

std::string particles_text(const Scene& scene, const StartCount& count) {
  std::string out = fmt::format("particles: {}\n", count.all);
  for (std::size_t g = 0; g < count.by_group.size(); ++g)
    out += fmt::format("  {}: {}\n", scene.groups[g].name, count.by_group[g]);
  return out;
}

std::string warnings(const std::vector<std::string>& lines) {
  std::string out;
  for (const std::string& line : lines) out += "warning: " + line + "\n";
  return out;
}

/// What this check has left to the run.
std::string unlooked_text(const Scene& scene, Placed placed) {
  std::string out;
  if (placed == Placed::no && !scene.start.file.empty())
    out += "warning: so many rows are not looked at here: a run does\n";
  if (placed != Placed::contacts && scene.has_grains() && may_overlap(scene))
    out += "warning: so many grains are not looked at for overlaps here: a run does\n";
  return out;
}

std::string memory_text(const Scene& scene, const Parts& parts, const MemoryNeed& need,
                        const MachineMemory& machine) {
  const int dim = scene.dim;
  std::string out;
  for (std::size_t set = 0; set < parts.sets.size(); ++set) {
    const FieldSet fields = parts.sets[set].fields, halo = halo_fields(parts.plan, set, fields);
    const std::string_view what = parts.sets[set].owners      ? "cell"
                                  : parts.sets.size() == 1    ? "particle"
                                  : fields.has(Field::radius) ? "grain"
                                                              : "fluid particle";
    out += fmt::format("bytes per {}: {} ({} state): {}\nbytes per halo {}: {}: {}\n", what,
                       bytes_of(fields, dim), bytes_of(state_of(fields), dim), listed(fields, dim), what,
                       bytes_of(halo, dim), listed(halo, dim));
  }
  if (parts.melt && parts.sets.size() == 1)
    out += fmt::format("memory: about {} for all cells, grids and iterations included\n",
                       bytes_text(need.bytes));
  else
    out +=
        fmt::format("memory: about {} for all particles, {} of about {:.3g} {} and {:.3g} cells included\n",
                    bytes_text(need.bytes), parts.physics ? "lists" : "contacts", need.listed,
                    parts.physics ? "neighbours" : "a grain", need.cells);
  if (need.meshes > 0)
    out += fmt::format("meshes: {} on each machine, whatever its ranks\n", bytes_text(need.meshes));
  if (need.regions > 0) out += fmt::format("mesh regions: {} on each rank\n", bytes_text(need.regions));
  if (const std::string problem = memory_problem(need, machine); !problem.empty())
    out += "warning: " + problem + ": it would not run here\n";
  return out;
}

std::string gas_text(const Scene& scene) {
  if (!has_eos(scene, EosKind::ideal_gas)) return {};
  if (scene.kernel.least_growth == 1 && scene.kernel.largest_growth == 1)
    return "gas: one smoothing length: particles that a blast parts by more than its kernel keep their heat, "
           "and\n"
           "  strong ones lose motion (kernel.least_growth and kernel.largest_growth let kernels follow the "
           "gas)\n";
  double thinner = 1;
  for (int a = 0; a < scene.dim; ++a) thinner /= scene.kernel.largest_growth;
  return fmt::format(
      "gas: kernels from {:.3g} to {:.3g} m wide as the gas is dense or thin; thinner than {:.2g} of its "
      "density\n"
      "  at the start it keeps its heat (kernel.largest_growth)\n",
      scene.kernel.least_growth * scene.kernel.smoothing_length,
      scene.kernel.largest_growth * scene.kernel.smoothing_length, thinner);
}

/// By the number of Ohnesorge of what a kernel sees: 0.37 and 1.3 in Hysing's bubbles, where the stress is
/// right, 0.005 where it is not (benchmarks/accuracy/drop_at_rest.py).
std::string tension_text(const Scene& scene) {
  constexpr double thick = 0.05;
  const InterfaceTension& tension = scene.terms.surface_tension;
  if (!(tension.coefficient > 0) || tension.form != TensionForm::stress) return {};
  double most = 0;
  for (const Group& g : scene.groups)
    if (g.kind == GroupKind::fluid)
      most = std::max(
          most, g.viscosity / std::sqrt(g.density * tension.coefficient * scene.kernel.smoothing_length));
  if (most >= thick) return {};
  return fmt::format(
      "warning: tension as a stress moves the interface of fluids as thin as these (viscosity /\n"
      "  sqrt(density tension h) = {:.2g}): set terms.surface_tension.form = \"jump\"\n",
      most);
}

std::string courant_text(const Scene& scene, const SphTimeStep& steps, const std::vector<double>& sounds,
                         double dt) {
  if (!scene.terms.exchange.motion)
    return std::isfinite(dt) ? fmt::format("time step: {:.6g} s, nothing moves\n", dt)
                             : "time step: from the gas that flows, and nothing moves\n";
  const double courant = steps.courant_number(dt, sounds);
  std::string out =
      fmt::format("time step: {:.6g} s at the start, c dt/h = {:.3g} (recommended {}, limit {})\n", dt,
                  courant, courant_recommended, courant_limit(scene));
  if (courant > courant_recommended * (1 + 1e-9))
    out += fmt::format("warning: c dt/h above {}: reduce {}\n", courant_recommended,
                       scene.time.dt ? "time.dt" : "time.cfl");
  const DampingLimit limit = damping_limit(scene, sounds, dt);
  if (const double share = dt / limit.step; share > courant_recommended / courant_limit(scene) * (1 + 1e-9))
    out += fmt::format("warning: the time step is {:.2g} of what {} = {:.4g} bears: reduce one of the two\n",
                       share, limit.key, limit.value);
  return out;
}

std::string contact_step_text(const Scene& scene, const MeshWalls& meshes, double dt) {
  const GrainTimeSteps steps = grain_time_steps(scene);
  if (!std::isfinite(steps.limit)) return {};  // no grain moves
  std::string out =
      fmt::format("time step: {:.6g} s (default {:.6g}, advised at most {:.6g}, limit {:.6g})\n", dt,
                  steps.recommended, steps.advised, steps.limit);
  if (dt > steps.advised) out += "warning: time.dt is above what dense packings bear: reduce it\n";
  for (std::size_t m = 0; m < meshes.count(); ++m) {
    const MeshWall& mesh = scene.grains.meshes[m];
    const double least = mesh.drive.mass > 0 ? least_mesh_mass(scene, mesh, meshes.surface(m)) : 0;
    if (mesh.drive.mass < least)
      out += fmt::format(
          "warning: mesh \"{}\" of {:.3g} kg is unstable with these steps where grains touch all of it: make "
          "it {:.3g} kg or more, or reduce time.dt\n",
          mesh.name, mesh.drive.mass, least);
  }
  return out;
}

std::string drag_text(const Scene& scene, const Parts& parts) {
  if (!parts.drag) return {};
  double largest = scene.largest_diameter(), least = largest;
  for (const Group& g : scene.groups)
    if (g.grain.least_radius > 0) least = std::min(least, 2 * g.grain.least_radius);
  const double h = scene.kernel.smoothing_length;
  std::string out = fmt::format(
      "drag: {}, h is {:.3g} to {:.3g} diameters; in a packed bed it allows time steps up to {:.3g} s, like "
      "the "
      "first of a run\n",
      scene.grains.drag.law->word, h / largest, h / least, parts.drag->bed_step());
  if (h < 1.5 * largest)
    out +=
        "warning: grains as large as the kernel are seen one by one: h of two diameters or more averages "
        "them\n";
  return out;
}

/// Of the weight of what all grains make when they lie on the floor; of one grain that touches another.
std::string suspension_text(const Scene& scene, const Parts& parts, const StartCount& count) {
  if (!parts.suspension) return {};
  const SuspensionNeed need = suspension_need(scene, count.by_group);
  std::string out = fmt::format(
      "grains in melts: {} drag, cells are {:.3g} to {:.3g} diameters wide; a grain alone moves with at most "
      "{:.3g} m/s;\n"
      "  a bed of all of them would press them {:.3g} radii into each other; a contact relaxes in {:.3g} s\n",
      scene.grains.drag.law->word, need.cells_per_grain[0], need.cells_per_grain[1], need.speed, need.overlap,
      need.relaxation);
  if (need.cells_per_grain[0] < 2)
    out += "warning: cells narrower than two diameters see grains one by one: make them wider\n";
  if (!(need.overlap <= 0.5 * scene.grains.contact.largest_overlap))
    out += fmt::format("warning: contacts are soft: contact.largest_overlap is {}; raise their stiffness\n",
                       scene.grains.contact.largest_overlap);
  return out;
}

std::string steps_text(const Scene& scene, double dt) {
  if (scene.is_suspension())
    return fmt::format(
        "steps: flows {}melt.courant cells apart; contacts in steps that their stiffness bears\n",
        scene.time.dt ? fmt::format("at most {:.6g} s or ", *scene.time.dt) : "");
  if (!std::isfinite(dt))
    return scene.has_melt() ? "time step: from the flow, melt.courant cells; time.dt would bound it\n" : "";
  double steps = scene.time.until ? std::ceil(*scene.time.until / dt) : HUGE_VAL;
  if (scene.time.steps) steps = std::min(steps, static_cast<double>(*scene.time.steps));
  return fmt::format("steps: about {:.4g}\n", steps);
}

/// What insertions bring until the end, of grains of the mean mass: memory above is that of the start.
std::string insertions_text(const Scene& scene, double dt) {
  double end = scene.time.until.value_or(HUGE_VAL);
  if (scene.time.steps) end = std::min(end, static_cast<double>(*scene.time.steps) * dt);
  std::string out;
  for (const Insertion& in : scene.domain.openings.insertions) {
    const Group& g = scene.groups[static_cast<std::size_t>(in.group)];
    const double a = g.grain.least_radius, b = g.grain.largest_radius;
    const double mean = grain_mass(g.density, 1) * (a + b) * (a * a + b * b) / 4;  // of r^3 between a and b
    const double mass = integral_of(in.rate, end);
    out += fmt::format("insertion: {} every {:.4g} s, {:.4g} kg or about {:.4g} grains in all\n", g.name,
                       in.every, mass, mass / mean);
  }
  return out;
}

std::string ranks_text(const Scene& scene, const decomp::CellGrid& grid, std::int64_t particles) {
  const auto [row, column] = scene.decomposition.cut_axes;
  const std::int64_t rows = grid.cells()[static_cast<std::size_t>(row)];
  const std::int64_t columns = grid.cells()[static_cast<std::size_t>(column)];
  const std::int64_t most = decomp::max_ranks(rows, columns);
  const std::int64_t sensible = std::clamp<std::int64_t>(particles / particles_worth_a_rank, 1, most);
  return fmt::format(
      "ranks: at most {} ({} x {} cells); recommended up to {} ({} particles a rank or more)\n", most, rows,
      columns, sensible, particles_worth_a_rank);
}

}  // namespace

int check_case(const RunOptions& options, const decomp::Comm& comm) {
  Scene scene = scene_of(options);
  scene.decomposition.record.clear();  // nothing is written
  return naming_file(scene, [&] {
    check_time_step(scene);
    const PositionScale scale = position_scale(scene);
    const Parts parts(comm, scene, scale);
    const decomp::CellGrid grid = cell_grid_of(scene, scale);
    Beginning start{count_start(comm, scene)};
    MemoryNeed need = memory_need(scene, parts, grid, start.count);
    const MachineMemory machine = machine_memory(comm);
    const Placed placed = worth_placing(scene, start.count, memory_problem(need, machine).empty());
    if (placed != Placed::no) {
      start = place(comm, scene, placed);
      need = memory_need(scene, parts, grid, start.count);
    }
    if (start.count.all == 0 && scene.domain.openings.insertions.empty())
      throw InputError("start: no particle lies in any region");
    double dt = parts.longest_step();
    if (parts.physics) {
      if (start.sounds.empty()) start.sounds = fastest_sounds(scene, start.count.heights);
      check_time_step(scene, parts.physics->steps(), start.sounds);
      dt = std::min(dt, parts.physics->steps().resting(start.sounds));
    }
    if (comm.rank() == 0)
      fmt::print("{}: {}\n{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}", scene.file, scene.name,
                 particles_text(scene, start.count), mesh_text(scene, parts), warnings(open_regions(scene)),
                 unlooked_text(scene, placed), memory_text(scene, parts, need, machine), gas_text(scene),
                 tension_text(scene), options.plan ? plan_text(scene, parts) : "",
                 parts.grains && !parts.suspension
                     ? contact_step_text(scene, parts.grains->walls().meshes(), dt)
                     : "",
                 parts.physics ? courant_text(scene, parts.physics->steps(), start.sounds, dt) : "",
                 drag_text(scene, parts), suspension_text(scene, parts, start.count),
                 speed_warnings(scene, start.count.heights, start.speed), steps_text(scene, dt),
                 insertions_text(scene, dt), ranks_text(scene, grid, start.count.all));
    return static_cast<int>(exit_done);
  });
}

}  // namespace sph

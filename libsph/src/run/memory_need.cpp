#include "run/memory_need.hpp"

#include <fmt/format.h>
#include <mpi.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <numbers>
#include <string>

#include "pairs/occupied.hpp"
#include "run/cost.hpp"
#include "scene/mesh_volume.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/laws/eos/law.hpp"
#include "sph/plan/distribution.hpp"

namespace sph {
namespace {

// Largest resident memory of runs, less the 28 MB of a program without particles, over their particles: 360
// bytes in 2D (fields 100, 23 neighbours), 690 in 3D (228, 86), 450 to 590 of grains (100, 3.4 contacts). Besides
// fields and lists that is: rows of the passes, tables for files, contacts that travel or are written.
constexpr double field_factor = 1.1;
constexpr double bytes_of_neighbour = 4;
constexpr double bytes_of_uneven_neighbour = 8;  ///< lists of a gas are there twice while they are made
constexpr double sum_factor = 1;
constexpr double contact_factor = 2;
constexpr double bytes_of_row = 140;  ///< of passes, bins, order, files
/// A settled bed lists about so many pairs a grain, once each.
constexpr double contacts_of_grain = 3.4;
/// Place along the curve, and two bits in each of five tables of what is occupied.
constexpr double bytes_of_cell = 5.3;
constexpr double bytes_of_occupied = 24;  ///< of a row instead, where cells are many more than rows

/// Points of a lattice within a radius of one of them, itself not counted.
double neighbours_within(const Scene& scene, double radius) {
  const double r = radius / scene.start.spacing;
  return (scene.dim == 2 ? std::numbers::pi * r * r : 4.0 / 3.0 * std::numbers::pi * r * r * r) - 1;
}

double limit_in(const char* file) {
  std::ifstream in(file);
  double bytes = 0;
  return in >> bytes ? bytes : HUGE_VAL;  // "max" is no number
}

}  // namespace

MemoryNeed memory_need(const Scene& scene, const Parts& parts, const decomp::CellGrid& grid,
                       const StartCount& count) {
  MemoryNeed need;
  need.particles = static_cast<double>(count.all);
  need.cells = 1;
  for (const std::int64_t n : grid.cells()) need.cells *= static_cast<double>(n);
  double grains =
      parts.physics || parts.melt ? 0 : need.particles;  // of a file they are not counted by group
  for (std::size_t g = 0; scene.has_grains_in_flow() && g < scene.groups.size(); ++g)
    if (scene.groups[g].kind == GroupKind::grain) grains += static_cast<double>(count.by_group[g]);
  // Kernels of a gas are mostly as wide as at the start, and lists go by each.
  const bool uneven = has_eos(scene, EosKind::ideal_gas);
  const double range = uneven ? scene.kernel_radius() : scene.list_range();
  const double neighbours =
      parts.physics ? neighbours_within(scene, range + scene.support() * scene.decomposition.skin) : 0;
  const bool dense = 4 * need.cells < 1e18 && Occupied::dense(static_cast<std::size_t>(4 * need.cells),
                                                              static_cast<std::size_t>(count.all));
  for (const Parts::Set& set : parts.sets) {
    double of_particle = field_factor * static_cast<double>(bytes_of(set.fields, scene.dim)) + bytes_of_row +
                         (dense ? 0 : bytes_of_occupied);
    const bool of_grains = set.fields.has(Field::radius);
    if (set.owners) {
      of_particle += parts.melt->bytes_of_cell();
    } else if (of_grains) {
      const ContactFusion fusion = contact_fusion(scene);
      of_particle += sum_factor * (fusion.spins ? 64 : 32) +
                     contact_factor * contacts_of_grain * (8 + 8 * fusion.history);
      if (parts.drag) of_particle += bytes_of_neighbour * neighbours;
    } else {
      of_particle += (uneven ? bytes_of_uneven_neighbour : bytes_of_neighbour) * neighbours;
      if (has_bonds(scene))
        of_particle += bytes_of_neighbour *
                       neighbours_within(
                           scene, scene.bond_width() / scene.kernel.smoothing_length * scene.kernel_radius());
    }
    need.bytes += (of_grains ? grains : need.particles - grains) * of_particle;
  }
  if (parts.grains) need.meshes = static_cast<double>(parts.grains->walls().meshes().bytes());
  for (const Region& region : scene.start.lattice.regions)
    if (region.mesh.volume != nullptr) need.regions += static_cast<double>(region.mesh.volume->bytes());
  need.listed = parts.physics ? neighbours : contacts_of_grain;
  need.bytes += dense ? need.cells * bytes_of_cell : 0;
  return need;
}

MachineMemory machine_memory(const decomp::Comm& comm) {
  MPI_Comm node = MPI_COMM_NULL;
  decomp::check_mpi(MPI_Comm_split_type(comm.get(), MPI_COMM_TYPE_SHARED, 0, MPI_INFO_NULL, &node),
                    "MPI_Comm_split_type");
  int ranks = 1;
  decomp::check_mpi(MPI_Comm_size(node, &ranks), "MPI_Comm_size");
  decomp::check_mpi(MPI_Comm_free(&node), "MPI_Comm_free");
  MachineMemory own;
  own.bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  for (const char* file : {"/sys/fs/cgroup/memory.max", "/sys/fs/cgroup/memory/memory.limit_in_bytes"})
    own.bytes = std::min(own.bytes, limit_in(file));
  own.rank_share = static_cast<double>(ranks) / comm.size();
  // The one that is filled first speaks for all.
  std::array<double, 1> fullest{own.rank_share / own.bytes};
  comm.max(fullest);
  std::array<double, 1> bytes{own.rank_share / own.bytes == fullest[0] ? own.bytes : 0.0};
  comm.max(bytes);
  const double share = fullest[0] * bytes[0];
  return {bytes[0], share, share * comm.size()};
}

std::string bytes_text(double bytes) {
  constexpr std::array units{"kB", "MB", "GB", "TB", "PB", "EB"};
  std::size_t unit = 0;
  for (bytes *= 1e-3; bytes >= 999.5 && unit + 1 < units.size(); bytes *= 1e-3) ++unit;
  return fmt::format("{:.3g} {}", bytes, units[unit]);
}

std::string memory_problem(const MemoryNeed& need, const MachineMemory& machine, double times) {
  const double facets = need.meshes + need.regions * machine.ranks;
  const double here = need.bytes * machine.rank_share + facets;
  if (here <= times * machine.bytes) return {};
  return fmt::format(
      "{:.4g} particles in {:.4g} cells need {}{}{}, and the machine has {}", need.particles, need.cells,
      bytes_text(need.bytes), facets > 0 ? ", meshes " + bytes_text(facets) + " on each machine" : "",
      machine.rank_share < 1 ? ", " + bytes_text(here) + " on each machine" : "", bytes_text(machine.bytes));
}

void require_memory(const decomp::Comm& comm, const Scene& scene) {
  const PositionScale scale = position_scale(scene);
  const MemoryNeed need =
      memory_need(scene, Parts(comm, scene, scale), cell_grid_of(scene, scale), count_start(comm, scene));
  constexpr double margin = 1.5;
  const std::string problem = memory_problem(need, machine_memory(comm), margin);
  if (!problem.empty())
    throw InputError("start: " + problem +
                     "; check the units of domain and start.spacing, or use more machines");
}

}  // namespace sph

// What a run will need of memory, from its particles and cells alone, and what the machine has: a length in
// the wrong unit makes 10^12 particles, and must end in a message instead of a killed process.
#pragma once

#include "decomp/comm.hpp"
#include "decomp/grid.hpp"
#include "sph/models/parts.hpp"
#include "sph/scene/scene.hpp"
#include "start/start_count.hpp"

namespace sph {

struct MemoryNeed {
  double particles = 0, cells = 0;  ///< numbers
  double listed = 0;                ///< neighbours, of grains alone contacts, a particle
  double bytes = 0;    ///< of all ranks together: fields and lists, what a rebuild and a file take besides
  double meshes = 0;   ///< bytes on each machine besides,
  double regions = 0;  ///< and of mesh regions on each rank
};
[[nodiscard]] MemoryNeed memory_need(const Scene& scene, const Parts& parts, const decomp::CellGrid& grid,
                                     const StartCount& count);

/// One machine of those that the ranks are on: the one with the largest share of ranks to memory.
struct MachineMemory {
  double bytes = 0;       ///< of the machine, or what its control group allows
  double rank_share = 1;  ///< ranks on it, of all
  double ranks = 1;       ///< their number
};
/// Collective.
[[nodiscard]] MachineMemory machine_memory(const decomp::Comm& comm);

/// "2.05 GB"
[[nodiscard]] std::string bytes_text(double bytes);

/// What is wrong where the share of the machine is more than so many times what it has; empty otherwise.
[[nodiscard]] std::string memory_problem(const MemoryNeed& need, const MachineMemory& machine,
                                         double times = 1);

/// Throws InputError if the scene does not fit, even where half as much again is asked for as is needed:
/// particles of walls have fewer neighbours. Collective.
void require_memory(const decomp::Comm& comm, const Scene& scene);

}  // namespace sph

// peperite check: what a scene is and what running it costs, without running it.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>

#include "physics/stability.hpp"
#include "run/cost.hpp"
#include "run/run_start.hpp"
#include "sph/grains.hpp"
#include "sph/placement.hpp"

namespace sph {
namespace {

constexpr std::int64_t particles_worth_a_rank = 2000;

std::string listed(FieldSet fields, int dim) {
  std::string out;
  for (Field f : fields.list())
    out += fmt::format("{}{} {}", out.empty() ? "" : ", ", info(f).name, width(f, dim));
  return out;
}

std::string names_of(FieldSet fields) {
  std::string out;
  for (Field f : fields.list()) out += (out.empty() ? "" : ", ") + std::string(info(f).name);
  return out.empty() ? "nothing" : out;
}

std::string terms_of(const Pass& pass) {
  std::string out;
  for (Term term : pass.fusion->terms) out += (out.empty() ? "" : " + ") + name_of(term);
  return out;
}

std::vector<std::int64_t> count_by_group(const decomp::Comm& comm, const Scene& scene,
                                         const Particles& particles) {
  std::vector<std::int64_t> count(scene.groups.size(), 0);
  const auto* group = particles.data<Field::group>();
  for (std::size_t row = 0; row < particles.owned(); ++row) ++count[group[row]];
  comm.sum(std::span<std::int64_t>(count));
  return count;
}

/// Points of a lattice within a radius of one of them, itself not counted.
double neighbours_within(const Scene& scene, double radius) {
  const double r = radius / scene.spacing;
  return (scene.dim == 2 ? std::numbers::pi * r * r : 4.0 / 3.0 * std::numbers::pi * r * r * r) - 1;
}

std::string particles_text(const Scene& scene, const std::vector<std::int64_t>& count, std::int64_t all) {
  std::string out = fmt::format("particles: {}\n", all);
  for (std::size_t g = 0; g < count.size(); ++g)
    out += fmt::format("  {}: {}\n", scene.groups[g].name, count[g]);
  return out;
}

std::string memory_text(const Scene& scene, const Physics& physics, std::int64_t particles) {
  const int dim = scene.dim;
  if (scene.of_grains()) {
    // A settled bed lists about 3.4 pairs a grain, once each; a row has 32 or 64 bytes of sums and a
    // reference.
    const ContactFusion fusion = contact_fusion(scene);
    const int sums = fusion.spins ? 64 : 32;
    const double pairs = 3.4 * (8 + 8 * fusion.history);
    return fmt::format(
        "bytes per particle: {} ({} state): {}; sums {}, contacts about {:.0f}\nbytes per halo particle: {}: "
        "{}\n"
        "memory: about {:.3g} MB for all particles, contacts included\n",
        bytes_of(physics.fields(), dim), bytes_of(state_of(physics.fields()), dim),
        listed(physics.fields(), dim), sums, pairs, bytes_of(halo_fields(physics), dim),
        listed(halo_fields(physics), dim),
        (static_cast<double>(bytes_of(physics.fields(), dim) + static_cast<std::size_t>(sums) + 24) + pairs) *
            static_cast<double>(particles) * 1e-6);
  }
  const double list =
      neighbours_within(scene, scene.list_range() + scene.support() * scene.decomposition.skin);
  const double all = static_cast<double>(bytes_of(physics.fields(), dim)) + 4 * list;
  constexpr double megabyte = 1e6;
  return fmt::format(
      "bytes per particle: {} ({} state): {}\nbytes per halo particle: {}: {}\n"
      "memory: about {:.3g} MB for all particles, lists of about {:.0f} neighbours included\n",
      bytes_of(physics.fields(), dim), bytes_of(state_of(physics.fields()), dim),
      listed(physics.fields(), dim), bytes_of(halo_fields(physics), dim), listed(halo_fields(physics), dim),
      all * static_cast<double>(particles) / megabyte, list);
}

std::string passes_text(const Scene& scene, const Physics& physics) {
  std::string out;
  const std::vector<FieldSet> sent = refreshes_of(physics);
  for (std::size_t k = 0; k < sent.size(); ++k) {
    const Pass& pass = physics.passes()[k];
    out +=
        fmt::format("pass {}: {}\n  reads {}\n  sends before it {} ({} bytes)\n", pass.name, terms_of(pass),
                    names_of(pass.reads & physics.fields()), names_of(sent[k]), bytes_of(sent[k], scene.dim));
  }
  return out;
}

std::string courant_text(const Scene& scene, double dt, double courant) {
  std::string out =
      fmt::format("time step: {:.6g} s at the start, c dt/h = {:.3g} (recommended {}, limit {})\n", dt,
                  courant, courant_recommended, courant_limit(scene));
  if (courant > courant_recommended * (1 + 1e-9))
    out += fmt::format("warning: c dt/h above {}: reduce {}\n", courant_recommended,
                       scene.time.dt ? "time.dt" : "time.cfl");
  return out;
}

std::string contact_step_text(const Scene& scene, double dt) {
  const GrainTimeSteps steps = grain_time_steps(scene);
  std::string out =
      fmt::format("time step: {:.6g} s (default {:.6g}, advised at most {:.6g}, limit {:.6g})\n", dt,
                  steps.recommended, steps.advised, steps.limit);
  if (dt > steps.advised) out += "warning: time.dt is above what dense packings bear: reduce it\n";
  return out;
}

std::string steps_text(const Scene& scene, double dt) {
  double steps = scene.time.until ? std::ceil(*scene.time.until / dt) : HUGE_VAL;
  if (scene.time.steps) steps = std::min(steps, static_cast<double>(*scene.time.steps));
  return fmt::format("steps: about {:.4g}\n", steps);
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
  const Scene scene = scene_of(options);
  return naming_file(scene, [&] {
    check_time_step(scene);
    const PositionScale scale = position_scale(scene);
    const Physics physics(scene, scale);
    Distribution distribution(comm, scene, scale);
    Particles particles(scene.dim, physics.fields());
    place_particles(scene, scale, distribution, particles);
    const std::vector<std::int64_t> count = count_by_group(comm, scene, particles);
    std::int64_t all = 0;
    for (std::int64_t n : count) all += n;
    if (all == 0) throw InputError("start: no particle lies in any region");
    const bool grains = scene.of_grains();
    const double dt = grains ? Grains(scene, scale).time_step() : physics.time_step({});
    if (comm.rank() == 0)
      fmt::print("{}: {}\n{}{}{}{}{}{}", scene.file, scene.name, particles_text(scene, count, all),
                 memory_text(scene, physics, all), passes_text(scene, physics),
                 grains ? contact_step_text(scene, dt) : courant_text(scene, dt, physics.courant_number(dt)),
                 steps_text(scene, dt), ranks_text(scene, distribution.grid(), all));
    return static_cast<int>(exit_done);
  });
}

}  // namespace sph

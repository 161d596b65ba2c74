// perf.json: the numbers of the final table for programs, with what the run was built from.
#include <nlohmann/json.hpp>

#include "files/durable_file.hpp"
#include "sph/core/error.hpp"
#include "sph/files/provenance.hpp"
#include "sph/run/report.hpp"

namespace sph {
namespace {

using Json = nlohmann::ordered_json;

Json build_json() {
  const BuildInfo& b = build_info();
  return {{"version", b.version},       {"git", b.git}, {"compiler", b.compiler}, {"flags", b.flags},
          {"build_type", b.build_type}, {"mpi", b.mpi}, {"hdf5", b.hdf5}};
}

Json regions_json(const std::vector<decomp::Timers::Row>& regions) {
  Json out = Json::object();
  for (const decomp::Timers::Row& row : regions)
    out[std::string(decomp::name_of(row.region))] = {{"min", row.min},
                                                     {"mean", row.mean},
                                                     {"max", row.max},
                                                     {"calls", row.calls},
                                                     {"computation", decomp::is_computation(row.region)}};
  return out;
}

}  // namespace

void write_perf_json(const std::filesystem::path& path, const Performance& p) {
  const double particle_steps = static_cast<double>(p.loop.particles) * static_cast<double>(p.loop.steps);
  const Json json{
      {"scene", p.label.scene},
      {"fingerprint", p.label.fingerprint},
      {"precision", p.label.precision},
      {"formulation", p.label.formulation},
      {"ranks", p.loop.ranks},
      {"steps", p.loop.steps},
      {"particles", p.loop.particles},
      {"end", {{"step", p.loop.end.step}, {"time", p.loop.end.time}, {"dt", p.loop.end.dt}}},
      {"setup_seconds", p.loop.setup_seconds},
      {"wall_seconds", p.loop.wall_seconds},
      {"particle_steps_per_second", p.loop.wall_seconds > 0 ? particle_steps / p.loop.wall_seconds : 0},
      {"imbalance", p.loop.imbalance},
      {"cost_seconds", p.loop.cost_seconds},
      {"neighbours_per_particle", p.neighbours.listed},
      {"pairs_per_particle", p.neighbours.within_support},
      {"halo_per_particle", p.neighbours.halo_copies},
      {"refresh_bytes", p.bytes.refresh},
      {"halo_bytes_per_step", p.bytes.halo_per_step},
      {"state_bytes_per_particle", p.bytes.state_per_particle},
      {"bytes_per_particle", p.bytes.per_particle},
      {"bytes_per_halo_particle", p.bytes.per_halo_particle},
      {"rebuilds", p.events.rebuilds},
      {"migrated", p.events.migrated},
      {"refreshes", p.events.refreshes},
      {"solver_iterations", p.events.iterations},
      {"peak_rank_bytes", p.bytes.peak_rank},
      {"cells",
       {{"origin", p.layout.origin},
        {"edge", p.layout.edge},
        {"number", p.layout.cells},
        {"periodic", p.layout.periodic},
        {"cut_axes", p.layout.cut_axes},
        {"cuts", p.layout.cuts}}},
      {"balance",
       {{"calls", p.balance.calls},
        {"moves", p.balance.moves},
        {"seconds", p.balance.seconds},
        {"migrating", p.balance.migrating},
        {"over_optimum", p.balance.over_optimum},
        {"cells_taken_as_one", p.balance.edge}}},
      {"seconds", regions_json(p.regions)},
      {"build", build_json()}};
  try {
    write_atomically(path, json.dump(2) + "\n");
  } catch (const std::exception& error) {
    throw OutputError("cannot write " + path.string() + ": " + error.what());
  }
}

}  // namespace sph

#include "saved_state.hpp"

#include "sph/checkpoint/checkpoint.hpp"
#include "sph/output/snapshot.hpp"

namespace equivalence {
namespace {

sph::Provenance provenance_of(const sph::Simulation& simulation) {
  sph::Provenance provenance{sph::to_toml(simulation.scene()), simulation.fingerprint(), {}};
  for (const sph::Group& g : simulation.scene().groups) provenance.group_names.push_back(g.name);
  return provenance;
}

}  // namespace

void write_state(const std::filesystem::path& path, const sph::Simulation& s) {
  sph::write_snapshot(s.comm(), path, s.particles(), s.global(), s.scale(), s.wrap(), provenance_of(s), {},
                      s.particle_count());
}

void write_restart(const std::filesystem::path& dir, const sph::Simulation& s, int files) {
  const sph::RunRecord record{s.global(), s.scale(), sph::to_toml(s.scene()), ""};
  const decomp::Payload contacts = s.contacts();
  sph::write_checkpoint(s.comm(), dir, s.particles(), s.has_history() ? &contacts : nullptr, record, s.wrap(),
                        provenance_of(s), files);
}

}  // namespace equivalence

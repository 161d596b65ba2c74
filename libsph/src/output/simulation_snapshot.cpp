#include "output/extra_columns.hpp"
#include "sph/output/snapshot.hpp"
#include "sph/step/simulation.hpp"

namespace sph {

Provenance provenance(const State& state, std::string fingerprint) {
  std::vector<std::string> names;
  for (const Group& group : state.scene().groups) names.push_back(group.name);
  return {to_toml(state.scene()), std::move(fingerprint), std::move(names)};
}

void write_snapshot(Simulation& s, const std::filesystem::path& path) {
  // In this order, since each needs memory: the fingerprint frees its own before the columns are there.
  const Provenance from = provenance(s, s.fingerprint());
  std::vector<ExtraColumn> extra = extra_columns(s);
  std::optional<ContactColumns> contacts;
  if (s.scene().output.contacts) contacts = contact_columns(s);
  write_snapshot(s.comm(), path, s.particles(), s.global(), s.scale(), s.wrap(), from, std::move(extra),
                 s.scene().output.sort_limit, std::move(contacts), cell_mesh(s),
                 s.scene().output.compression);
}

}  // namespace sph

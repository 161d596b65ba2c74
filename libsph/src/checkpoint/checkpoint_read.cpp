#include "checkpoint/checkpoint_files.hpp"
#include "files/agree.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;

/// Rank 0 reads, all know: what is not a manifest is not one on every rank.
Manifest shared_manifest(const decomp::Comm& comm, const fs::path& dir) {
  std::string text;
  const std::string failure = agree(comm, attempt([&] {
                                      if (comm.rank() == 0) text = read_manifest_text(dir);
                                    }));
  if (!failure.empty()) throw InputError(failure);
  return manifest_from_text(comm.broadcast(text, 0));
}

/// What is wrong with a checkpoint, empty if nothing; the same on all ranks.
std::string damage_of(const decomp::Comm& comm, const fs::path& dir, Manifest& manifest) {
  const std::string unreadable = attempt([&] { manifest = shared_manifest(comm, dir); });
  if (!unreadable.empty()) return unreadable;
  return agree(comm, attempt([&] { verify(dir, manifest, comm.rank(), comm.size()); }));
}

std::vector<fs::path> shared_directories(const decomp::Comm& comm, const fs::path& root) {
  std::string names;
  if (comm.rank() == 0)
    for (const fs::path& dir : checkpoint_directories(root)) names += dir.filename().string() + "/";
  names = comm.broadcast(names, 0);
  std::vector<fs::path> out;
  for (std::size_t begin = 0; begin < names.size();) {
    const std::size_t end = names.find('/', begin);
    out.push_back(root / names.substr(begin, end - begin));
    begin = end + 1;
  }
  return out;
}

void check_fits(const CheckpointHandle& handle, const Manifest& m, const Particles& particles,
                const decomp::Payload* history) {
  const auto differs = [&](const std::string& what) {
    throw InputError(handle.dir.string() + " does not fit the scene: " + what);
  };
  if (m.dim != particles.dim())
    differs("it has " + std::to_string(m.dim) + " dimensions, the scene " + std::to_string(particles.dim()));
  FieldSet stored;
  for (Field f : m.fields) stored |= FieldSet{f};
  const FieldSet wanted = state_of(particles.fields());
  for (Field f : state_of(stored).without(wanted).list()) differs("it has " + std::string(info(f).name));
  for (Field f : wanted.without(stored).list()) differs("it lacks " + std::string(info(f).name));
  if (m.history != (history != nullptr))
    differs(m.history ? "it has contact histories" : "it lacks contact histories");
}

}  // namespace

CheckpointHandle find_checkpoint(const decomp::Comm& comm, const fs::path& run_dir) {
  const fs::path root = checkpoint_root(run_dir);
  std::string problems;
  for (const fs::path& dir : shared_directories(comm, root)) {
    Manifest manifest;
    const std::string damage = damage_of(comm, dir, manifest);
    if (damage.empty()) {
      if (!problems.empty())
        problems +=
            "going on from " + dir.string() + " (step " + std::to_string(manifest.record.global.step) + ")";
      return {dir, manifest.record, problems};
    }
    problems += dir.string() + ": " + damage + "; ";
  }
  if (problems.empty()) throw InputError("there is no checkpoint in " + root.string());
  problems.resize(problems.size() - 2);
  throw InputError("no checkpoint can be used: " + problems);
}

FieldSet read_checkpoint(const decomp::Comm& comm, const CheckpointHandle& handle, Particles& particles,
                         decomp::Payload* history) {
  const Manifest manifest = shared_manifest(comm, handle.dir);
  check_fits(handle, manifest, particles, history);
  const auto rank = static_cast<std::uint64_t>(comm.rank());
  const auto size = static_cast<std::uint64_t>(comm.size());
  const std::uint64_t first = manifest.rows() * rank / size;
  const std::uint64_t rows = manifest.rows() * (rank + 1) / size - first;
  FieldSet shown;
  const std::string failure =
      agree(comm, attempt([&] {
              particles.table().resize(rows, 0);
              for (std::size_t set = 0; set < manifest.fields.size(); ++set) {
                if (!particles.has(manifest.fields[set])) continue;
                if (!info(manifest.fields[set]).state) shown |= FieldSet{manifest.fields[set]};
                decomp::Column& column = particles.table().column(particles.column(manifest.fields[set]));
                read_rows(handle.dir, manifest, set, column.width(), first, rows, column.data());
              }
              if (history != nullptr) *history = read_history(handle.dir, manifest, first, rows);
            }));
  if (!failure.empty()) throw InputError("cannot read " + handle.dir.string() + ": " + failure);
  return shown;
}

}  // namespace sph

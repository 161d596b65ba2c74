#include "run/run_files.hpp"

#include <fmt/format.h>

#include <bit>
#include <nlohmann/json.hpp>

#include "files/agree.hpp"
#include "files/durable_file.hpp"
#include "output/extra_columns.hpp"
#include "run/run_directory.hpp"
#include "sph/checkpoint/checkpoint.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// Throws InputError on all ranks if `work`, which is rank 0's, fails.
template <class Work>
void on_root_or_refuse(const decomp::Comm& comm, const std::string& what, Work&& work) {
  const std::string failure = agree(comm, attempt([&] {
                                      if (comm.rank() == 0) work();
                                    }));
  if (!failure.empty()) throw InputError(what + failure);
}

template <class Work>
void on_root(const decomp::Comm& comm, const std::string& what, Work&& work) {
  all_or_none(comm, what, [&] {
    if (comm.rank() == 0) work();
  });
}

}  // namespace

std::string to_json(const RunMemory& memory) {
  Json snapshots = Json::array();
  for (const SnapshotEntry& s : memory.snapshots)
    snapshots.push_back({{"file", s.file},
                         {"step", s.step},
                         {"time_bits", std::bit_cast<std::uint64_t>(s.time)},
                         {"rows", s.rows}});
  Json json{
      {"monitor_ids", memory.monitor_ids}, {"series_bytes", memory.series_bytes}, {"snapshots", snapshots}};
  if (memory.series_hash) json["series_hash"] = *memory.series_hash;
  return json.dump();
}

RunMemory memory_from_json(const std::string& text) {
  try {
    const Json json = Json::parse(text);
    RunMemory memory;
    memory.monitor_ids = json.at("monitor_ids").get<std::vector<std::uint64_t>>();
    memory.series_bytes = json.at("series_bytes").get<std::uint64_t>();
    if (json.contains("series_hash")) memory.series_hash = json["series_hash"].get<std::uint64_t>();
    for (const Json& s : json.at("snapshots"))
      memory.snapshots.push_back({s.at("file").get<std::string>(), s.at("step").get<std::int64_t>(),
                                  std::bit_cast<double>(s.at("time_bits").get<std::uint64_t>()),
                                  s.at("rows").get<std::int64_t>()});
    return memory;
  } catch (const Json::exception& error) {
    throw InputError(std::string("the checkpoint was not written by a run: ") + error.what());
  }
}

bool is_complete(const Simulation& s, const fs::path& dir) {
  const std::int64_t step = s.global().step;
  // Written in this order at the end: snapshot, its place in the index, perf.json.
  const std::string missing = agree(
      s.comm(), attempt([&] {
        if (s.comm().rank() != 0) return;
        const Json perf = Json::parse(read_text(dir / "perf.json"));
        const std::string index = read_text(dir / "particles.xdmf");
        if (perf.at("end").at("step") != step || !fs::exists(dir / "scene.toml") ||
            !fs::exists(dir / snapshot_name(step)) || index.find(snapshot_name(step)) == std::string::npos)
          throw OutputError("not of the last step");
      }));
  return missing.empty();
}

RunFiles::RunFiles(const Simulation& s, fs::path dir, const std::string& old_scene,
                   const std::vector<std::optional<std::uint64_t>>& followed)
    : dir_(std::move(dir)), monitors_(s, followed) {
  on_root_or_refuse(s.comm(),
                    "cannot write in " + dir_.string() + ", choose another place with --out: ", [&] {
                      remove_leftovers(dir_);
                      remove_snapshots(dir_, 0, {}, {old_scene, to_toml(s.scene())});
                      write_scene(s);
                      fs::remove(dir_ / "particles.xdmf");
                      series_.emplace(dir_ / "series.csv", monitors_.names(), monitors_.units());
                      look_at_series();
                    });
}

RunFiles::RunFiles(const Simulation& s, fs::path dir, const std::string& old_scene, const RunMemory& memory,
                   std::int64_t first_snapshot)
    : dir_(std::move(dir)),
      monitors_(s, {memory.monitor_ids.begin(), memory.monitor_ids.end()}),
      series_bytes_(memory.series_bytes),
      snapshots_(memory.snapshots) {
  const std::vector<ExtraColumn> extra = extra_columns(s.scene());
  const std::optional<CellMesh> mesh = cell_mesh(s);
  on_root_or_refuse(s.comm(), "", [&] {
    std::vector<std::string> listed;
    for (const SnapshotEntry& entry : snapshots_) listed.push_back(entry.file);
    remove_leftovers(dir_);
    remove_snapshots(dir_, first_snapshot, listed, {old_scene, to_toml(s.scene())});
    write_scene(s);
    series_.emplace(dir_ / "series.csv", memory.series_bytes, memory.series_hash);
    look_at_series();
    if (snapshots_.empty())
      fs::remove(dir_ / "particles.xdmf");
    else
      write_xdmf(dir_ / "particles.xdmf", snapshots_, s.particles(), extra, mesh);
  });
}

void RunFiles::look_at_series() {
  series_bytes_ = series_->bytes();
  series_hash_ = series_->hash();
}

void RunFiles::write_scene(const Simulation& s) const {
  write_atomically(dir_ / "scene.toml", to_toml(s.scene()));
}

void RunFiles::add_series_row(Simulation& s) {
  const std::vector<double> values = monitors_.values(s);
  if (s.comm().rank() != 0 || failed()) return;
  failure_ = attempt([&] { series_->add(s.global().step, s.global().time, values); });
  look_at_series();
}

void RunFiles::check(const Simulation& s) const {
  const std::string failure = agree(s.comm(), failure_);
  if (!failure.empty()) throw OutputError(failure);
}

void RunFiles::add_snapshot(Simulation& s, bool scheduled) {
  const GlobalState& g = s.global();
  const SnapshotEntry entry{snapshot_name(g.step), g.step, g.time, s.particle_count()};
  on_root(s.comm(), "cannot write " + (dir_ / entry.file).string(), [&] {
    if (fs::exists(dir_ / entry.file)) throw OutputError("somebody else has put a file there");
  });
  write_snapshot(s, dir_ / entry.file);
  std::vector<SnapshotEntry> listed = snapshots_;
  listed.push_back(entry);
  if (scheduled) snapshots_ = listed;
  const std::optional<CellMesh> mesh = cell_mesh(s);
  on_root(s.comm(), "particles.xdmf", [&] {
    write_xdmf(dir_ / "particles.xdmf", listed, s.particles(), extra_columns(s.scene()), mesh);
  });
}

void RunFiles::write_checkpoint(const Simulation& s) {
  check(s);
  on_root(s.comm(), "series.csv", [&] { sync_to_disk(dir_ / "series.csv"); });
  const RunRecord record{s.global(), s.scale(), to_toml(s.scene()),
                         to_json({monitors_.ids(), series_bytes_, series_hash_, snapshots_})};
  const Provenance from = provenance(s, s.fingerprint());  // before the contacts: it packs them too
  const decomp::Payload contacts = s.contacts();
  sph::write_checkpoint(s.comm(), dir_, s.particles(), s.has_history() ? &contacts : nullptr, record,
                        s.wrap(), from, s.scene().output.checkpoint_files);
}

fs::path RunFiles::keep_crashed_state(const Simulation& s, bool together) const {
  const fs::path crash = dir_ / "crash";
  const fs::path file =
      crash / (together ? fmt::format("snapshot_{:09}.h5", s.global().step)
                        : fmt::format("snapshot_{:09}_rank_{}.h5", s.global().step, s.comm().rank()));
  std::error_code ignored;
  fs::create_directories(crash, ignored);
  // The fingerprint of a state that broke a rule means nothing, and computing it may need ranks that are
  // gone.
  const Provenance from = provenance(s, "");
  const decomp::Comm alone(MPI_COMM_SELF);
  write_snapshot(together ? s.comm() : alone, file, s.particles(), s.global(), s.scale(), s.wrap(), from, {},
                 s.scene().output.sort_limit);
  return file;
}

}  // namespace sph

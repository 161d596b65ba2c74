#include "run/run_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>

#include "checkpoint/checkpoint_files.hpp"
#include "files/agree.hpp"
#include "files/durable_file.hpp"
#include "models/stability.hpp"
#include "run/changes.hpp"
#include "run/memory_need.hpp"
#include "run/mesh_texts.hpp"
#include "run/run_directory.hpp"
#include "scene/record.hpp"
#include "sph/checkpoint/checkpoint.hpp"
#include "sph/laws/contact/law.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;

template <class Make>
std::unique_ptr<Simulation> simulate(const Scene& scene, Make&& make) {
  return naming_file(scene, [&] {
    check_time_step(scene);
    return make();
  });
}

std::unique_ptr<Simulation> begun(const decomp::Comm& comm, const Scene& scene) {
  require_memory(comm, scene);
  if (comm.rank() == 0)
    for (const std::string& line : open_regions(scene)) fmt::print(stderr, "peperite: warning: {}\n", line);
  return std::make_unique<Simulation>(comm, scene);
}

/// Makes the directory of a new run this run's.
void claim(RunStart& start, const decomp::Comm& comm, const std::string& option = "--out") {
  const std::string failure = agree(comm, attempt([&] {
                                      if (comm.rank() == 0) fs::create_directories(start.dir);
                                    }));
  const std::string what =
      "cannot write in " + start.dir.string() + ", choose another place with " + option + ": ";
  if (!failure.empty()) throw InputError(what + failure);
  start.lock = std::make_unique<RunLock>(comm, start.dir);
  if (start.lock->inherited()) {  // of a run that was killed before it had written anything else
    const std::string left = agree(comm, attempt([&] {
                                     if (comm.rank() == 0) remove_leftovers(start.dir);
                                   }));
    if (!left.empty()) throw InputError(what + left);
  }
  refuse_used_directory(comm, start.dir, true, option);  // again: another run may have come and gone since
}

/// Doubles that a contact carries.
int history_of(const Scene& scene) {
  return scene.has_grains() ? static_cast<int>(contact_fusion(scene).history) : 0;
}

bool has_checkpoint(const fs::path& dir) {
  const std::vector<fs::path> found = checkpoint_directories(checkpoint_root(dir));
  return std::any_of(found.begin(), found.end(),
                     [](const fs::path& checkpoint) { return fs::exists(manifest_path(checkpoint)); });
}

}  // namespace

Scene scene_of(const RunOptions& options) {
  return read_scene(options.scene, options.overrides, options.end);
}

bool is_finished(const Scene& scene, const GlobalState& global) {
  return (scene.time.steps && global.step >= *scene.time.steps) ||
         (scene.time.until && global.time >= *scene.time.until);
}

RunStart start_new(const RunOptions& options, const decomp::Comm& comm) {
  const Scene scene = scene_of(options);
  RunStart start;
  start.dir = options.out.empty() ? fs::path("out") / fs::path(options.scene).stem() : options.out;
  refuse_used_directory(comm, start.dir, false);
  prepare_record(comm, scene, start.dir, false);
  start.simulation = simulate(scene, [&] { return begun(comm, scene); });
  claim(start, comm);
  return start;
}

/// By each monitor of a particle in the scene: what the same monitor of the run before follows.
std::vector<std::optional<std::uint64_t>> followed_before(const Scene& scene, const Scene& before,
                                                          const std::vector<std::uint64_t>& ids) {
  std::vector<std::optional<std::uint64_t>> out;
  for (const Monitor& m : scene.output.monitors) {
    if (m.kind != MonitorKind::particle) continue;
    out.emplace_back();
    std::size_t k = 0;
    for (const Monitor& old : before.output.monitors) {
      if (old.kind != MonitorKind::particle) continue;
      if (old == m && k < ids.size()) out.back() = ids[k];
      ++k;
    }
  }
  return out;
}

RunStart start_branch(const RunOptions& options, const decomp::Comm& comm) {
  constexpr double at_first = 1e-6;
  refuse_changes_of_parts(options.overrides);
  RunStart start;
  start.dir = options.branch;
  refuse_used_directory(comm, start.dir, false, "--branch");
  CheckpointHandle checkpoint = find_checkpoint(comm, options.resume);
  if (!checkpoint.warning.empty() && comm.rank() == 0)
    fmt::print(stderr, "peperite: warning: {}\n", checkpoint.warning);
  const std::string file = (options.resume / "scene.toml").string();
  const Scene scene = parse_scene(checkpoint.record.scene_toml, file, options.overrides, options.end);
  const Scene before = parse_record(checkpoint.record.scene_toml, file);
  start.followed = followed_before(scene, before, memory_from_json(checkpoint.record.extra_json).monitor_ids);
  if (history_of(before) != history_of(scene))
    throw InputError(
        "--set: contacts would have other histories, with rolling friction or without: a branch keeps them");
  // How large a step may be is known at the end of one.
  checkpoint.other_laws = change_laws(options.overrides);
  if (double& dt = checkpoint.record.global.dt; checkpoint.other_laws)
    dt = scene.time.dt && !scene.has_melt() ? *scene.time.dt : at_first * dt;
  prepare_record(comm, scene, start.dir, false);
  try {
    start.simulation = simulate(scene, [&] { return std::make_unique<Simulation>(comm, scene, checkpoint); });
  } catch (const InputError& error) {
    const std::string what = error.what();
    if (what.find("does not fit the scene") == std::string::npos) throw;
    throw InputError(what + "; leave out the --set that adds or removes it");
  }
  claim(start, comm, "--branch");
  return start;
}

/// It is the one that the run had so far.
bool keeps_record(const RunOptions& options) {
  return std::ranges::none_of(options.overrides, [](const std::string& given) {
    return given.starts_with("decomposition.record") || given.starts_with("decomposition=");
  });
}

RunStart start_again(const RunOptions& options, const decomp::Comm& comm) {
  refuse_other_changes(options.overrides);
  RunStart start;
  start.dir = options.resume;
  const std::string file = (start.dir / "scene.toml").string();
  std::string text;
  const std::string failure =
      agree(comm, attempt([&] {
              if (comm.rank() != 0) return;
              if (!fs::is_directory(start.dir))
                throw InputError(start.dir.string() + " is not the directory of a run");
              if (has_checkpoint(start.dir)) return;
              if (!fs::exists(file))
                throw InputError("there is no run in " + start.dir.string() +
                                 ": neither checkpoint nor scene.toml");
              if (fs::exists(start.dir / "perf.json"))
                throw InputError(
                    fmt::format("{0} has the results of a run, but its checkpoint is gone: from the "
                                "beginning they would be overwritten; "
                                "begin another run with peperite run {0}/scene.toml --out DIR",
                                start.dir.string()));
            }));
  if (!failure.empty()) throw InputError(failure);
  start.lock = std::make_unique<RunLock>(comm, start.dir);
  const std::string unread = agree(comm, attempt([&] {
                                     if (comm.rank() == 0 && !has_checkpoint(start.dir))
                                       text = read_text(file);
                                   }));
  if (!unread.empty()) throw InputError(unread);
  text = comm.broadcast(text, 0);
  if (!text.empty()) {
    if (comm.rank() == 0)
      fmt::print(stderr, "peperite: {} has no checkpoint yet: beginning anew\n", start.dir.string());
    const Scene scene = parse_scene(text, file, options.overrides, options.end);
    prepare_record(comm, scene, start.dir, keeps_record(options));
    start.old_scene = text;
    start.simulation = simulate(scene, [&] { return begun(comm, scene); });
    return start;
  }
  const CheckpointHandle checkpoint = find_checkpoint(comm, start.dir);
  if (!checkpoint.warning.empty() && comm.rank() == 0)
    fmt::print(stderr, "peperite: warning: {}\n", checkpoint.warning);
  const Scene scene = parse_scene(checkpoint.record.scene_toml, file, options.overrides, options.end);
  prepare_record(comm, scene, start.dir, keeps_record(options));
  start.old_scene = checkpoint.record.scene_toml;
  start.memory = memory_from_json(checkpoint.record.extra_json);
  start.simulation = simulate(scene, [&] { return std::make_unique<Simulation>(comm, scene, checkpoint); });
  return start;
}

}  // namespace sph

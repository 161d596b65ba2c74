#include "run/run_directory.hpp"

#include <fcntl.h>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <sstream>

#include "decomp/cut_policy.hpp"
#include "files/agree.hpp"
#include "files/descriptor.hpp"
#include "files/durable_file.hpp"
#include "files/hdf5_file.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view temporary = ".tmp";
/// What MPI-IO, with which older versions wrote, leaves beside a file when it is killed.
constexpr std::string_view lock_test = ".tmp.locktest.";

std::string names_of_a_run() {
  return "scene.toml, series.csv, particles.xdmf, perf.json, checkpoint, crash, snapshot_*.h5";
}

/// A name that a run gives to its own, or may be taken to have given.
bool is_own_name(const std::string& name) {
  constexpr std::array names{"scene.toml", "series.csv", "particles.xdmf",
                             "perf.json",  "checkpoint", "crash"};
  return std::find(names.begin(), names.end(), name) != names.end() ||
         (name.starts_with("snapshot_") && name.ends_with(".h5"));
}

bool is_leftover(const std::string& name) {
  if (name.starts_with("run.lock.")) return name.ends_with(temporary);
  const std::size_t test = name.find(lock_test);
  const std::string whole = test == std::string::npos ? name : name.substr(0, test + temporary.size());
  if (!whole.ends_with(temporary)) return false;
  const std::string owner = whole.substr(0, whole.size() - temporary.size());
  return owner.ends_with(".h5") ? step_of_snapshot(owner).has_value() : is_own_name(owner);
}

/// The scene without the lines that say where the run ends, which each start may set anew.
std::string without_end(const std::string& scene) {
  std::istringstream lines(scene);
  std::string out;
  bool in_time = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.starts_with("[")) in_time = line == "[time]";
    if (!in_time || !(line.starts_with("steps = ") || line.starts_with("until = "))) out += line + "\n";
  }
  return out;
}

bool is_of_scene(const fs::path& file, const std::vector<std::string>& scenes) {
  try {
    const std::string scene = without_end(Hdf5Reader(file).text("scene"));
    return std::any_of(scenes.begin(), scenes.end(),
                       [&](const std::string& own) { return without_end(own) == scene; });
  } catch (const std::exception&) {
    return false;
  }
}

/// Only lines of cuts, of which the last may have been cut off.
bool is_record(const fs::path& file) {
  std::istringstream lines(read_text(file));
  bool good = true;
  for (std::string line; good && std::getline(lines, line);)
    good = attempt([&] { (void)decomp::cuts_from_text(line); }).empty() || lines.eof();
  return good;
}

/// What the run itself makes in its directory, or looks for, or removes.
bool is_of_the_run(const fs::path& file, const fs::path& dir) {
  const fs::path within = fs::weakly_canonical(file).lexically_relative(fs::weakly_canonical(dir));
  const std::string name = within.begin() == within.end() ? std::string() : within.begin()->string();
  return is_own_name(name) || is_leftover(name) || name.starts_with("run.lock") || name == "stop" ||
         name == ".";
}
bool is_of_any_run(const fs::path& file, const fs::path& dir) {
  const fs::path whole = fs::weakly_canonical(file), folder = whole.parent_path();
  const auto of_run_in = [&](const fs::path& other) {
    return fs::exists(other / "scene.toml") && is_of_the_run(whole, other);
  };
  return is_of_the_run(whole, dir) || of_run_in(folder) || of_run_in(folder.parent_path());
}

/// A run that goes on adds to its own, after the last whole line.
void claim_record(const fs::path& record, const fs::path& dir, bool own) {
  if (is_of_any_run(record, dir))
    throw InputError(record.string() + " has the name of a file of a run; give it another");
  std::error_code none;
  if (fs::exists(record, none)) {
    const bool usable =
        fs::is_regular_file(record) && (fs::file_size(record) == 0 || (own && is_record(record)));
    if (!usable)
      throw InputError(record.string() +
                       " exists and is not of this run; name another file, or move it away");
  }
  Descriptor(record, O_WRONLY | O_CREAT).close();
  fs::resize_file(record, read_text(record).rfind('\n') + 1);
}

}  // namespace

std::string snapshot_name(std::int64_t step) { return fmt::format("snapshot_{:09}.h5", step); }

std::optional<std::int64_t> step_of_snapshot(const fs::path& file) {
  const std::string name = file.filename().string();
  const std::size_t digits = name.find_first_of("0123456789");
  if (digits == std::string::npos) return std::nullopt;
  std::int64_t step = 0;
  const auto end = std::from_chars(name.data() + digits, name.data() + name.size(), step);
  if (end.ec != std::errc() || name != snapshot_name(step)) return std::nullopt;
  return step;
}

void refuse_used_directory(const decomp::Comm& comm, const fs::path& dir, bool locked,
                           const std::string& option) {
  const std::string failure = agree(
      comm, attempt([&] {
        if (comm.rank() != 0) return;
        const std::string advice = "; choose another with " + option;
        std::error_code none;
        if (!fs::exists(dir, none)) return;
        if (!fs::is_directory(dir)) throw InputError(dir.string() + " is not a directory" + advice);
        // Beside a lock, leftovers are its owner's; whether that is gone is found out when it is taken.
        const bool of_owner = !locked && fs::exists(dir / "run.lock");
        for (const fs::directory_entry& entry : fs::directory_iterator(dir)) {
          const std::string name = entry.path().filename().string();
          if (!is_own_name(name) && (of_owner || !is_leftover(name))) continue;
          if (name.starts_with("run.lock.")) continue;  // of somebody who is just trying to take it
          const bool is_run = fs::exists(dir / "scene.toml") || fs::exists(dir / "checkpoint");
          throw InputError(is_run
                               ? fmt::format("{} holds a run already{}, or go on with it: peperite resume {}",
                                             dir.string(), advice, dir.string())
                               : fmt::format("{} holds {}, which the run might overwrite (it writes {}){}",
                                             dir.string(), name, names_of_a_run(), advice));
        }
      }));
  if (!failure.empty()) throw InputError(failure);
}

void remove_leftovers(const fs::path& dir) {
  std::error_code none;
  for (const fs::path& folder : {dir, dir / "crash"})
    for (const fs::directory_entry& entry : fs::directory_iterator(folder, none))
      if (is_leftover(entry.path().filename().string())) fs::remove(entry.path());
}

void remove_snapshots(const fs::path& dir, std::int64_t first, const std::vector<std::string>& listed,
                      const std::vector<std::string>& scenes) {
  std::vector<fs::path> own;
  for (const fs::directory_entry& entry : fs::directory_iterator(dir)) {
    const std::optional<std::int64_t> step = step_of_snapshot(entry.path());
    const std::string name = entry.path().filename().string();
    if (!step || *step < first || std::find(listed.begin(), listed.end(), name) != listed.end()) continue;
    if (!is_of_scene(entry.path(), scenes))
      throw InputError(entry.path().string() +
                       " is not of this run, which would overwrite it: move it out of the directory");
    own.push_back(entry.path());
  }
  for (const fs::path& path : own) fs::remove(path);
}

void prepare_record(const decomp::Comm& comm, const Scene& scene, const fs::path& dir, bool own) {
  const fs::path record = scene.decomposition.record;
  if (record.empty()) return;
  const std::string failure = agree(comm, attempt([&] {
                                      if (comm.rank() == 0) claim_record(record, dir, own);
                                    }));
  if (!failure.empty()) throw InputError(scene.file + ": decomposition.record: " + failure);
}

}  // namespace sph

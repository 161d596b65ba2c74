#include "inspect/state_file.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "checkpoint/checkpoint_files.hpp"
#include "files/agree.hpp"
#include "files/hdf5_file.hpp"
#include "files/tensor_order.hpp"
#include "inspect/trial.hpp"
#include "sph/core/error.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;

BuildInfo build_of(std::string version, std::string git, std::string compiler, std::string flags) {
  BuildInfo b;
  b.version = std::move(version);
  b.git = std::move(git);
  b.compiler = std::move(compiler);
  b.flags = std::move(flags);
  return b;
}

class CheckpointFile : public StateFile {
 public:
  CheckpointFile(const fs::path& dir, const Manifest& m)
      : StateFile({"checkpoint", dir, m.dim, m.rows(), m.record.global, m.record.scale, contents_of(m),
                   m.provenance.fingerprint, m.record.scene_toml,
                   build_of(m.version, m.git, m.compiler, m.flags)}),
        manifest_(m) {}

  [[nodiscard]] std::vector<std::byte> column(Field field) const override {
    const auto set = static_cast<std::size_t>(
        std::find(manifest_.fields.begin(), manifest_.fields.end(), field) - manifest_.fields.begin());
    const std::size_t row_bytes = width(field, manifest_.dim);
    std::vector<std::byte> out(manifest_.rows() * row_bytes);
    read_rows(summary().path, manifest_, set, row_bytes, 0, manifest_.rows(), out.data());
    return out;
  }
  [[nodiscard]] std::optional<decomp::Payload> history() const override {
    if (!manifest_.history) return std::nullopt;
    return read_history(summary().path, manifest_, 0, manifest_.rows());
  }

 private:
  static StateContents contents_of(const Manifest& m) {
    StateContents out{.fields = {}, .other_fields = {}, .history = m.history};
    for (const Field f : m.fields)
      if (info(f).state)
        out.fields.push_back(f);
      else
        out.other_fields.emplace_back(info(f).name);
    return out;
  }

  Manifest manifest_;
};

/// The data set that holds a field's exact bits.
std::string set_of(Field field) {
  return "particles/" + (field == Field::position ? "position_quanta" : std::string(info(field).name));
}

class SnapshotFile : public StateFile {
 public:
  explicit SnapshotFile(const fs::path& path) : SnapshotFile(path, std::make_unique<Hdf5Reader>(path)) {}

  [[nodiscard]] std::vector<std::byte> column(Field field) const override {
    std::vector<std::byte> out(summary().rows * width(field, summary().dim));
    if (file_->rows(set_of(field)) != summary().rows ||
        file_->components(set_of(field)) != components(info(field).shape, summary().dim))
      throw InputError(summary().path.string() + ": " + set_of(field) + " does not have the size it should");
    if (!out.empty()) file_->read(set_of(field), element_of(info(field).type), out.data());
    if (info(field).shape == Shape::symmetric)
      to_state_order(*file_, set_of(field), summary().dim, reinterpret_cast<double*>(out.data()),
                     summary().rows);
    return out;
  }

 private:
  SnapshotFile(const fs::path& path, std::unique_ptr<Hdf5Reader> file)
      : StateFile(summary_of(path, *file)), file_(std::move(file)) {}

  static StateSummary summary_of(const fs::path& path, const Hdf5Reader& file) {
    StateSummary s;
    s.kind = "snapshot";
    s.path = path;
    s.dim = static_cast<int>(file.integer("dim"));
    if (s.dim != 2 && s.dim != 3)
      throw InputError(
          fmt::format("{}: says that it has {} dimensions; it is damaged", path.string(), s.dim));
    s.rows = file.rows("particles/id");
    if (file.integer("particles") != static_cast<std::int64_t>(s.rows))
      throw InputError(fmt::format("{}: says that it has {} particles, but has {} ids; it is damaged",
                                   path.string(), file.integer("particles"), s.rows));
    s.global = {file.integer("step"),
                file.real("time"),
                file.real("dt"),
                file.real("max_speed"),
                file.real("max_acceleration"),
                {},
                {},
                {},
                {},
                {}};
    s.scale.quantum = file.real("quantum");
    for (const FieldInfo& i : field_table) {
      if (!file.has(set_of(i.field))) continue;
      // The stress of a grain is derived from its contacts.
      if (i.state && !(i.field == Field::stress && file.has(set_of(Field::radius))))
        s.contents.fields.push_back(i.field);
      else
        s.contents.other_fields.emplace_back(i.name);
    }
    if (file.has("particles/coordination")) s.contents.other_fields.emplace_back("coordination");
    if (file.has("contacts/id")) s.contents.contacts = file.rows("contacts/id");
    s.fingerprint = file.text("fingerprint");
    s.scene_toml = file.text("scene");
    s.program = build_of(file.text("version"), file.text("git"), file.text("compiler"), file.text("flags"));
    return s;
  }

  std::unique_ptr<Hdf5Reader> file_;
};

/// Throws if HDF5 cannot be trusted with the file: all that readers of a snapshot touch, a row of each data
/// set included, is tried first.
void try_snapshot(const fs::path& path) {
  const std::string fate = fate_in_a_copy([&] {
    const SnapshotFile snapshot(path);
    const Hdf5Reader file(path);
    const StateSummary& s = snapshot.summary();
    std::vector<std::byte> row;
    for (Field field : s.contents.fields) {
      const std::string set = set_of(field);
      row.resize(width(field, s.dim));
      if (s.rows == file.rows(set) && s.rows > 0 &&
          file.components(set) == components(info(field).shape, s.dim))
        file.read_rows(set, element_of(info(field).type), s.rows - 1, 1, row.data());
    }
  });
  if (!fate.empty()) throw InputError("the file is damaged, " + fate);
}

std::unique_ptr<StateFile> open_checkpoint(const fs::path& dir) {
  try {
    const Manifest manifest = manifest_from_text(read_manifest_text(dir));
    verify(dir, manifest, 0, 1);
    return std::make_unique<CheckpointFile>(dir, manifest);
  } catch (const std::exception& error) {
    throw InputError(dir.string() + ": " + error.what());
  }
}

std::unique_ptr<StateFile> open_newest(const fs::path& run_dir) {
  std::string problems;
  for (const fs::path& dir : checkpoint_directories(checkpoint_root(run_dir))) {
    try {
      return open_checkpoint(dir);
    } catch (const InputError& error) {
      problems += std::string("; ") + error.what();
    }
  }
  throw InputError(run_dir.string() + ": neither a checkpoint nor a run with one" + problems);
}

}  // namespace

std::unique_ptr<StateFile> open_state(const fs::path& path) {
  if (!fs::exists(path)) throw InputError(path.string() + ": no such file or directory");
  if (fs::is_directory(path))
    return fs::exists(manifest_path(path)) ? open_checkpoint(path) : open_newest(path);
  if (!fs::is_regular_file(path))
    throw InputError(path.string() + ": not a snapshot: not a file with contents");
  try {
    try_snapshot(path);
    return std::make_unique<SnapshotFile>(path);
  } catch (const std::exception& error) {
    throw InputError(path.string() + ": not a snapshot: " + error.what());
  }
}

}  // namespace sph

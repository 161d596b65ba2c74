// A state on disk, snapshot or checkpoint, opened by one process to be compared or described.
#pragma once

#include <cstddef>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "decomp/table.hpp"
#include "sph/core/particles.hpp"
#include "sph/files/provenance.hpp"

namespace sph {

/// What of the particles a file holds.
struct StateContents {
  std::vector<Field> fields;  ///< state, in the order of the field table
  std::vector<std::string> other_fields;
  bool history = false;                                  ///< contact histories
  std::optional<std::uint64_t> contacts = std::nullopt;  ///< rows of a snapshot's contacts, if it has them
};

struct StateSummary {
  std::string kind;  ///< "snapshot" or "checkpoint"
  std::filesystem::path path;
  int dim = 0;
  std::uint64_t rows = 0;
  GlobalState global;
  PositionScale scale;
  StateContents contents;
  std::string fingerprint, scene_toml;
  BuildInfo program;  ///< that wrote it: version, git, compiler and flags
};

class StateFile {
 public:
  explicit StateFile(StateSummary summary) : summary_(std::move(summary)) {}
  virtual ~StateFile() = default;
  StateFile(const StateFile&) = delete;
  StateFile& operator=(const StateFile&) = delete;
  [[nodiscard]] const StateSummary& summary() const { return summary_; }
  /// All rows of a field that summary().contents.fields names.
  [[nodiscard]] virtual std::vector<std::byte> column(Field field) const = 0;
  [[nodiscard]] virtual std::optional<decomp::Payload> history() const { return std::nullopt; }

 private:
  StateSummary summary_;
};

/// Opens a snapshot file, a checkpoint's directory or a run's directory (its newest usable checkpoint).
/// Checkpoints are verified. Throws InputError saying what is wrong with `path`.
[[nodiscard]] std::unique_ptr<StateFile> open_state(const std::filesystem::path& path);

}  // namespace sph

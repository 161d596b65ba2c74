// Checkpoints on disk as readers see them: which there are, whether every byte is as written, and their
// rows. HDF5 has no part in it: the manifest says where the rows lie, and a library that follows pointers in
// a damaged file had better not be let loose on one.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "checkpoint/checkpoint_manifest.hpp"

namespace sph {

/// <run_dir>/checkpoint
[[nodiscard]] std::filesystem::path checkpoint_root(const std::filesystem::path& run_dir);

/// The directories of checkpoints under a root, newest first, complete or not. A step that was written again
/// has a directory "<step>.<n>" beside the first.
[[nodiscard]] std::vector<std::filesystem::path> checkpoint_directories(const std::filesystem::path& root);
/// The directory for a checkpoint of this step that takes no complete one's place: new, empty, on disk.
[[nodiscard]] std::filesystem::path make_checkpoint_directory(const std::filesystem::path& root,
                                                              std::int64_t step);
/// Deletes the files of a checkpoint, whole or not, and its directory if nothing else is in there.
void remove_checkpoint(const std::filesystem::path& dir);
/// Deletes all checkpoints but `newest` and the newest complete one of an earlier step. Those of later steps
/// belong to a future that the run did not take.
void remove_superseded(const std::filesystem::path& newest);

[[nodiscard]] std::filesystem::path manifest_path(const std::filesystem::path& dir);
[[nodiscard]] std::string read_manifest_text(const std::filesystem::path& dir);  ///< throws if there is none

/// Hash of the bytes of a part that lie outside its extents: the structure of the HDF5 file.
[[nodiscard]] std::uint64_t frame_hash(const std::filesystem::path& file, std::uint64_t bytes,
                                       std::vector<Extent> extents);

/// Throws saying what is wrong with the `share`-th of `shares` equal parts of the checkpoint's bytes.
void verify(const std::filesystem::path& dir, const Manifest& manifest, int share, int shares);

/// Reads rows [first, first + rows), counted through the parts, of the set-th data set into `to`.
void read_rows(const std::filesystem::path& dir, const Manifest& manifest, std::size_t set,
               std::size_t row_bytes, std::uint64_t first, std::uint64_t rows, std::byte* to);
[[nodiscard]] decomp::Payload read_history(const std::filesystem::path& dir, const Manifest& manifest,
                                           std::uint64_t first, std::uint64_t rows);

}  // namespace sph

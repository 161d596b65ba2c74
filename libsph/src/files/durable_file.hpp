// POSIX file operations that the standard library lacks: what must be on disk before a rename counts, and
// errors as text with the system's reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>
#include <string>

namespace sph {

class Descriptor;

/// A run of bytes of a file.
struct Extent {
  std::uint64_t offset, bytes;
};

/// Waits until the contents of a file, or the entries of a directory, are on disk.
void sync_to_disk(const std::filesystem::path& path);

/// A new file for writing only; one that has this name is removed.
[[nodiscard]] Descriptor create_anew(const std::filesystem::path& path);

/// Replaces `path` by `text`: readers see the old or the new file, never a part, even after a power cut.
void write_atomically(const std::filesystem::path& path, const std::string& text);

/// Renames and waits until the directory says so on disk.
void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to);

/// Reads to.size() bytes from `offset`; throws if the file ends before.
void read_bytes(const std::filesystem::path& path, std::uint64_t offset, std::span<std::byte> to);
[[nodiscard]] std::string read_text(const std::filesystem::path& path);

}  // namespace sph

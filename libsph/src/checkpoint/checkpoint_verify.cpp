#include <algorithm>
#include <stdexcept>

#include "checkpoint/checkpoint_files.hpp"
#include "files/content_hash.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;

std::vector<std::byte> bytes_at(const fs::path& file, const Extent& extent) {
  std::vector<std::byte> bytes(extent.bytes);
  read_bytes(file, extent.offset, bytes);
  return bytes;
}

void check_hash(std::span<const std::byte> bytes, std::uint64_t expected, const std::string& what) {
  if (content_hash(bytes) != expected) throw std::runtime_error(what + " is damaged: its hash differs");
}

std::vector<std::uint64_t> block_table(const fs::path& file, const Manifest& manifest, const Part& part) {
  std::vector<std::uint64_t> table(manifest.table(part).bytes / sizeof(std::uint64_t));
  const std::span<std::byte> bytes = std::as_writable_bytes(std::span(table));
  read_bytes(file, manifest.table(part).offset, bytes);
  check_hash(bytes, part.table_hash, part.file + ": the block table");
  return table;
}

/// The bytes of one data set that belong to rows [first, first + rows) of a part.
Extent extent_of(const fs::path& file, const Manifest& m, const Part& part, std::size_t set,
                 std::uint64_t first, std::uint64_t rows) {
  const Extent& all = part.extents[set];
  if (set < m.fields.size() || set == m.history_end_set()) {
    const std::uint64_t w = set < m.fields.size() ? width(m.fields[set], m.dim) : sizeof(std::uint64_t);
    return {all.offset + first * w, rows * w};
  }
  const auto end_of = [&](std::uint64_t row) {
    std::uint64_t end = 0;
    const std::uint64_t at = part.extents[m.history_end_set()].offset + row * sizeof end;
    read_bytes(file, at, std::as_writable_bytes(std::span(&end, 1)));
    return end;
  };
  const std::uint64_t begin = first == 0 ? 0 : end_of(first - 1);
  const std::uint64_t end = end_of(first + rows - 1);
  if (begin > end || end > all.bytes)
    throw std::runtime_error(part.file + ": the contact history does not fit the file");
  return {all.offset + begin, end - begin};
}

std::string set_name(const Manifest& m, std::size_t set) {
  if (set < m.fields.size()) return std::string(info(m.fields[set]).name);
  return set == m.history_set() ? "history" : "history_end";
}

void verify_blocks(const fs::path& file, const Manifest& m, const Part& part, int share, int shares) {
  const std::vector<std::uint64_t> table = block_table(file, m, part);
  const std::size_t columns = 2 + m.hashed_sets();
  const std::size_t blocks = table.size() / columns;
  for (auto b = static_cast<std::size_t>(share); b < blocks; b += static_cast<std::size_t>(shares)) {
    const std::uint64_t* block = table.data() + b * columns;
    for (std::size_t set = 0; set < m.hashed_sets(); ++set)
      check_hash(bytes_at(file, extent_of(file, m, part, set, block[0], block[1])), block[2 + set],
                 part.file + ": block " + std::to_string(b) + " of " + set_name(m, set));
  }
}

}  // namespace

std::uint64_t frame_hash(const fs::path& file, std::uint64_t bytes, std::vector<Extent> extents) {
  std::sort(extents.begin(), extents.end(),
            [](const Extent& a, const Extent& b) { return a.offset < b.offset; });
  extents.push_back({bytes, 0});
  std::vector<std::byte> frame;
  std::uint64_t done = 0;
  for (const Extent& extent : extents) {
    if (extent.bytes == 0 && extent.offset < bytes) continue;
    const std::size_t size = frame.size();
    frame.resize(size + extent.offset - done);
    read_bytes(file, done, std::span(frame).subspan(size));
    done = extent.offset + extent.bytes;
  }
  return content_hash(frame);
}

void verify(const fs::path& dir, const Manifest& manifest, int share, int shares) {
  const auto parts = static_cast<int>(manifest.parts.size());
  for (int p = 0; p < parts; ++p) {
    // Either some shares join in one part or some parts make one share.
    const int helpers = shares >= parts ? (shares - p + parts - 1) / parts : 1;
    const bool mine = shares >= parts ? share % parts == p : p % shares == share;
    if (!mine) continue;
    const int helper = shares >= parts ? share / parts : 0;
    const Part& part = manifest.parts[static_cast<std::size_t>(p)];
    const fs::path file = dir / part.file;
    if (!fs::exists(file)) throw std::runtime_error(part.file + " is missing");
    if (const std::uint64_t size = fs::file_size(file); size != part.bytes)
      throw std::runtime_error(part.file + " has " + std::to_string(size) + " bytes, it was written with " +
                               std::to_string(part.bytes));
    if (helper == 0 && frame_hash(file, part.bytes, part.extents) != part.frame_hash)
      throw std::runtime_error(part.file + ": its structure is damaged: its hash differs");
    verify_blocks(file, manifest, part, helper, helpers);
  }
}

}  // namespace sph

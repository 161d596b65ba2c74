#include "checkpoint/checkpoint_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <stdexcept>
#include <utility>

namespace sph {
namespace {

namespace fs = std::filesystem;

struct Name {
  std::int64_t step = -1;
  std::int64_t attempt = 0;
  friend auto operator<=>(const Name&, const Name&) = default;
};

/// "000000001200" or "000000001200.1"; step -1 if it is neither.
Name name_of(const fs::path& dir) {
  const std::string text = dir.filename().string();
  const char* end = text.data() + text.size();
  Name name;
  const auto step = std::from_chars(text.data(), end, name.step);
  if (step.ec != std::errc() || name.step < 0) return {};
  if (step.ptr == end) return name;
  if (*step.ptr != '.') return {};
  const auto attempt = std::from_chars(step.ptr + 1, end, name.attempt);
  return attempt.ec == std::errc() && attempt.ptr == end ? name : Name{};
}

/// A cheap look: the manifest is whole and the parts are as long as they should be.
bool looks_complete(const fs::path& dir) {
  try {
    const Manifest manifest = manifest_from_text(read_manifest_text(dir));
    return std::all_of(manifest.parts.begin(), manifest.parts.end(),
                       [&](const Part& part) { return fs::file_size(dir / part.file) == part.bytes; });
  } catch (const std::exception&) {
    return false;
  }
}

bool is_own_name(const std::string& name) {
  return name.starts_with("manifest.json") ||
         (name.starts_with("part_") && name.find(".h5") != std::string::npos);
}

}  // namespace

void remove_checkpoint(const fs::path& dir) {
  std::error_code ignored;
  // The manifest goes first: what is left if this is interrupted does not look like a checkpoint.
  fs::remove(manifest_path(dir), ignored);
  std::vector<fs::path> own;
  for (fs::directory_iterator entry(dir, ignored), end; entry != end; entry.increment(ignored))
    if (is_own_name(entry->path().filename().string())) own.push_back(entry->path());
  for (const fs::path& path : own) fs::remove(path, ignored);
  fs::remove(dir, ignored);  // unless somebody has put something there
}

fs::path checkpoint_root(const fs::path& run_dir) { return run_dir / "checkpoint"; }
fs::path manifest_path(const fs::path& dir) { return dir / "manifest.json"; }

std::vector<fs::path> checkpoint_directories(const fs::path& root) {
  std::vector<std::pair<Name, fs::path>> found;
  std::error_code none;
  for (const fs::directory_entry& entry : fs::directory_iterator(root, none))
    if (const Name name = name_of(entry.path()); name.step >= 0 && entry.is_directory())
      found.emplace_back(name, entry.path());
  std::sort(found.rbegin(), found.rend());
  std::vector<fs::path> out;
  for (auto& [name, path] : found) out.push_back(std::move(path));
  return out;
}

fs::path make_checkpoint_directory(const fs::path& root, std::int64_t step) {
  fs::create_directories(root);
  const std::string first = fmt::format("{:012}", step);
  fs::path dir = root / first;
  const auto is_free = [&] {
    if (fs::exists(manifest_path(dir))) return false;
    remove_checkpoint(dir);  // what an interrupted write has left
    return !fs::exists(dir);
  };
  for (int attempt = 1; !is_free(); ++attempt) dir = root / fmt::format("{}.{}", first, attempt);
  fs::create_directory(dir);
  sync_to_disk(root);
  sync_to_disk(root.parent_path().empty() ? fs::path(".") : root.parent_path());
  return dir;
}

void remove_superseded(const fs::path& newest) {
  bool older_kept = false;
  for (const fs::path& dir : checkpoint_directories(newest.parent_path())) {
    if (dir.filename() == newest.filename()) continue;
    const bool keep = !older_kept && name_of(dir).step < name_of(newest).step && looks_complete(dir);
    if (keep) older_kept = true;
    if (!keep) remove_checkpoint(dir);
  }
}

std::string read_manifest_text(const fs::path& dir) {
  if (!fs::exists(manifest_path(dir)))
    throw std::runtime_error("has no manifest.json: its writing was interrupted");
  return read_text(manifest_path(dir));
}

void read_rows(const fs::path& dir, const Manifest& manifest, std::size_t set, std::size_t row_bytes,
               std::uint64_t first, std::uint64_t rows, std::byte* to) {
  for (const Part& part : manifest.parts) {
    if (rows == 0) return;
    if (first >= part.rows) {
      first -= part.rows;
      continue;
    }
    const std::uint64_t n = std::min(rows, part.rows - first);
    read_bytes(dir / part.file, part.extents[set].offset + first * row_bytes, {to, n * row_bytes});
    to += n * row_bytes;
    rows -= n;
    first = 0;
  }
  if (rows > 0) throw std::logic_error("rows beyond the end of the checkpoint");
}

decomp::Payload read_history(const fs::path& dir, const Manifest& manifest, std::uint64_t first,
                             std::uint64_t rows) {
  decomp::Payload history;
  for (const Part& part : manifest.parts) {
    if (first >= part.rows) {
      first -= part.rows;
      continue;
    }
    const std::uint64_t n = std::min(rows, part.rows - first);
    if (n == 0) break;
    // One entry more in front, which says where the first row begins; the part's first row begins at 0.
    std::vector<std::uint64_t> end(n + 1);
    const std::uint64_t before = first == 0 ? 0 : 1;
    const std::span<std::uint64_t> read = std::span(end).subspan(1 - before);
    const Extent& ends = part.extents[manifest.history_end_set()];
    read_bytes(dir / part.file, ends.offset + (first - before) * sizeof(std::uint64_t),
               std::as_writable_bytes(read));
    const Extent& bytes = part.extents[manifest.history_set()];
    if (!std::is_sorted(end.begin(), end.end()) || end.back() > bytes.bytes)
      throw std::runtime_error(part.file + ": the contact history does not fit the file");

    const std::uint64_t start = history.bytes.size();
    history.bytes.resize(start + end.back() - end.front());
    read_bytes(dir / part.file, bytes.offset + end.front(), std::span(history.bytes).subspan(start));
    for (std::uint64_t k = 1; k <= n; ++k) history.offset.push_back(start + end[k] - end.front());
    rows -= n;
    first = 0;
  }
  return history;
}

}  // namespace sph

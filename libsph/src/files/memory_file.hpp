// An HDF5 file that lives in memory while its structure is made, whatever its size: rows that nobody writes
// take no memory. HDF5 must never meet a full or failing disk itself: a file that it cannot close stays half
// open in the library and is its end when the program ends (SIGSEGV in HDF5 1.10).
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <span>

namespace sph {

/// Bytes by address, zero where nothing was written; pages of zeros take no memory.
class SparseBytes {
 public:
  void write(std::uint64_t at, std::span<const std::byte> from);
  void read(std::uint64_t at, std::span<std::byte> to) const;
  /// Hands over runs of the pages that hold anything, in ascending order, cut off at `end`.
  void for_each_run(std::uint64_t end,
                    const std::function<void(std::uint64_t, std::span<const std::byte>)>& take) const;

 private:
  static constexpr std::uint64_t page_bytes = 4096;
  using Page = std::array<std::byte, page_bytes>;
  std::map<std::uint64_t, Page> pages_;
};

/// What HDF5 has made of a file: its contents and its length.
struct MemoryFile {
  SparseBytes bytes;
  std::uint64_t length = 0;
};

/// A property list with which H5Fcreate makes its file in `to`, whatever name it is given; to be closed by
/// H5Pclose. `to` must outlive the file. Negative if HDF5 refuses.
[[nodiscard]] std::int64_t access_in_memory(MemoryFile& to);

}  // namespace sph

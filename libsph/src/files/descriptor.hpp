// An open file by its descriptor, with every error as text: what was asked, of which file, the system's
// reason.
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <span>

namespace sph {

/// Throws std::runtime_error("<what> <path>: <the system's text for the error number>").
[[noreturn]] void fail_on_file(const char* what, const std::filesystem::path& path, int error);

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags);  ///< as open(2), for a mode of 0666
  ~Descriptor();
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int get() const { return fd_; }
  /// Allocates all bytes up to `length`: writing there later cannot run out of space.
  void reserve(std::uint64_t length) const;
  void write(std::span<const std::byte> from) const;  ///< at the file's own place
  void write_at(std::uint64_t offset, std::span<const std::byte> from) const;
  void read_at(std::uint64_t offset, std::span<std::byte> to) const;  ///< throws if the file ends before
  void sync() const;
  /// A destructor closes too, but cannot say that some systems keep errors of writing for this call.
  void close();

 private:
  std::filesystem::path path_;
  int fd_ = -1;
};

}  // namespace sph

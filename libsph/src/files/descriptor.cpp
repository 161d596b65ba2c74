#include "files/descriptor.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <string>
#include <system_error>

namespace sph {
namespace {

constexpr std::size_t max_io_bytes = std::size_t{1} << 30;

/// Calls `part(done, bytes)`, which returns what a system call does, until `size` bytes are done. Returns how
/// many are: fewer if it returned 0, as at the end of a file.
template <class Part>
std::size_t in_parts(std::size_t size, const char* what, const std::filesystem::path& path, Part&& part) {
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = part(done, std::min(size - done, max_io_bytes));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail_on_file(what, path, errno);
    if (n == 0) break;
    done += static_cast<std::size_t>(n);
  }
  return done;
}

}  // namespace

void fail_on_file(const char* what, const std::filesystem::path& path, int error) {
  throw std::runtime_error(std::string(what) + " " + path.string() + ": " +
                           std::generic_category().message(error));
}

Descriptor::Descriptor(const std::filesystem::path& path, int flags) : path_(path) {
  constexpr mode_t everyone = 0666;  // less the user's umask
  do fd_ = ::open(path.c_str(), flags | O_CLOEXEC, everyone);
  while (fd_ < 0 && errno == EINTR);
  if (fd_ < 0) fail_on_file("open", path, errno);
}

Descriptor::~Descriptor() {
  if (fd_ >= 0) ::close(fd_);
}

void Descriptor::reserve(std::uint64_t length) const {
  if (length == 0) return;
  int error = 0;
  do error = ::posix_fallocate(fd_, 0, static_cast<off_t>(length));
  while (error == EINTR);
  if (error != 0) fail_on_file("reserve space for", path_, error);
}

void Descriptor::write(std::span<const std::byte> from) const {
  if (in_parts(from.size(), "write", path_, [&](std::size_t done, std::size_t bytes) {
        return ::write(fd_, from.data() + done, bytes);
      }) < from.size())
    fail_on_file("write", path_, EIO);
}

void Descriptor::write_at(std::uint64_t offset, std::span<const std::byte> from) const {
  if (in_parts(from.size(), "write", path_, [&](std::size_t done, std::size_t bytes) {
        return ::pwrite(fd_, from.data() + done, bytes, static_cast<off_t>(offset + done));
      }) < from.size())
    fail_on_file("write", path_, EIO);
}

void Descriptor::read_at(std::uint64_t offset, std::span<std::byte> to) const {
  if (in_parts(to.size(), "read", path_, [&](std::size_t done, std::size_t bytes) {
        return ::pread(fd_, to.data() + done, bytes, static_cast<off_t>(offset + done));
      }) < to.size())
    throw std::runtime_error("read " + path_.string() + ": the file ends too early");
}

void Descriptor::sync() const {
  // Some file systems cannot sync a directory and say EINVAL; there is nothing more to be done there.
  if (::fsync(fd_) != 0 && errno != EINVAL) fail_on_file("fsync", path_, errno);
}

void Descriptor::close() {
  const int fd = fd_;
  fd_ = -1;
  if (::close(fd) != 0 && errno != EINTR) fail_on_file("close", path_, errno);
}

}  // namespace sph

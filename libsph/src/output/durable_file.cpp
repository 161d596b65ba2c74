#include "output/durable_file.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <stdexcept>
#include <system_error>

namespace sph {
namespace {

constexpr std::size_t max_io_bytes = std::size_t{1} << 30;

[[noreturn]] void fail(const std::string& what, const std::filesystem::path& path, int error) {
  throw std::runtime_error(what + " " + path.string() + ": " + std::generic_category().message(error));
}

class Descriptor {
 public:
  Descriptor(const std::filesystem::path& path, int flags) : path_(path) {
    constexpr mode_t everyone = 0666;  // less the user's umask
    do fd_ = ::open(path.c_str(), flags | O_CLOEXEC, everyone);
    while (fd_ < 0 && errno == EINTR);
    if (fd_ < 0) fail("open", path, errno);
  }
  ~Descriptor() {
    if (fd_ >= 0) ::close(fd_);
  }
  Descriptor(const Descriptor&) = delete;
  Descriptor& operator=(const Descriptor&) = delete;

  [[nodiscard]] int get() const { return fd_; }
  void write(std::span<const std::byte> from) const {
    for (std::size_t done = 0; done < from.size();) {
      const ssize_t n = ::write(fd_, from.data() + done, std::min(from.size() - done, max_io_bytes));
      if (n < 0 && errno == EINTR) continue;
      if (n < 0) fail("write", path_, errno);
      done += static_cast<std::size_t>(n);
    }
  }
  void sync() const {
    // Some file systems cannot sync a directory and say EINVAL; there is nothing more to be done there.
    if (::fsync(fd_) != 0 && errno != EINVAL) fail("fsync", path_, errno);
  }
  void close() {
    const int fd = fd_;
    fd_ = -1;
    if (::close(fd) != 0 && errno != EINTR) fail("close", path_, errno);
  }

 private:
  std::filesystem::path path_;
  int fd_ = -1;
};

}  // namespace

void create_reserved(const std::filesystem::path& path, std::span<const std::byte> start,
                     std::uint64_t length) {
  Descriptor file(path, O_RDWR | O_CREAT | O_TRUNC);
  int error = 0;
  do error = ::posix_fallocate(file.get(), 0, static_cast<off_t>(length));
  while (error == EINTR);
  if (error != 0) fail("reserve space for", path, error);
  file.write(start);
  file.close();
}

void sync_to_disk(const std::filesystem::path& path) {
  Descriptor file(path, O_RDONLY);
  file.sync();
  file.close();
}

void check_writable(const std::filesystem::path& path) { Descriptor(path, O_RDWR).close(); }

void write_atomically(const std::filesystem::path& path, const std::string& text) {
  std::filesystem::path temporary = path;
  temporary += ".tmp";
  try {
    Descriptor file(temporary, O_WRONLY | O_CREAT | O_TRUNC);
    file.write(std::as_bytes(std::span(text)));
    file.sync();
    file.close();
    rename_durably(temporary, path);
  } catch (...) {
    std::error_code ignored;
    std::filesystem::remove(temporary, ignored);
    throw;
  }
}

void rename_durably(const std::filesystem::path& from, const std::filesystem::path& to) {
  std::filesystem::rename(from, to);
  sync_to_disk(to.has_parent_path() ? to.parent_path() : std::filesystem::path("."));
}

void read_bytes(const std::filesystem::path& path, std::uint64_t offset, std::span<std::byte> to) {
  Descriptor file(path, O_RDONLY);
  for (std::size_t done = 0; done < to.size();) {
    const ssize_t n = ::pread(file.get(), to.data() + done, std::min(to.size() - done, max_io_bytes),
                              static_cast<off_t>(offset + done));
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail("read", path, errno);
    if (n == 0) throw std::runtime_error("read " + path.string() + ": the file ends too early");
    done += static_cast<std::size_t>(n);
  }
}

std::string read_text(const std::filesystem::path& path) {
  std::string text(std::filesystem::file_size(path), '\0');
  read_bytes(path, 0, std::as_writable_bytes(std::span(text)));
  return text;
}

}  // namespace sph

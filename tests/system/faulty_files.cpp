// A library to preload (LD_PRELOAD) that lets file operations of a program fail. Operations on files below
// FAULTS_BELOW are counted from 1, those that only read as well; at number FAULTS_AT it does as FAULTS_DO
// says:
//   kill           half of a write is done, nothing of anything else, and the process is killed
//   enospc, eio    the call fails with that error
//   enospc_stay    so do all that follow and need space
// FAULTS_RANK: only in that rank of MPI. FAULTS_LOG: a file that gets one line for each operation.
// Functions of libc that call each other do so inside it, unseen: each operation is counted once.
#include <dlfcn.h>
#include <fcntl.h>
#include <sys/stat.h>
#include <sys/uio.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <climits>
#include <csignal>
#include <cstdarg>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <string>

namespace {

enum class Kind { space, change, read };  // needs space, changes a name or length, reads

template <class Function>
Function* real(const char* name) {
  return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

std::string environment(const char* name) {
  const char* value = std::getenv(name);
  return value == nullptr ? "" : value;
}

struct Faults {
  std::string below = environment("FAULTS_BELOW");
  std::string action = environment("FAULTS_DO");
  std::string log = environment("FAULTS_LOG");
  long at = std::atol(environment("FAULTS_AT").c_str());
  long count = 0;
  bool active = false;

  Faults() {
    const std::string rank = environment("FAULTS_RANK");
    const std::string own = environment("OMPI_COMM_WORLD_RANK");
    active = !below.empty() && (rank.empty() || own.empty() || rank == own);
  }

  [[nodiscard]] bool concerns(const std::string& path) const { return active && path.starts_with(below); }

  void note(const char* call, const std::string& path, Kind kind) const {
    if (log.empty()) return;
    constexpr std::array kinds{"space", "change", "read"};
    const std::string line = std::to_string(count) + " " + kinds[static_cast<std::size_t>(kind)] + " " +
                             call + " " + path.substr(below.size()) + "\n";
    const int fd = real<int(const char*, int, ...)>("open")(log.c_str(), O_WRONLY | O_CREAT | O_APPEND, 0644);
    real<ssize_t(int, const void*, std::size_t)>("write")(fd, line.data(), line.size());
    real<int(int)>("close")(fd);
  }

  /// The error with which the operation fails, 0 if it does not. Calls `half` before it kills.
  template <class Half>
  int fault(const char* call, const std::string& path, Kind kind, Half&& half) {
    ++count;
    note(call, path, kind);
    const bool now = count == at;
    if (action == "enospc_stay") return at > 0 && count >= at && kind == Kind::space ? ENOSPC : 0;
    if (!now) return 0;
    if (action == "kill") {
      half();
      kill(getpid(), SIGKILL);
      pause();
    }
    return action == "enospc" ? ENOSPC : action == "eio" ? EIO : 0;
  }
  int fault(const char* call, const std::string& path, Kind kind) {
    return fault(call, path, kind, [] {});
  }
};

Faults& faults() {
  static Faults faults;
  return faults;
}

std::string full(const char* path) {
  if (path == nullptr || path[0] == '/') return path == nullptr ? "" : path;
  std::array<char, PATH_MAX> here{};
  return getcwd(here.data(), here.size()) == nullptr ? path : std::string(here.data()) + "/" + path;
}

std::string path_of(int fd) {
  std::array<char, PATH_MAX> to{};
  const std::string link = "/proc/self/fd/" + std::to_string(fd);
  const ssize_t n = readlink(link.c_str(), to.data(), to.size() - 1);
  return n > 0 ? std::string(to.data(), static_cast<std::size_t>(n)) : "";
}

std::string full_at(int folder, const char* path) {
  if (path[0] == '/' || folder == AT_FDCWD) return full(path);
  return path_of(folder) + "/" + path;
}

/// The call with its arguments, unless it is to fail.
template <class Result, class... Parameters, class... Arguments>
Result call_or_fail(const char* name, const std::string& path, Kind kind, Result (*)(Parameters...),
                    Arguments... arguments) {
  if (faults().concerns(path))
    if (const int error = faults().fault(name, path, kind)) {
      errno = error;
      return static_cast<Result>(-1);
    }
  return real<Result(Parameters...)>(name)(arguments...);
}

Kind kind_of_open(int flags) {
  return (flags & O_CREAT) != 0 ? Kind::space : (flags & O_ACCMODE) == O_RDONLY ? Kind::read : Kind::change;
}

int open_or_fail(const char* name, const char* path, int flags, mode_t mode) {
  const std::string whole = full(path);
  if (faults().concerns(whole))
    if (const int error = faults().fault(name, whole, kind_of_open(flags))) {
      errno = error;
      return -1;
    }
  return real<int(const char*, int, ...)>(name)(path, flags, mode);
}

std::FILE* stream_or_fail(const char* name, const char* path, const char* mode) {
  const std::string whole = full(path);
  if (faults().concerns(whole))
    if (const int error = faults().fault(name, whole, mode[0] == 'r' ? Kind::read : Kind::space)) {
      errno = error;
      return nullptr;
    }
  return real<std::FILE*(const char*, const char*)>(name)(path, mode);
}

ssize_t write_or_fail(const char* name, int fd, const void* from, std::size_t size, const off_t* at) {
  using Write = ssize_t(int, const void*, std::size_t);
  using WriteAt = ssize_t(int, const void*, std::size_t, off_t);
  const auto go = [&](std::size_t bytes) {
    return at == nullptr ? real<Write>(name)(fd, from, bytes) : real<WriteAt>(name)(fd, from, bytes, *at);
  };
  if (const std::string path = path_of(fd); faults().concerns(path))
    if (const int error = faults().fault(name, path, Kind::space, [&] { go(size / 2); })) {
      errno = error;
      return -1;
    }
  return go(size);
}

mode_t mode_in(int flags, va_list& more) { return (flags & O_CREAT) != 0 ? va_arg(more, mode_t) : 0; }

}  // namespace

extern "C" {

int open(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_in(flags, more);
  va_end(more);
  return open_or_fail("open", path, flags, mode);
}
int open64(const char* path, int flags, ...) {
  va_list more;
  va_start(more, flags);
  const mode_t mode = mode_in(flags, more);
  va_end(more);
  return open_or_fail("open64", path, flags, mode);
}
std::FILE* fopen(const char* path, const char* mode) { return stream_or_fail("fopen", path, mode); }
std::FILE* fopen64(const char* path, const char* mode) { return stream_or_fail("fopen64", path, mode); }

ssize_t write(int fd, const void* from, std::size_t size) {
  return write_or_fail("write", fd, from, size, nullptr);
}
ssize_t pwrite(int fd, const void* from, std::size_t size, off_t at) {
  return write_or_fail("pwrite", fd, from, size, &at);
}
ssize_t pwrite64(int fd, const void* from, std::size_t size, off64_t at) {
  return write_or_fail("pwrite64", fd, from, size, &at);
}
ssize_t writev(int fd, const iovec* parts, int count) {
  return call_or_fail("writev", path_of(fd), Kind::space, &writev, fd, parts, count);
}
ssize_t read(int fd, void* to, std::size_t size) {
  return call_or_fail("read", path_of(fd), Kind::read, &read, fd, to, size);
}
ssize_t pread(int fd, void* to, std::size_t size, off_t at) {
  return call_or_fail("pread", path_of(fd), Kind::read, &pread, fd, to, size, at);
}
ssize_t pread64(int fd, void* to, std::size_t size, off64_t at) {
  return call_or_fail("pread64", path_of(fd), Kind::read, &pread64, fd, to, size, at);
}
int fsync(int fd) { return call_or_fail("fsync", path_of(fd), Kind::space, &fsync, fd); }
int ftruncate(int fd, off_t size) noexcept {
  return call_or_fail("ftruncate", path_of(fd), Kind::change, &ftruncate, fd, size);
}
int ftruncate64(int fd, off64_t size) noexcept {
  return call_or_fail("ftruncate64", path_of(fd), Kind::change, &ftruncate64, fd, size);
}
int truncate(const char* path, off_t size) noexcept {
  return call_or_fail("truncate", full(path), Kind::change, &truncate, path, size);
}
int posix_fallocate(int fd, off_t start, off_t size) {
  if (const std::string path = path_of(fd); faults().concerns(path))
    if (const int error = faults().fault("posix_fallocate", path, Kind::space)) return error;
  return real<int(int, off_t, off_t)>("posix_fallocate")(fd, start, size);
}
int posix_fallocate64(int fd, off64_t start, off64_t size) {
  if (const std::string path = path_of(fd); faults().concerns(path))
    if (const int error = faults().fault("posix_fallocate64", path, Kind::space)) return error;
  return real<int(int, off64_t, off64_t)>("posix_fallocate64")(fd, start, size);
}
/// The file is closed all the same, as Linux does where close() fails.
int close(int fd) {
  if (const std::string path = path_of(fd); faults().concerns(path)) {
    const bool writes = (fcntl(fd, F_GETFL) & O_ACCMODE) != O_RDONLY;
    if (const int error = faults().fault("close", path, writes ? Kind::space : Kind::read)) {
      real<int(int)>("close")(fd);
      errno = error;
      return -1;
    }
  }
  return real<int(int)>("close")(fd);
}
int rename(const char* from, const char* to) noexcept {
  return call_or_fail("rename", full(to), Kind::space, &rename, from, to);
}
int link(const char* from, const char* to) noexcept {
  return call_or_fail("link", full(to), Kind::space, &link, from, to);
}
int unlink(const char* path) noexcept {
  return call_or_fail("unlink", full(path), Kind::change, &unlink, path);
}
int unlinkat(int folder, const char* path, int flags) noexcept {
  return call_or_fail("unlinkat", full_at(folder, path), Kind::change, &unlinkat, folder, path, flags);
}
int remove(const char* path) noexcept {
  return call_or_fail("remove", full(path), Kind::change, &remove, path);
}
int rmdir(const char* path) noexcept { return call_or_fail("rmdir", full(path), Kind::change, &rmdir, path); }
int mkdir(const char* path, mode_t mode) noexcept {
  return call_or_fail("mkdir", full(path), Kind::space, &mkdir, path, mode);
}

}  // extern "C"

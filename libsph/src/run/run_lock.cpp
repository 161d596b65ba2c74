#include "run/run_lock.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <optional>
#include <system_error>
#include <thread>

#include "files/agree.hpp"
#include "files/descriptor.hpp"
#include "files/durable_file.hpp"

namespace sph {
namespace {

namespace fs = std::filesystem;
using namespace std::chrono_literals;

/// A file with the text of the lock, beside it, under a name that no other process has; removed in the end.
class Draft {
 public:
  Draft(const fs::path& lock, const LockOwner& self, const std::string& text)
      : path_(fmt::format("{}.{}.{}.tmp", lock.string(), self.host, self.pid)) {
    try {
      Descriptor file = create_anew(path_);
      file.write(std::as_bytes(std::span(text)));
      file.close();
    } catch (...) {
      remove();
      throw;
    }
  }
  ~Draft() { remove(); }
  Draft(const Draft&) = delete;
  Draft& operator=(const Draft&) = delete;
  [[nodiscard]] const fs::path& path() const { return path_; }

 private:
  void remove() const {
    std::error_code ignored;
    fs::remove(path_, ignored);
  }
  fs::path path_;
};

/// Makes the lock unless there is one; true if it was made.
bool make(const Draft& draft, const fs::path& lock, const std::string& text) {
  if (::link(draft.path().c_str(), lock.c_str()) == 0) return true;
  const int error = errno;
  struct stat status {};
  // A server of NFS whose answer was lost says on the second try that the file exists.
  if (error == EEXIST) return ::stat(draft.path().c_str(), &status) == 0 && status.st_nlink == 2;
  if (error != EPERM && error != ENOTSUP && error != ENOSYS && error != EMLINK)
    fail_on_file("link", lock, error);
  try {  // a file system without links
    Descriptor file(lock, O_WRONLY | O_CREAT | O_EXCL);
    file.write(std::as_bytes(std::span(text)));
    file.close();
    return true;
  } catch (const std::exception&) {
    if (fs::exists(lock)) return false;
    throw;
  }
}

std::optional<std::string> text_of(const fs::path& lock) {
  try {
    return read_text(lock);
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

bool is_the_file(int fd, const fs::path& path) {
  struct stat open {
  }, named{};
  return ::fstat(fd, &open) == 0 && ::stat(path.c_str(), &named) == 0 && open.st_dev == named.st_dev &&
         open.st_ino == named.st_ino;
}

std::string described(const LockOwner& o) {
  return fmt::format("process {} on {}, since {}", o.pid, o.host, o.since);
}

}  // namespace

RunLock::RunLock(const decomp::Comm& comm, fs::path dir) : lock_(dir / "run.lock") {
  const std::string failure = agree(comm, attempt([&] {
                                      if (comm.rank() == 0) take();
                                    }));
  if (!failure.empty()) throw InputError(failure);
  inherited_ = comm.max(std::int64_t{inherited_}) != 0;
}

RunLock::~RunLock() {
  std::error_code ignored;
  if (!mine_.empty() && text_of(lock_) == mine_) fs::remove(lock_, ignored);
}

void RunLock::take() {
  const LockOwner self = this_process();
  const std::string mine = to_json(self);
  const Draft draft(lock_, self, mine);
  constexpr int tries = 5;
  for (int k = 0; k < tries; ++k) {
    if (make(draft, lock_, mine)) {
      mine_ = mine;
      return;
    }
    std::error_code none;
    const auto quiet = fs::last_write_time(draft.path()) - fs::last_write_time(lock_, none);
    const std::optional<std::string> found = text_of(lock_);
    if (none || !found) continue;  // it has just gone
    const LockOwner owner = owner_from_json(*found);
    const auto seconds = std::chrono::duration_cast<std::chrono::seconds>(quiet);
    if (!is_gone(owner, self, seconds)) {
      const std::string advice = owner.machine == self.machine
                                     ? "let that run end first"
                                     : fmt::format(
                                           "last sign of life {} s ago; if that run is dead, delete {}, "
                                           "or try again when 15 minutes have passed",
                                           seconds.count(), lock_.string());
      throw InputError(fmt::format("{} is in use by another run ({}): {}", lock_.parent_path().string(),
                                   described(owner), advice));
    }
    if (!take_over(*found)) continue;
    inherited_ = true;
    fmt::print(stderr, "peperite: took over {} of a run that is gone ({})\n", lock_.string(),
               described(owner));
    return;
  }
  throw InputError(lock_.string() + ": other runs are just taking this directory");
}

/// Several may find the same dead lock. Who gets the kernel's lock on that very file, while it still has the
/// name, replaces it; the others find another file under the name, or the kernel's lock taken.
bool RunLock::take_over(const std::string& old) {
  const Descriptor file(lock_, O_RDWR);
  const bool locked = ::flock(file.get(), LOCK_EX | LOCK_NB) == 0;
  if (!locked && errno == EWOULDBLOCK) {
    std::this_thread::sleep_for(100ms);
    return false;
  }
  if (!is_the_file(file.get(), lock_) || text_of(lock_) != old) return false;
  const LockOwner self = this_process();
  const std::string mine = to_json(self);
  const Draft draft(fs::path(lock_.string() + ".next"), self, mine);
  fs::rename(draft.path(), lock_);
  if (!locked) std::this_thread::sleep_for(1s);  // no such locks here: who came last has it
  if (text_of(lock_) != mine) return false;
  mine_ = mine;
  return true;
}

void RunLock::touch() {
  const auto now = std::chrono::steady_clock::now();
  if (mine_.empty() || now - touched_ < 10s) return;
  touched_ = now;
  std::error_code none;
  if (!fs::exists(lock_, none) && !none) {  // deleted by hand: ours if nobody else has come
    const Draft draft(lock_, owner_from_json(mine_), mine_);
    if (make(draft, lock_, mine_)) return;
  }
  const std::optional<std::string> found = text_of(lock_);
  if (found && *found != mine_)
    throw OutputError(fmt::format("{} is now of another run ({}), which goes on from the last checkpoint",
                                  lock_.string(), described(owner_from_json(*found))));
  ::utimensat(AT_FDCWD, lock_.c_str(), nullptr, 0);  // a disk that cannot be reached now may be back soon
}

}  // namespace sph

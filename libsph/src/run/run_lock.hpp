// One run at a time writes in a directory: DIR/run.lock says which process that is. It appears by link(2),
// which succeeds for one of any number of contenders on every file system, and is complete from the
// beginning.
//
// A lock whose owner is gone is taken over. On the same machine (boot id and pid name space) the owner is the
// process with that pid and start time, so that a reused pid does not pass for it. Elsewhere it is gone if
// the lock belongs to an earlier start of the same Slurm job, or has not been touched for 15 minutes by the
// clock of the file system; a living run touches it every 10 s, between two steps.
#pragma once

#include <chrono>
#include <filesystem>
#include <string>

#include "decomp/comm.hpp"

namespace sph {

/// The process that a lock names.
struct LockOwner {
  std::string host;     ///< for readers with eyes
  std::string machine;  ///< boot id and pid name space
  std::int64_t pid = 0;
  std::string started;  ///< of the process, in the kernel's ticks
  std::string job;      ///< Slurm's cluster and job, empty outside
  std::int64_t restart = 0;
  std::string since;
};
[[nodiscard]] LockOwner this_process();
[[nodiscard]] std::string to_json(const LockOwner& owner);
/// What is no text of a lock names a process of no machine.
[[nodiscard]] LockOwner owner_from_json(const std::string& text);
/// `quiet`: how long ago the lock was touched.
[[nodiscard]] bool is_gone(const LockOwner& owner, const LockOwner& self, std::chrono::seconds quiet);

class RunLock {
 public:
  /// Rank 0 takes the lock of an existing directory for all. InputError on all ranks if another run has it,
  /// or nothing can be written there. Collective.
  RunLock(const decomp::Comm& comm, std::filesystem::path dir);
  ~RunLock();
  RunLock(const RunLock&) = delete;
  RunLock& operator=(const RunLock&) = delete;

  /// A run before this one was killed in the directory. The same on all ranks.
  [[nodiscard]] bool inherited() const { return inherited_; }
  /// A sign of life of rank 0, cheap where one was given a moment ago. Throws OutputError if the directory is
  /// another run's now.
  void touch();

 private:
  void take();
  bool take_over(const std::string& old);

  std::filesystem::path lock_;
  std::string mine_;  ///< contents of the lock; empty where this rank does not hold it
  bool inherited_ = false;
  std::chrono::steady_clock::time_point touched_ = std::chrono::steady_clock::now();
};

}  // namespace sph

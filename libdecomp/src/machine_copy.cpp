#include "decomp/machine_copy.hpp"

#include <fcntl.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstring>
#include <new>

#include "decomp/memory.hpp"

// Not MPI_Win_allocate_shared: where memory runs out its first rank fails alone and the others wait for ever (Open MPI 4.1), or all are
// killed when they touch what is not there.

namespace decomp {
namespace {

/// A file in memory, which the kernel keeps as long as any rank has it mapped.
class SharedFile {
 public:
  SharedFile(const char* name, int flags) : file_(shm_open(name, flags, S_IRUSR | S_IWUSR)) {
    if (file_ < 0) error_ = errno;
  }
  ~SharedFile() {
    if (file_ >= 0) close(file_);
  }
  SharedFile(const SharedFile&) = delete;
  SharedFile& operator=(const SharedFile&) = delete;

  /// Now, or an error: pages that are missing later would be a signal.
  void reserve(std::size_t size) {
    if (file_ >= 0) error_ = posix_fallocate(file_, 0, static_cast<off_t>(size));
  }
  /// Null if anything has failed.
  [[nodiscard]] std::shared_ptr<std::byte> map(std::size_t size, int protection) {
    if (error_ != 0) return nullptr;
    void* const memory = mmap(nullptr, size, protection, MAP_SHARED, file_, 0);
    if (memory == MAP_FAILED) {
      error_ = errno;
      return nullptr;
    }
    return {static_cast<std::byte*>(memory), [size](std::byte* p) { munmap(p, size); }};
  }
  [[nodiscard]] int error() const { return error_; }

 private:
  int file_, error_ = 0;
};

std::shared_ptr<std::byte> private_memory(std::size_t size) {
  return {static_cast<std::byte*>(allocate_large(size)), release_large};
}

/// The ranks of `comm` that split() gives one communicator with this one.
template <class Split>
Comm part_of(const Comm& comm, Split&& split) {
  MPI_Comm part = MPI_COMM_NULL;
  split(comm.get(), &part);
  struct Free {
    MPI_Comm comm;
    ~Free() { MPI_Comm_free(&comm); }
  } free{part};
  return Comm(part);
}

Comm machine_of(const Comm& comm) {
  return part_of(comm, [&](MPI_Comm all, MPI_Comm* part) {
    check_mpi(MPI_Comm_split_type(all, MPI_COMM_TYPE_SHARED, comm.rank(), MPI_INFO_NULL, part),
              "MPI_Comm_split_type");
  });
}

/// Memory of `size` bytes that the first rank of a machine writes and all read: of the machine, else null and why.
std::shared_ptr<std::byte> memory_of(const Comm& machine, std::size_t size, std::string& problem) {
  std::array<char, 64> name{};
  static int count = 0;
  std::snprintf(name.data(), name.size(), "/peperite_%d_%d", static_cast<int>(getpid()), count++);
  machine.broadcast(std::as_writable_bytes(std::span(name)), 0);
  const bool first = machine.rank() == 0;
  std::shared_ptr<std::byte> memory;
  int error = 0;
  const auto open = [&](int flags, int protection) {
    SharedFile file(name.data(), flags);
    if (first) file.reserve(size);
    memory = file.map(size, protection);
    error = file.error();
  };
  if (first) open(O_CREAT | O_EXCL | O_RDWR, PROT_READ | PROT_WRITE);
  if (machine.max(first ? error : 0) == 0 && !first) open(O_RDONLY, PROT_READ);
  const auto worst = static_cast<int>(machine.max(error));
  if (first && error != EEXIST) shm_unlink(name.data());
  if (worst == 0) return memory;
  problem = std::strerror(worst);
  return nullptr;
}

}  // namespace

MachineCopy copy_to_machines(const Comm& comm, std::shared_ptr<const std::byte> bytes, std::size_t size) {
  comm.broadcast(std::as_writable_bytes(std::span(&size, 1)), 0);
  const Comm machine = machine_of(comm);
  MachineCopy out{nullptr, size, {}};
  const bool first = machine.rank() == 0, alone = machine.size() == 1;
  std::shared_ptr<std::byte> memory = alone ? nullptr : memory_of(machine, size, out.problem);
  const bool shared = memory != nullptr;
  if (alone && comm.rank() == 0) memory = std::const_pointer_cast<std::byte>(bytes);
  if (memory == nullptr) memory = private_memory(size);
  if (comm.rank() == 0 && memory != bytes) std::memcpy(memory.get(), bytes.get(), size);
  const Comm firsts = part_of(comm, [&](MPI_Comm all, MPI_Comm* part) {
    check_mpi(MPI_Comm_split(all, first ? 0 : 1, comm.rank(), part), "MPI_Comm_split");
  });
  if (first) firsts.broadcast(std::span(memory.get(), size), 0);
  if (shared)
    machine.barrier();
  else
    machine.broadcast(std::span(memory.get(), size), 0);
  out.bytes = std::move(memory);
  return out;
}

}  // namespace decomp

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include "decomp/machine_copy.hpp"

namespace {

using decomp::Comm, decomp::MachineCopy;

constexpr std::size_t size = 3'000'001;

std::byte value(std::size_t k) { return static_cast<std::byte>(k * 37 >> 3); }

MachineCopy copy(const Comm& comm) {
  std::shared_ptr<std::byte> bytes;
  if (comm.rank() == 0) {
    bytes.reset(new std::byte[size], std::default_delete<std::byte[]>());
    for (std::size_t k = 0; k < size; ++k) bytes.get()[k] = value(k);
  }
  return decomp::copy_to_machines(comm, bytes, comm.rank() == 0 ? size : 0);
}

std::size_t wrong(const MachineCopy& copy) {
  std::size_t n = copy.size == size ? 0 : 1;
  for (std::size_t k = 0; k < copy.size; ++k) n += copy.bytes.get()[k] == value(k) ? 0 : 1;
  return n;
}

struct Mapping {
  std::string rights;
  std::int64_t file = 0;
};

/// Where /proc/self/maps has this address: "from-to rights offset device inode".
Mapping mapping_of(const std::byte* address) {
  std::ifstream maps("/proc/self/maps");
  for (std::string line; std::getline(maps, line);) {
    std::istringstream in(line);
    std::uintptr_t from = 0, to = 0;
    char dash = 0;
    Mapping m;
    std::string offset, device;
    in >> std::hex >> from >> dash >> to >> m.rights >> offset >> device >> std::dec >> m.file;
    if (from <= reinterpret_cast<std::uintptr_t>(address) && reinterpret_cast<std::uintptr_t>(address) < to)
      return m;
  }
  return {};
}

TEST(MachineCopy, IsOne) {
  const Comm comm(MPI_COMM_WORLD);
  const MachineCopy mine = copy(comm), another = copy(comm);
  EXPECT_EQ(wrong(mine) + wrong(another), 0U);
  EXPECT_EQ(mine.problem, "");
  if (comm.size() == 1) return;
  const Mapping at = mapping_of(mine.bytes.get());
  EXPECT_NE(at.file, 0);
  EXPECT_EQ(comm.max(at.file), at.file);  // these tests run on one machine
  EXPECT_EQ(at.rights, comm.rank() == 0 ? "rw-s" : "r--s");
  EXPECT_NE(mapping_of(another.bytes.get()).file, at.file);
  for (const auto& entry : std::filesystem::directory_iterator("/dev/shm"))
    EXPECT_EQ(entry.path().filename().string().find("peperite_" + std::to_string(getpid())),
              std::string::npos);
}

TEST(MachineCopy, IsOneOfEachRankWhereItCannotBeShared) {
  const Comm comm(MPI_COMM_WORLD);
  if (comm.size() == 1) GTEST_SKIP() << "a copy of one rank is its own";
  comm.barrier();
  for (const int without : {0, comm.size() - 1}) {
    rlimit files{};
    getrlimit(RLIMIT_NOFILE, &files);
    const int next = open("/dev/null", O_RDONLY);
    close(next);
    const rlimit none{static_cast<rlim_t>(next), files.rlim_max};
    if (comm.rank() == without) setrlimit(RLIMIT_NOFILE, &none);
    const MachineCopy mine = copy(comm);
    setrlimit(RLIMIT_NOFILE, &files);
    EXPECT_EQ(wrong(mine), 0U);
    EXPECT_EQ(mine.problem, "Too many open files");
    const Mapping at = mapping_of(mine.bytes.get());
    EXPECT_EQ(at.rights, "rw-p");
  }
}

}  // namespace

// What a run's files rest on: locks, names, HDF5 structure made in memory, and trials in a copy of the
// process.
#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <numeric>

#include "files/hdf5_file.hpp"
#include "files/memory_file.hpp"
#include "inspect/trial.hpp"
#include "run/run_directory.hpp"
#include "run/run_files.hpp"
#include "run/run_lock.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

using namespace std::chrono_literals;
namespace fs = std::filesystem;

TEST(RunLock, KnowsWhoIsGone) {
  const LockOwner self = this_process();
  EXPECT_FALSE(is_gone(self, self, 1000h)) << "a living process keeps its lock, however quiet";
  LockOwner other = self;
  other.started += "1";
  EXPECT_TRUE(is_gone(other, self, 0s)) << "the pid belongs to another process now";
  other = self;
  other.pid = 1 << 30;
  EXPECT_TRUE(is_gone(other, self, 0s));
  other.machine = "another";
  EXPECT_FALSE(is_gone(other, self, 14min));
  EXPECT_TRUE(is_gone(other, self, 16min));
  other.job = "cluster:5";
  LockOwner later = self;
  later.job = other.job;
  EXPECT_FALSE(is_gone(other, later, 0s)) << "the same start of the job may have two runs";
  later.restart = 1;
  EXPECT_TRUE(is_gone(other, later, 0s));
  later.job = "cluster:6";
  EXPECT_FALSE(is_gone(other, later, 0s));
}

TEST(RunLock, AZombieIsGone) {
  const pid_t child = fork();
  if (child == 0) _exit(0);
  siginfo_t info{};
  waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT);
  LockOwner owner = this_process();
  owner.pid = child;
  std::ifstream stat("/proc/" + std::to_string(child) + "/stat");
  for (int word = 1; word <= 22; ++word) stat >> owner.started;
  EXPECT_TRUE(is_gone(owner, this_process(), 0s));
  waitpid(child, nullptr, 0);
}

TEST(RunLock, IsReadAsWrittenAndJunkIsOfNoMachine) {
  const LockOwner self = this_process();
  EXPECT_EQ(to_json(owner_from_json(to_json(self))), to_json(self));
  EXPECT_FALSE(self.started.empty());
  EXPECT_FALSE(self.machine.empty());
  for (const std::string text : {"", "{", "7", R"({"pid": "x"})"}) {
    EXPECT_FALSE(is_gone(owner_from_json(text), self, 0s)) << text;
    EXPECT_TRUE(is_gone(owner_from_json(text), self, 1h)) << text;
  }
}

TEST(RunLock, IsHeldByAllRanksUntilItEnds) {
  const decomp::Comm world(MPI_COMM_WORLD);
  const ScratchDirectory scratch(world);
  {
    const RunLock lock(world, scratch.path());
    EXPECT_FALSE(lock.inherited());
    EXPECT_TRUE(fs::exists(scratch.path() / "run.lock"));
    EXPECT_THROW(RunLock(world, scratch.path()), InputError);
    EXPECT_TRUE(fs::exists(scratch.path() / "run.lock")) << "who was refused removes nothing";
    world.barrier();
  }
  world.barrier();
  EXPECT_TRUE(fs::is_empty(scratch.path()));
}

TEST(RunDirectory, SnapshotsHaveOneNameEach) {
  for (const std::int64_t step : {std::int64_t{0}, std::int64_t{999999999}, std::int64_t{1} << 40})
    EXPECT_EQ(step_of_snapshot(snapshot_name(step)), step);
  for (const char* name :
       {"snapshot_7.h5", "snapshot_0000000007.h5", "snapshot_keep_for_paper.h5", "snapshot_.h5",
        "snapshot_000000007.h5.tmp", "snapshot_-00000007.h5", "000000007", ""})
    EXPECT_FALSE(step_of_snapshot(name)) << name;
}

TEST(RunMemory, OfAnOlderCheckpointHasNoHashOfTheSeries) {
  RunMemory memory;
  memory.series_bytes = 12;
  EXPECT_FALSE(memory_from_json(to_json(memory)).series_hash);
  memory.series_hash = ~std::uint64_t{0};
  EXPECT_EQ(memory_from_json(to_json(memory)).series_hash, memory.series_hash);
  EXPECT_FALSE(memory_from_json(R"({"monitor_ids": [], "series_bytes": 5, "snapshots": []})").series_hash);
}

TEST(MemoryFile, HoldsWhatWasWrittenAndZerosElsewhere) {
  SparseBytes bytes;
  std::vector<std::byte> text(10000);
  for (std::size_t k = 0; k < text.size(); ++k) text[k] = static_cast<std::byte>(k % 251 + 1);
  const std::uint64_t far = (std::uint64_t{1} << 40) + 4000;
  bytes.write(4090, text);
  bytes.write(far, std::span(text).first(200));
  std::vector<std::byte> back(10010);
  bytes.read(4085, back);
  EXPECT_EQ(back[4], std::byte{0});
  EXPECT_EQ(std::memcmp(back.data() + 5, text.data(), text.size()), 0);
  EXPECT_EQ(back.back(), std::byte{0});
  std::vector<std::pair<std::uint64_t, std::size_t>> runs;
  bytes.for_each_run(far + 100, [&](std::uint64_t at, std::span<const std::byte> run) {
    runs.emplace_back(at, run.size());
    if (at == 0) {
      EXPECT_EQ(std::memcmp(run.data() + 4090, text.data(), text.size()), 0);
    }
  });
  EXPECT_EQ(runs, (decltype(runs){{0, 4 * 4096}, {far - 4000, 4100}}));
}

TEST(MemoryFile, HdfFilesFilledInByHandReadBack) {
  const decomp::Comm world(MPI_COMM_WORLD);
  const ScratchDirectory scratch(world);
  const fs::path path = scratch.path() / ("rank" + std::to_string(world.rank()) + ".h5");
  const std::string text(100000, 'x');
  const std::vector<DataSet> sets{{"a/b", Element::u64, 1000, 3, "m", "three"},
                                  {"none", Element::f64, 0, 1, "", ""},
                                  {"c", Element::u8, 77, 1, "", ""}};
  const std::vector<Extent> extents = lay_out(path, {{"long", text}, {"seven", std::int64_t{7}}}, sets);
  std::vector<std::uint64_t> values(3000);
  std::iota(values.begin(), values.end(), std::uint64_t{5});
  RowFile rows(path, sets, extents);
  rows.write(0, 600, 400, values.data() + 1800);
  rows.write(0, 0, 600, values.data());
  EXPECT_THROW(rows.write(0, 999, 2, values.data()), std::logic_error);
  rows.finish();
  const Hdf5Reader file(path);
  std::vector<std::uint64_t> back(3000);
  file.read("a/b", Element::u64, back.data());
  EXPECT_EQ(back, values);
  EXPECT_EQ(file.text("long"), text);
  EXPECT_EQ(file.integer("seven"), 7);
  EXPECT_EQ(file.rows("none"), 0U);
}

TEST(Trial, SaysWhatBecameOfTheCopy) {
  const decomp::Comm world(MPI_COMM_WORLD);
  if (world.size() > 1) GTEST_SKIP() << "for programs of one process";
  EXPECT_EQ(fate_in_a_copy([] {}), "");
  EXPECT_EQ(fate_in_a_copy([] { throw InputError("expected here too"); }), "");
  EXPECT_EQ(fate_in_a_copy([] { std::raise(SIGSEGV); }), "HDF5 crashes on it, signal 11");
  const auto spin = [] {
    while (getpid() > 0) continue;
  };
  EXPECT_EQ(fate_in_a_copy(spin, 1), "HDF5 does not come to an end with it");
}

}  // namespace
}  // namespace sph::test

#include <gtest/gtest.h>
#include <sys/resource.h>

#include <algorithm>
#include <array>
#include <csignal>
#include <fstream>
#include <sstream>

#include "sph/checkpoint/checkpoint.hpp"
#include "sph/core/error.hpp"
#include "sph/core/fingerprint.hpp"
#include "sph/inspect/inspect.hpp"
#include "sph/output/snapshot.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t count = 83;

std::string contents(const fs::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

void put(const fs::path& path, const std::string& text) {
  std::ofstream(path, std::ios::binary | std::ios::trunc) << text;
}

RunRecord record_of(std::int64_t step) {
  RunRecord record{make_global(), make_scale(), "name = \"t\\\"est\"\n", R"({"series_bytes": 17})"};
  record.global.step = step;
  record.global.max_speed = -0.0;
  record.global.fluid_volume = {std::int64_t{1} << 62, -7};
  record.global.motion = {{0.1, -0.0, 1e300}, 0.3, 0.7};
  record.global.max_acceleration = std::bit_cast<double>(std::uint64_t{0x7ff8dead0000beef});
  return record;
}

std::string print_of(const decomp::Comm& comm, const Particles& p, const RunRecord& record) {
  return fingerprint(comm, p, record.global, record.scale, make_wrap());
}

/// Order-free digest of who has which history.
std::uint64_t digest(const decomp::Comm& comm, const Particles& p, const decomp::Payload& history) {
  std::array<std::uint64_t, 1> sum{0};
  for (std::size_t row = 0; row < p.owned(); ++row) {
    std::uint64_t h = decomp::splitmix(p.data<Field::id>()[row]);
    for (std::uint64_t k = history.offset[row]; k < history.offset[row + 1]; ++k)
      h = decomp::splitmix(h ^ static_cast<std::uint64_t>(history.bytes[k]));
    sum[0] += h;
  }
  comm.sum(std::span<std::uint64_t>(sum));
  return sum[0];
}

void write(const decomp::Comm& comm, const fs::path& run, std::int64_t step, const Cut& cut = scattered,
           int files = 1) {
  const Particles p = make_state(comm, count, cut);
  const decomp::Payload history = make_history(p);
  const RunRecord record = record_of(step);
  write_checkpoint(comm, run, p, &history, record, make_wrap(), {"", print_of(comm, p, record), {"melt"}},
                   files);
}

/// Reads the newest checkpoint and expects it to be what write() wrote. Returns the step.
std::int64_t expect_good(const decomp::Comm& comm, const fs::path& run, std::string* warning = nullptr) {
  const CheckpointHandle handle = find_checkpoint(comm, run);
  if (warning != nullptr) *warning = handle.warning;
  const RunRecord expected = record_of(handle.record.global.step);
  GlobalState read = handle.record.global, wanted = expected.global;
  EXPECT_TRUE(read.throughput == wanted.throughput);
  read.throughput = Throughput{};  // the rest bit by bit
  wanted.throughput = Throughput{};
  EXPECT_EQ(std::memcmp(&read, &wanted, sizeof(GlobalState)), 0);
  EXPECT_EQ(handle.record.scale.quantum, expected.scale.quantum);
  EXPECT_EQ(handle.record.scale.origin, expected.scale.origin);
  EXPECT_EQ(handle.record.scene_toml, expected.scene_toml);
  EXPECT_EQ(handle.record.extra_json, expected.extra_json);

  Particles p(2, fluid_fields);
  decomp::Payload history;
  read_checkpoint(comm, handle, p, &history);
  EXPECT_EQ(history.rows(), p.owned());
  EXPECT_EQ(comm.sum(static_cast<std::int64_t>(p.owned())), static_cast<std::int64_t>(count));
  EXPECT_LE(p.owned(), count / static_cast<std::uint64_t>(comm.size()) + 1) << "rows are dealt evenly";
  const Particles whole = make_state(comm, count, round_robin);
  EXPECT_EQ(print_of(comm, p, handle.record), print_of(comm, whole, expected));
  EXPECT_EQ(digest(comm, p, history), digest(comm, whole, make_history(whole)));
  return handle.record.global.step;
}

std::string error_of_find(const decomp::Comm& comm, const fs::path& run) {
  try {
    (void)find_checkpoint(comm, run);
  } catch (const InputError& error) {
    return error.what();
  }
  return {};
}

class CheckpointTest : public ::testing::Test {
 protected:
  [[nodiscard]] fs::path dir_of(const std::string& name) const { return run_ / "checkpoint" / name; }
  [[nodiscard]] std::vector<std::string> directories() const {
    std::vector<std::string> names;
    for (const auto& entry : fs::directory_iterator(run_ / "checkpoint"))
      names.push_back(entry.path().filename());
    std::sort(names.begin(), names.end());
    world_.barrier();
    return names;
  }
  /// On rank 0 alone; afterwards all see it.
  void damage(const std::function<void()>& work) const {
    world_.barrier();
    if (world_.rank() == 0) work();
    world_.barrier();
  }

  decomp::Comm world_{MPI_COMM_WORLD};
  ScratchDirectory scratch_{world_};
  fs::path run_ = scratch_.path() / "run";
};

const std::string first_step = "000000000100";
const std::string second_step = "000000000200";

TEST_F(CheckpointTest, IsReadOnAnyNumberOfRanks) {
  for (int writers = 1; writers <= world_.size(); ++writers)
    for (int files = 1; files <= writers; ++files) {
      on_ranks(world_, writers, [&](const decomp::Comm& comm) { write(comm, run_, 100, scattered, files); });
      for (int readers = 1; readers <= world_.size(); ++readers)
        on_ranks(world_, readers, [&](const decomp::Comm& comm) {
          EXPECT_EQ(expect_good(comm, run_), 100) << writers << " writers, " << files << " files";
        });
      damage([&] { fs::remove_all(run_); });
    }
}

TEST_F(CheckpointTest, RanksWithoutParticlesAndNoParticlesAtAll) {
  write(world_, run_, 100, all_on_last, world_.size());
  EXPECT_EQ(expect_good(world_, run_), 100);
  const Particles none(2, fluid_fields);
  write_checkpoint(world_, run_, none, nullptr, record_of(200), make_wrap(), {}, 1);
  const CheckpointHandle handle = find_checkpoint(world_, run_);
  EXPECT_EQ(handle.record.global.step, 200);
  Particles back(2, fluid_fields);
  read_checkpoint(world_, handle, back, nullptr);
  EXPECT_EQ(back.owned(), 0U);
}

TEST_F(CheckpointTest, MoreRowsThanOneBlock) {
  constexpr std::uint64_t many = 150000;
  const Particles p = make_state(world_, many, all_on_last);
  const decomp::Payload history = make_history(p);
  write_checkpoint(world_, run_, p, &history, record_of(1), make_wrap(), {}, 0);
  const CheckpointHandle handle = find_checkpoint(world_, run_);
  Particles back(2, fluid_fields);
  decomp::Payload back_history;
  read_checkpoint(world_, handle, back, &back_history);
  EXPECT_EQ(print_of(world_, back, handle.record), print_of(world_, p, handle.record));
  EXPECT_EQ(digest(world_, back, back_history), digest(world_, p, history));
}

TEST_F(CheckpointTest, KeepsTheNewestTwo) {
  for (std::int64_t step : {100, 200, 300}) write(world_, run_, step);
  EXPECT_EQ(directories(), (std::vector<std::string>{second_step, "000000000300"}));
  EXPECT_EQ(expect_good(world_, run_), 300);
}

TEST_F(CheckpointTest, TheSameStepAgainReplacesOnlyWhenComplete) {
  write(world_, run_, 100);
  write(world_, run_, 200);
  write(world_, run_, 200);
  EXPECT_EQ(directories(), (std::vector<std::string>{first_step, second_step + ".1"}));
  EXPECT_EQ(expect_good(world_, run_), 200);
  write(world_, run_, 200);
  EXPECT_EQ(directories(), (std::vector<std::string>{first_step, second_step}));
  EXPECT_EQ(expect_good(world_, run_), 200);
}

TEST_F(CheckpointTest, ARunThatWentBackDropsTheFutureItDidNotTake) {
  for (std::int64_t step : {100, 200}) write(world_, run_, step);
  damage([&] { put(dir_of(second_step) / "part_0.h5", ""); });
  EXPECT_EQ(expect_good(world_, run_), 100);
  write(world_, run_, 150);
  EXPECT_EQ(directories(), (std::vector<std::string>{first_step, "000000000150"}));
}

TEST_F(CheckpointTest, AnyDamageIsSeenAndTheOlderOneTaken) {
  write(world_, run_, 100);
  write(world_, run_, 200, scattered, std::min(2, world_.size()));
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(dir_of(second_step))) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  world_.barrier();
  ASSERT_GE(files.size(), 2U);
  for (const fs::path& file : files) {
    const std::string good = contents(file);
    std::vector<std::pair<std::string, std::string>> bad{{"empty", ""},
                                                         {"truncated", good.substr(0, good.size() - 1)},
                                                         {"half", good.substr(0, good.size() / 2)},
                                                         {"longer", good + "x"}};
    for (std::size_t k = 0; k < 40; ++k) {
      const std::size_t at = k < 4 ? k : k < 8 ? good.size() - (k - 3) : decomp::splitmix(k) % good.size();
      std::string flipped = good;
      flipped[at] = static_cast<char>(flipped[at] ^ (1 << (decomp::splitmix(k) >> 32) % 8));
      bad.emplace_back("bit at " + std::to_string(at), flipped);
    }
    for (const auto& [name, text] : bad) {
      damage([&] { put(file, text); });
      std::string warning;
      EXPECT_EQ(expect_good(world_, run_, &warning), 100) << file << " " << name;
      EXPECT_NE(warning.find(second_step), std::string::npos) << file << " " << name << ": " << warning;
    }
    damage([&] { fs::remove(file); });
    std::string warning;
    EXPECT_EQ(expect_good(world_, run_, &warning), 100) << file << " missing";
    EXPECT_FALSE(warning.empty());
    damage([&] { put(file, good); });
    EXPECT_EQ(expect_good(world_, run_, &warning), 200);
    EXPECT_EQ(warning, "");
  }
}

TEST_F(CheckpointTest, NoUsableOneIsAnErrorThatNamesEach) {
  std::string text = error_of_find(world_, run_);
  EXPECT_NE(text.find("there is no checkpoint in"), std::string::npos) << text;
  write(world_, run_, 100);
  write(world_, run_, 200);
  damage([&] {
    put(dir_of(first_step) / "manifest.json", "{}");
    fs::resize_file(dir_of(second_step) / "part_0.h5", 1000);
  });
  text = error_of_find(world_, run_);
  for (const std::string& part : {first_step, second_step, std::string("part_0.h5 has 1000 bytes"),
                                  std::string("manifest.json is damaged")})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in " << text;
  EXPECT_EQ(text, world_.broadcast(text, 0));
}

TEST_F(CheckpointTest, LeftoversOfAnInterruptedWriteAreIgnoredAndRemoved) {
  write(world_, run_, 100);
  damage([&] {
    fs::copy(dir_of(first_step), dir_of(second_step));
    fs::rename(dir_of(second_step) / "manifest.json", dir_of(second_step) / "manifest.json.tmp");
    fs::create_directory(dir_of("000000000050"));
    fs::create_directory(dir_of("notes"));
  });
  EXPECT_EQ(expect_good(world_, run_), 100);
  write(world_, run_, 200);
  EXPECT_EQ(directories(), (std::vector<std::string>{first_step, second_step, "notes"}));
  EXPECT_FALSE(fs::exists(dir_of(second_step) / "manifest.json.tmp"));
  EXPECT_EQ(expect_good(world_, run_), 200);
}

TEST_F(CheckpointTest, AFullDiskIsAnErrorAndTheOldOneStays) {
  write(world_, run_, 100);
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  for (const rlim_t limit : {rlim_t{0}, rlim_t{5000}, rlim_t{60000}}) {
    rlimit low = old;
    low.rlim_cur = limit;
    setrlimit(RLIMIT_FSIZE, &low);
    std::string text;
    try {
      const Particles p = make_state(world_, 5000, round_robin);
      write_checkpoint(world_, run_, p, nullptr, record_of(200), make_wrap(), {}, world_.size());
    } catch (const OutputError& error) {
      text = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_NE(text.find("File too large"), std::string::npos) << text;
    EXPECT_NE(text.find("step 200"), std::string::npos) << text;
    EXPECT_EQ(text, world_.broadcast(text, 0));
    EXPECT_EQ(directories(), std::vector<std::string>{first_step});
    EXPECT_EQ(expect_good(world_, run_), 100);
  }
}

TEST_F(CheckpointTest, RefusesAStateOfAnotherScene) {
  write(world_, run_, 100);
  const CheckpointHandle handle = find_checkpoint(world_, run_);
  decomp::Payload history;
  Particles solid(3, fluid_fields);
  EXPECT_THROW(read_checkpoint(world_, handle, solid, &history), InputError);
  Particles more(2, fluid_fields | FieldSet{Field::gas_content});
  EXPECT_THROW(read_checkpoint(world_, handle, more, &history), InputError);
  Particles fewer(2, fluid_fields.without({Field::stress}));
  EXPECT_THROW(read_checkpoint(world_, handle, fewer, &history), InputError);
  Particles same(2, fluid_fields);
  EXPECT_THROW(read_checkpoint(world_, handle, same, nullptr), InputError);
}

TEST_F(CheckpointTest, FirstDifferenceTakesRunsStepsAndSnapshots) {
  const fs::path other = scratch_.path() / "other";
  write(world_, run_, 100, scattered);
  write(world_, other, 100, round_robin, world_.size());
  EXPECT_EQ(first_difference(run_, other), "");
  EXPECT_EQ(first_difference(dir_of(first_step), other), "");
  const Particles p = make_state(world_, count, scattered);
  const RunRecord record = record_of(100);
  write_snapshot(world_, scratch_.path() / "a.h5", p, record.global, record.scale, make_wrap(),
                 {"", print_of(world_, p, record), {}}, {}, 1000);
  EXPECT_EQ(first_difference(run_, scratch_.path() / "a.h5"), "");
  EXPECT_NE(describe(run_).find(print_of(world_, p, record)), std::string::npos);
  EXPECT_NE(describe(run_).find("contact history"), std::string::npos);

  Particles q = make_state(world_, count, scattered);
  decomp::Payload history = make_history(q);
  for (std::size_t row = 0; row < q.owned(); ++row)
    if (q.data<Field::id>()[row] == nth_id(20)) q.data<Field::group>()[row] = 77;
  write_checkpoint(world_, other, q, &history, record, make_wrap(), {}, 1);
  std::string text = first_difference(other, run_);
  EXPECT_EQ(text.rfind("particle " + std::to_string(nth_id(20)) + ": group: 77 != ", 0), 0U) << text;

  if (!history.bytes.empty()) history.bytes.back() ^= std::byte{1};
  write_checkpoint(world_, other, p, &history, record, make_wrap(), {}, 1);
  text = first_difference(other, run_);
  EXPECT_NE(text.find("contact history"), std::string::npos) << text;
  write(world_, other, 300);
  EXPECT_EQ(first_difference(other, run_), "step: 300 != 100");
  EXPECT_THROW((void)first_difference(run_, scratch_.path() / "missing"), InputError);
}

}  // namespace
}  // namespace sph::test

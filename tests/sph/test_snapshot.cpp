#include <gtest/gtest.h>
#include <sys/resource.h>

#include <csignal>
#include <cstring>
#include <fstream>
#include <sstream>

#include "files/hdf5_file.hpp"  // private: the tests look at what is on disk
#include "sph/core/error.hpp"
#include "sph/core/fingerprint.hpp"
#include "sph/inspect/inspect.hpp"
#include "sph/output/snapshot.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

constexpr std::uint64_t count = 97;
constexpr std::int64_t sort_always = 1000000;

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

/// All values of a data set, whatever their type.
std::vector<double> read(const std::filesystem::path& path, const std::string& name) {
  const Hdf5Reader file(path);
  std::vector<double> values(file.rows(name) * static_cast<std::size_t>(file.components(name)));
  if (!values.empty()) file.read(name, Element::f64, values.data());
  return values;
}

Provenance provenance(const decomp::Comm& comm, const Particles& p) {
  return {"title = \"test\"\n",
          fingerprint(comm, p, make_global(), make_scale(), make_wrap()),
          {"melt", "wall", "spray"}};
}

std::vector<ExtraColumn> extra_of(const Particles& p) {
  ExtraColumn mean{"mean_velocity", "m/s", 2, {}};
  for (std::size_t row = 0; row < p.owned(); ++row)
    for (int c = 0; c < 2; ++c)
      mean.values.push_back(static_cast<double>(p.data<Field::id>()[row]) + 0.5 * c);
  return {mean};
}

void write(const decomp::Comm& comm, const std::filesystem::path& path, const Particles& p,
           std::int64_t sort_limit = sort_always) {
  write_snapshot(comm, path, p, make_global(), make_scale(), make_wrap(), provenance(comm, p), extra_of(p),
                 sort_limit);
}

class SnapshotTest : public ::testing::Test {
 protected:
  decomp::Comm world_{MPI_COMM_WORLD};
  ScratchDirectory scratch_{world_};
  std::filesystem::path dir_ = scratch_.path();
};

TEST_F(SnapshotTest, HasTheSameBytesForAnyRanksAndCuts) {
  write(world_, dir_ / "a.h5", make_state(world_, count, round_robin));
  write(world_, dir_ / "b.h5", make_state(world_, count, scattered));
  write(world_, dir_ / "c.h5", make_state(world_, count, all_on_last));
  const std::string expected = contents(dir_ / "a.h5");
  EXPECT_TRUE(contents(dir_ / "b.h5") == expected);
  EXPECT_TRUE(contents(dir_ / "c.h5") == expected);
  for (int ranks = 1; ranks < world_.size(); ++ranks)
    on_ranks(world_, ranks, [&](const decomp::Comm& comm) {
      write(comm, dir_ / "d.h5", make_state(comm, count, scattered));
      EXPECT_TRUE(contents(dir_ / "d.h5") == expected) << ranks << " ranks";
    });
}

TEST_F(SnapshotTest, HoldsTheValuesSortedById) {
  const Particles p = make_state(world_, count, scattered);
  write(world_, dir_ / "a.h5", p);
  const std::vector<double> id = read(dir_ / "a.h5", "particles/id");
  ASSERT_EQ(id.size(), count);
  for (std::uint64_t n = 0; n < count; ++n) EXPECT_EQ(id[n], static_cast<double>(nth_id(n)));
  const std::vector<double> metres = read(dir_ / "a.h5", "particles/position");
  const std::vector<double> quanta = read(dir_ / "a.h5", "particles/position_quanta");
  const std::vector<double> mean = read(dir_ / "a.h5", "particles/mean_velocity");
  ASSERT_EQ(metres.size(), 2 * count);
  ASSERT_EQ(quanta.size(), 2 * count);
  ASSERT_EQ(mean.size(), 2 * count);
  for (std::size_t k = 0; k < metres.size(); ++k) {
    EXPECT_EQ(metres[k], quanta[k] * make_scale().quantum);
    EXPECT_EQ(mean[k], id[k / 2] + 0.5 * static_cast<double>(k % 2));
  }
  for (std::size_t k = 0; k < quanta.size(); k += 2) {
    EXPECT_GE(quanta[k], -100);
    EXPECT_LT(quanta[k], 300) << "not wrapped";
  }
}

TEST_F(SnapshotTest, KeepsOwnerOrderAboveTheLimit) {
  const Particles p = make_state(world_, count, all_on_last);
  write(world_, dir_ / "a.h5", p, static_cast<std::int64_t>(count) - 1);
  const std::vector<double> id = read(dir_ / "a.h5", "particles/id");
  ASSERT_EQ(id.size(), count);
  EXPECT_EQ(id.front(), static_cast<double>(nth_id(count - 1)));
  write(world_, dir_ / "b.h5", p);
  EXPECT_EQ(first_difference(dir_ / "a.h5", dir_ / "b.h5"), "") << "rows are matched by id";
}

TEST_F(SnapshotTest, TakesExtremeIdsAndNoParticles) {
  Particles p(3, {Field::id, Field::position, Field::density});
  if (world_.rank() == world_.size() - 1) {
    p.table().resize(2, 0);
    fill_row(p, 0, std::numeric_limits<std::uint64_t>::max());
    fill_row(p, 1, 0);
  }
  write_snapshot(world_, dir_ / "a.h5", p, {}, {}, {}, {}, {}, sort_always);
  EXPECT_EQ(read(dir_ / "a.h5", "particles/id").front(), 0);
  p.table().resize(0, 0);
  write_snapshot(world_, dir_ / "b.h5", p, {}, {}, {}, {}, {}, sort_always);
  EXPECT_EQ(read(dir_ / "b.h5", "particles/id").size(), 0U);
  EXPECT_EQ(first_difference(dir_ / "b.h5", dir_ / "b.h5"), "");
}

TEST_F(SnapshotTest, FirstDifferenceNamesLowestIdAndField) {
  Particles p = make_state(world_, count, round_robin);
  write(world_, dir_ / "a.h5", p);
  EXPECT_EQ(first_difference(dir_ / "a.h5", dir_ / "a.h5"), "");
  for (std::size_t row = 0; row < p.owned(); ++row) {
    const std::uint64_t id = p.data<Field::id>()[row];
    if (id == nth_id(50)) p.data<Field::velocity>()[2 * row] = 99;
    if (id == nth_id(40)) p.data<Field::velocity>()[2 * row + 1] = 3.125;
  }
  write(world_, dir_ / "b.h5", p);
  const std::string text = first_difference(dir_ / "a.h5", dir_ / "b.h5");
  EXPECT_EQ(text.rfind("particle " + std::to_string(nth_id(40)) + ": velocity[1]: ", 0), 0U) << text;
  EXPECT_NE(text.find("!= 0x1.9p+1 (3.125)"), std::string::npos) << text;
}

// A row of melts is one of their cells unless it is a grain.
TEST_F(SnapshotTest, FirstDifferenceSaysWhereACellIs) {
  /// The row `changed` is that of a cell (0) or of a grain (1), or none.
  const auto write_rows = [&](const char* name, std::size_t changed) {
    Particles p(2, {Field::id, Field::position, Field::radius, Field::flow_pressure});
    p.table().resize(world_.rank() == 0 ? 2 : 0, 0);
    for (std::size_t row = 0; row < p.owned(); ++row) {
      fill_row(p, row, row + 7);
      p.data<Field::position>()[2 * row] = 1 << 19;
      p.data<Field::position>()[2 * row + 1] = 1 << 18;
      p.data<Field::radius>()[row] = static_cast<double>(row);
      if (row == changed) p.data<Field::flow_pressure>()[row] = 0.125;
    }
    write_snapshot(world_, dir_ / name, p, {}, make_scale(), {}, {}, {}, sort_always);
  };
  const auto difference = [&](std::size_t row) {
    write_rows("a.h5", 2);
    write_rows("b.h5", row);
    return first_difference(dir_ / "a.h5", dir_ / "b.h5");
  };
  const std::string of_cell = difference(0), of_grain = difference(1);
  EXPECT_EQ(of_cell.rfind("cell 7 at (0.5, 0.25) m: flow_pressure: ", 0), 0U) << of_cell;
  EXPECT_EQ(of_grain.rfind("particle 8: flow_pressure: ", 0), 0U) << of_grain;
}

TEST_F(SnapshotTest, FirstDifferenceSeesMissingParticlesSignOfZeroAndGlobalValues) {
  const Particles p = make_state(world_, count, round_robin);
  write(world_, dir_ / "a.h5", p);
  write(world_, dir_ / "b.h5", make_state(world_, count - 1, round_robin));
  std::string text = first_difference(dir_ / "a.h5", dir_ / "b.h5");
  EXPECT_NE(text.find("particle " + std::to_string(nth_id(count - 1))), std::string::npos) << text;
  EXPECT_NE(text.find("only in"), std::string::npos) << text;

  GlobalState plus = make_global();
  GlobalState minus = make_global();
  plus.max_speed = 0.0;
  minus.max_speed = -0.0;
  write_snapshot(world_, dir_ / "c.h5", p, plus, make_scale(), make_wrap(), {}, {}, sort_always);
  write_snapshot(world_, dir_ / "d.h5", p, minus, make_scale(), make_wrap(), {}, {}, sort_always);
  text = first_difference(dir_ / "c.h5", dir_ / "d.h5");
  EXPECT_EQ(text, "max_speed: 0x0p+0 (0) != -0x0p+0 (-0)");
}

TEST_F(SnapshotTest, FirstDifferenceSeesStateThatIsNotInTheFile) {
  const Particles p = make_state(world_, count, round_robin);
  Provenance from = provenance(world_, p);
  write_snapshot(world_, dir_ / "a.h5", p, make_global(), make_scale(), make_wrap(), from, {}, sort_always);
  from.fingerprint.front() = from.fingerprint.front() == '0' ? '1' : '0';
  write_snapshot(world_, dir_ / "b.h5", p, make_global(), make_scale(), make_wrap(), from, {}, sort_always);
  const std::string text = first_difference(dir_ / "a.h5", dir_ / "b.h5");
  EXPECT_EQ(text.rfind("fingerprint", 0), 0U) << text;
}

TEST_F(SnapshotTest, DescribeSaysWhatItIs) {
  const Particles p = make_state(world_, count, round_robin);
  write(world_, dir_ / "a.h5", p);
  const std::string text = describe(dir_ / "a.h5");
  for (const std::string& part : {std::string("1200"), std::string("97"), std::string("velocity"),
                                  provenance(world_, p).fingerprint, std::string("test")})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  EXPECT_THROW((void)describe(dir_ / "missing.h5"), InputError);
  if (world_.rank() == 0) std::ofstream(dir_ / "other.h5") << "not HDF5";
  world_.barrier();
  EXPECT_THROW((void)describe(dir_ / "other.h5"), InputError);
  EXPECT_THROW((void)describe(dir_), InputError);
}

TEST_F(SnapshotTest, FailsOnEveryRankWithOneTextAndLeavesNothing) {
  const Particles p = make_state(world_, count, round_robin);
  std::string text;
  try {
    write(world_, dir_ / "missing" / "a.h5", p);
  } catch (const OutputError& error) {
    text = error.what();
  }
  EXPECT_NE(text.find("a.h5"), std::string::npos) << text;
  EXPECT_NE(text.find("No such file or directory"), std::string::npos) << text;
  EXPECT_EQ(text, world_.broadcast(text, 0));
}

TEST_F(SnapshotTest, AFullDiskIsAnErrorAndTheOldFileStays) {
  const Particles p = make_state(world_, 20000, round_robin);
  write(world_, dir_ / "a.h5", make_state(world_, count, round_robin));
  const std::string before = contents(dir_ / "a.h5");
  // The nearest thing to a full disk without a file system of one's own: no file may grow beyond this.
  std::signal(SIGXFSZ, SIG_IGN);
  rlimit old{};
  getrlimit(RLIMIT_FSIZE, &old);
  for (const rlim_t limit : {rlim_t{100}, rlim_t{3000}, rlim_t{300000}}) {
    rlimit low = old;
    low.rlim_cur = limit;
    setrlimit(RLIMIT_FSIZE, &low);
    std::string text;
    try {
      write(world_, dir_ / "a.h5", p);
    } catch (const OutputError& error) {
      text = error.what();
    }
    setrlimit(RLIMIT_FSIZE, &old);
    EXPECT_NE(text.find("File too large"), std::string::npos) << text;
    EXPECT_EQ(text, world_.broadcast(text, 0));
    EXPECT_TRUE(contents(dir_ / "a.h5") == before);
    EXPECT_FALSE(std::filesystem::exists(dir_ / "a.h5.tmp"));
  }
  write(world_, dir_ / "a.h5", p);
  EXPECT_EQ(read(dir_ / "a.h5", "particles/id").size(), 20000U);
}

TEST_F(SnapshotTest, ShowsCellsAsAMeshAndTheRestAsParticles) {
  const auto rows = static_cast<std::int64_t>(count);
  CellMesh mesh{{6, 4, 1}, {1, 2, 0}, {0.5, 0.25, 1}, {Field::pressure}, {Field::id, Field::velocity}};
  write_snapshot(world_, dir_ / "a.h5", make_state(world_, count, scattered), make_global(), make_scale(),
                 make_wrap(), {}, {}, sort_always, {}, mesh);
  const Hdf5Reader file(dir_ / "a.h5");
  using Extent = std::vector<std::uint64_t>;
  EXPECT_EQ(file.stored_as("cells/pressure").extent, (Extent{1, 4, 6}));
  EXPECT_EQ(file.stored_as("cells/position").extent, (Extent{1, 4, 6, 2}));
  EXPECT_EQ(file.stored_as("others/velocity").extent, (Extent{count - 24, 2}));
  EXPECT_EQ(file.text_of("cells/pressure", "unit"), "Pa");
  EXPECT_FALSE(file.has("cells/velocity") || file.has("others/pressure"));
  const auto same = [&](const std::string& view, const std::string& set, std::uint64_t first) {
    const std::vector<double> whole = read(dir_ / "a.h5", set);
    std::vector<double> part(whole.size());
    file.read(view, Element::f64, part.data());
    std::uint64_t size = 1;
    for (std::uint64_t n : file.stored_as(view).extent) size *= n;
    EXPECT_EQ(std::memcmp(part.data(), whole.data() + first, size * sizeof(double)), 0) << view;
  };
  same("cells/pressure", "particles/pressure", 0);
  same("cells/position", "particles/position", 0);
  same("others/id", "particles/id", 24);
  same("others/velocity", "particles/velocity", 48);
  same("others/position", "particles/position", 48);
  same("others/vertex", "vertex", 0);

  const auto path = dir_ / ("mesh" + std::to_string(world_.rank()) + ".xdmf");
  write_xdmf(path, {{"a.h5", 0, 0, rows}}, make_state(world_, count, round_robin), {}, mesh);
  const std::string text = contents(path);
  for (const char* part :
       {"TopologyType=\"3DCoRectMesh\" Dimensions=\"2 5 7\"", ">-0.5 2 1</DataItem>",
        ">0.5 0.25 0.5</DataItem>",
        "Dimensions=\"1 4 6\" NumberType=\"Float\" Precision=\"8\">a.h5:/cells/pressure",
        "Polyvertex\" NumberOfElements=\"73\"", "Dimensions=\"73 2\"", "a.h5:/others/vertex"})
    EXPECT_NE(text.find(part), std::string::npos) << part << " in\n" << text;
  mesh.cells = {97, 1, 1};
  write_xdmf(path, {{"a.h5", 0, 0, rows}}, make_state(world_, count, round_robin), {}, mesh);
  EXPECT_EQ(contents(path).find("Polyvertex"), std::string::npos) << "all rows are cells";
}

TEST_F(SnapshotTest, XdmfPointsIntoTheFiles) {
  const Particles p = make_state(world_, count, round_robin);
  const auto path = dir_ / ("particles" + std::to_string(world_.rank()) + ".xdmf");
  write_xdmf(path, {{"a&b.h5", 0, 0, 97}, {"snapshot_1.h5", 1200, 0.1, 97}}, p, extra_of(p));
  const std::string text = contents(path);
  for (const char* part :
       {"CollectionType=\"Temporal\"", "Polyvertex", "<Time Value=\"0.1\"/>", "GeometryType=\"XY\"",
        "snapshot_1.h5:/particles/position</DataItem>", "a&amp;b.h5:/particles/velocity",
        "Dimensions=\"97 2\"", "mean_velocity", "snapshot_1.h5:/particles/pressure"})
    EXPECT_NE(text.find(part), std::string::npos) << part;
  EXPECT_EQ(text.find("volume"), std::string::npos);
  EXPECT_THROW(write_xdmf(dir_ / "missing" / "x.xdmf", {}, p, {}), OutputError);
}

}  // namespace
}  // namespace sph::test

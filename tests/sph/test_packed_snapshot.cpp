// Compressed snapshots hold the bits of others, in the same bytes on any number of ranks.
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>
#include <sstream>

#include "files/hdf5_file.hpp"  // private: the tests look at what is on disk
#include "files/packed_rows.hpp"
#include "sph/core/error.hpp"
#include "sph/core/fingerprint.hpp"
#include "sph/inspect/inspect.hpp"
#include "sph/output/snapshot.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

constexpr std::uint64_t many = 3 * chunk_rows + 1234;  ///< four chunks, of which the last is not full
constexpr std::int64_t sort_always = 1000000, sort_never = 0;

std::string contents(const std::filesystem::path& path) {
  std::ifstream in(path, std::ios::binary);
  std::ostringstream out;
  out << in.rdbuf();
  return out.str();
}

void write(const decomp::Comm& comm, const std::filesystem::path& path, const Particles& p, int compression,
           std::int64_t sort_limit = sort_always, const std::optional<CellMesh>& mesh = {}) {
  ContactColumns contacts;
  for (std::size_t row = 0; row < p.owned(); ++row) {
    if (p.data<Field::id>()[row] % 4 != 3) continue;
    contacts.id.push_back(p.data<Field::id>()[row]);
    contacts.partner.push_back(contacts.id.back() + 1);
    for (int a = 0; a < 3; ++a) contacts.point.push_back(static_cast<double>(contacts.id.back()) / 7 + a);
    contacts.force.insert(contacts.force.end(), 3, -0.0);
    contacts.overlap.push_back(1e-9);
  }
  write_snapshot(
      comm, path, p, make_global(), make_scale(), make_wrap(),
      {"title = \"packed\"\n", fingerprint(comm, p, make_global(), make_scale(), make_wrap()), {"melt"}}, {},
      sort_limit, std::move(contacts), mesh, compression);
}

class PackedSnapshot : public ::testing::Test {
 protected:
  decomp::Comm world_{MPI_COMM_WORLD};
  ScratchDirectory scratch_{world_};
  std::filesystem::path dir_ = scratch_.path();
};

/// Bit for bit, NaN included.
void expect_the_same(const std::filesystem::path& packed, const std::filesystem::path& plain) {
  const Hdf5Reader a(packed), b(plain);
  for (const char* name :
       {"particles/id", "particles/position", "particles/position_quanta", "particles/velocity",
        "particles/stress", "particles/pressure", "particles/mass", "vertex", "contacts/id",
        "contacts/partner", "contacts/point", "contacts/force", "contacts/overlap"}) {
    const StoredAs of = a.stored_as(name);
    EXPECT_EQ(of.type, b.stored_as(name).type) << name;
    EXPECT_EQ(of.extent, b.stored_as(name).extent) << name;
    const Element element = of.numbers == StoredAs::Numbers::real ? Element::f64
                            : of.with_sign                        ? Element::i64
                                                                  : Element::u64;
    std::vector<std::uint64_t> x(a.rows(name) * static_cast<std::size_t>(a.components(name))), y(x.size(), 1);
    a.read(name, element, x.data());
    b.read(name, element, y.data());
    EXPECT_TRUE(x == y) << name;
  }
}

TEST_F(PackedSnapshot, HoldsTheBitsOfAnother) {
  const Particles p = make_state(world_, many, scattered);
  write(world_, dir_ / "plain.h5", p, 0);
  for (int level : {1, 6, 9}) {
    write(world_, dir_ / "packed.h5", p, level);
    expect_the_same(dir_ / "packed.h5", dir_ / "plain.h5");
    EXPECT_EQ(first_difference(dir_ / "packed.h5", dir_ / "plain.h5"), "");
    EXPECT_LT(std::filesystem::file_size(dir_ / "packed.h5"), std::filesystem::file_size(dir_ / "plain.h5"));
  }
  std::string packed = describe(dir_ / "packed.h5"), plain = describe(dir_ / "plain.h5");
  EXPECT_EQ(packed.substr(packed.find('\n')), plain.substr(plain.find('\n')));
}

TEST_F(PackedSnapshot, HasTheSameBytesForAnyRanksAndCuts) {
  write(world_, dir_ / "a.h5", make_state(world_, many, round_robin), 4);
  write(world_, dir_ / "b.h5", make_state(world_, many, all_on_last), 4);
  const std::string expected = contents(dir_ / "a.h5");
  EXPECT_TRUE(contents(dir_ / "b.h5") == expected);
  for (int ranks = 1; ranks < world_.size(); ++ranks)
    on_ranks(world_, ranks, [&](const decomp::Comm& comm) {
      write(comm, dir_ / "c.h5", make_state(comm, many, scattered), 4);
      EXPECT_TRUE(contents(dir_ / "c.h5") == expected) << ranks << " ranks";
    });
}

TEST_F(PackedSnapshot, KeepsOwnerOrderAboveTheLimit) {
  for (const Cut& cut : {Cut(round_robin), Cut(all_on_last), Cut([](std::uint64_t n, int ranks) {
                           return n < chunk_rows / 2 ? 0 : n < 2 * chunk_rows ? ranks / 2 : ranks - 1;
                         })}) {
    const Particles p = make_state(world_, many, cut);
    write(world_, dir_ / "plain.h5", p, 0, sort_never);
    write(world_, dir_ / "packed.h5", p, 1, sort_never);
    expect_the_same(dir_ / "packed.h5", dir_ / "plain.h5");
  }
}

TEST_F(PackedSnapshot, TakesFewAndNoParticles) {
  for (std::uint64_t rows : {std::uint64_t{0}, std::uint64_t{1}, std::uint64_t{97}, chunk_rows}) {
    const Particles p = make_state(world_, rows, scattered);
    write(world_, dir_ / "plain.h5", p, 0);
    write(world_, dir_ / "packed.h5", p, 9);
    expect_the_same(dir_ / "packed.h5", dir_ / "plain.h5");
  }
}

TEST_F(PackedSnapshot, ShowsCellsAsAMesh) {
  const CellMesh mesh{
      {600, 40, 1}, {1, 2, 0}, {0.5, 0.25, 1}, {Field::pressure}, {Field::id, Field::velocity}};
  const Particles p = make_state(world_, many, scattered);
  write(world_, dir_ / "plain.h5", p, 0, sort_always, mesh);
  write(world_, dir_ / "packed.h5", p, 4, sort_always, mesh);
  const Hdf5Reader a(dir_ / "packed.h5"), b(dir_ / "plain.h5");
  for (const char* name : {"cells/pressure", "others/velocity", "others/vertex"}) {
    EXPECT_EQ(a.stored_as(name).extent, b.stored_as(name).extent);
    std::uint64_t size = 1;
    for (std::uint64_t n : a.stored_as(name).extent) size *= n;
    const Element element =
        a.stored_as(name).numbers == StoredAs::Numbers::real ? Element::f64 : Element::u64;
    std::vector<std::uint64_t> x(size), y(size, 1);
    a.read(name, element, x.data());
    b.read(name, element, y.data());
    EXPECT_TRUE(x == y) << name;
  }
}

TEST_F(PackedSnapshot, FailsOnEveryRankAndLeavesNothing) {
  std::string text;
  try {
    write(world_, dir_ / "missing" / "a.h5", make_state(world_, many, round_robin), 4);
  } catch (const OutputError& error) {
    text = error.what();
  }
  EXPECT_NE(text.find("No such file or directory"), std::string::npos) << text;
  EXPECT_EQ(text, world_.broadcast(text, 0));
}

}  // namespace
}  // namespace sph::test

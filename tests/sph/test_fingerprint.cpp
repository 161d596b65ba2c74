#include <gtest/gtest.h>

#include <cmath>
#include <numeric>

#include "sph/core/fingerprint.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

constexpr std::uint64_t count = 101;

std::string print_of(const decomp::Comm& comm, const Particles& p, const GlobalState& g = make_global()) {
  return fingerprint(comm, p, g, make_scale(), make_wrap());
}

/// Flips one bit of the owned row of particle nth_id(n), on the rank that has it.
void flip(Particles& p, Field f, std::uint64_t n, std::size_t bit) {
  for (std::size_t row = 0; row < p.owned(); ++row)
    if (p.data<Field::id>()[row] == nth_id(n)) {
      decomp::Column& column = p.table().column(p.column(f));
      column.data()[row * column.width() + bit / 8] ^= static_cast<std::byte>(1U << (bit % 8));
    }
}

TEST(Fingerprint, IsThirtyTwoHexadecimalDigits) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const std::string print = print_of(comm, make_state(comm, count, round_robin));
  EXPECT_EQ(print.size(), 32U);
  EXPECT_EQ(print.find_first_not_of("0123456789abcdef"), std::string::npos);
}

TEST(Fingerprint, DoesNotDependOnRanksCutsOrOrder) {
  const decomp::Comm world(MPI_COMM_WORLD);
  const std::string expected = print_of(world, make_state(world, count, round_robin));
  EXPECT_EQ(print_of(world, make_state(world, count, scattered)), expected);
  EXPECT_EQ(print_of(world, make_state(world, count, all_on_last)), expected);
  for (int ranks = 1; ranks <= world.size(); ++ranks)
    on_ranks(world, ranks, [&](const decomp::Comm& comm) {
      EXPECT_EQ(print_of(comm, make_state(comm, count, scattered)), expected) << ranks << " ranks";
    });

  Particles shuffled = make_state(world, count, round_robin);
  std::vector<std::uint32_t> order(shuffled.owned());
  std::iota(order.rbegin(), order.rend(), 0U);
  shuffled.table().reorder(order);
  EXPECT_EQ(print_of(world, shuffled), expected);
}

TEST(Fingerprint, ChangesWithAnyBitOfTheStateAndOfNothingElse) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Particles p = make_state(comm, count, round_robin);
  const std::string before = print_of(comm, p);
  for (Field f : p.fields().list()) {
    if (f == Field::id || f == Field::position) continue;
    for (std::size_t bit = 0; bit < 8 * width(f, p.dim()); bit += 5) {
      flip(p, f, 17, bit);
      EXPECT_EQ(print_of(comm, p) != before, info(f).state) << info(f).name << " bit " << bit;
      flip(p, f, 17, bit);
    }
  }
  flip(p, Field::id, 17, 0);
  EXPECT_NE(print_of(comm, p), before);
}

TEST(Fingerprint, ChangesWithEveryGlobalValue) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const Particles p = make_state(comm, count, round_robin);
  const std::string before = print_of(comm, p);
  GlobalState g = make_global();
  g.step += 1;
  EXPECT_NE(print_of(comm, p, g), before);
  for (double GlobalState::*member :
       {&GlobalState::time, &GlobalState::dt, &GlobalState::max_speed, &GlobalState::max_acceleration}) {
    g = make_global();
    g.*member = std::nextafter(g.*member, 1e9);
    EXPECT_NE(print_of(comm, p, g), before);
  }
  g = make_global();
  g.fluid_volume.start = 1;
  EXPECT_NE(print_of(comm, p, g), before);
  g = make_global();
  g.motion.velocity[2] = 1;
  EXPECT_NE(print_of(comm, p, g), before);
  g = make_global();
  g.motion.unlike = 1;
  EXPECT_NE(print_of(comm, p, g), before);
  g = make_global();
  g.motion.largest = 1;
  EXPECT_NE(print_of(comm, p, g), before);
  PositionScale scale = make_scale();
  scale.quantum /= 2;
  EXPECT_NE(fingerprint(comm, p, make_global(), scale, make_wrap()), before);

  GlobalState plus = make_global();
  GlobalState minus = make_global();
  plus.max_speed = 0.0;
  minus.max_speed = -0.0;
  EXPECT_NE(print_of(comm, p, plus), print_of(comm, p, minus));
}

TEST(Fingerprint, TakesWrappedPositions) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Particles p = make_state(comm, count, round_robin);
  const std::string before = print_of(comm, p);
  const Wrap wrap = make_wrap();
  for (std::size_t row = 0; row < p.owned(); ++row)
    p.data<Field::position>()[2 * row] += (row % 2 == 0 ? 3 : -3) * wrap.period[0];
  EXPECT_EQ(print_of(comm, p), before);
  if (p.owned() > 0) p.data<Field::position>()[1] += 1;  // not periodic along y
  EXPECT_NE(print_of(comm, p), before);
}

TEST(Fingerprint, TellsParticlesThatSwapTheirState) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Particles p = make_state(comm, count, all_on_last);
  const std::string before = print_of(comm, p);
  if (p.owned() > 0) std::swap(p.data<Field::id>()[0], p.data<Field::id>()[1]);
  EXPECT_NE(print_of(comm, p), before);
}

}  // namespace
}  // namespace sph::test

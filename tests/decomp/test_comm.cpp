#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <numeric>

#include "decomp/combined_reduction.hpp"

namespace {

using decomp::Comm;

TEST(Comm, duplicates_its_parent) {
  const Comm comm(MPI_COMM_WORLD);
  int size = 0, relation = MPI_UNEQUAL;
  MPI_Comm_size(MPI_COMM_WORLD, &size);
  MPI_Comm_compare(comm.get(), MPI_COMM_WORLD, &relation);
  EXPECT_EQ(comm.size(), size);
  EXPECT_EQ(relation, MPI_CONGRUENT);
}

TEST(Comm, turns_errors_into_exceptions_that_name_the_call) {
  const Comm comm(MPI_COMM_WORLD);
  std::byte b{};
  try {
    comm.broadcast(std::span(&b, 1), comm.size());  // no such root
    FAIL() << "no exception";
  } catch (const std::runtime_error& e) {
    EXPECT_NE(std::string(e.what()).find("MPI_Bcast: MPI_ERR_ROOT"), std::string::npos) << e.what();
  }
}

TEST(Comm, reduces_integers) {
  const Comm comm(MPI_COMM_WORLD);
  const std::int64_t r = comm.rank(), n = comm.size();
  std::vector<std::int64_t> most{r, -r, 7}, total{r, 1, -r};
  comm.max(most);
  comm.sum(total);
  EXPECT_EQ(most, (std::vector<std::int64_t>{n - 1, 0, 7}));
  EXPECT_EQ(total, (std::vector<std::int64_t>{n * (n - 1) / 2, n, -n * (n - 1) / 2}));
  EXPECT_EQ(comm.max(r), n - 1);
  EXPECT_EQ(comm.sum(std::int64_t{1}), n);
  EXPECT_EQ(comm.exclusive_sum(r + 1), r * (r + 1) / 2);

  const std::uint64_t top = std::numeric_limits<std::uint64_t>::max();
  std::vector<std::uint64_t> wraps{top}, bits{std::uint64_t{1} << r, 5};
  comm.sum(wraps);
  comm.bit_xor(bits);
  EXPECT_EQ(wraps[0], top * static_cast<std::uint64_t>(n));
  EXPECT_EQ(bits[0], (std::uint64_t{1} << n) - 1);
  EXPECT_EQ(bits[1], n % 2 == 1 ? 5U : 0U);
  comm.sum(std::span<std::int64_t>{});
}

TEST(Comm, extrema_of_doubles_do_not_depend_on_the_order_of_ranks) {
  const Comm comm(MPI_COMM_WORLD);
  const double inf = std::numeric_limits<double>::infinity();
  const double tiny = std::numeric_limits<double>::denorm_min();
  for (int special = 0; special < comm.size(); ++special) {
    const bool here = comm.rank() == special;
    const double minus_nan = std::copysign(std::numeric_limits<double>::quiet_NaN(), -1.0);
    std::vector<double> most{here ? 3.5 : -2.5, here ? -tiny : -inf, here ? 0.0 : -0.0,
                             here ? minus_nan : inf};
    std::vector<double> least{here ? -3.5 : 2.5, here ? tiny : inf, here ? -0.0 : 0.0,
                              here ? -minus_nan : -inf};
    std::vector<double> together = most;
    std::vector<std::int64_t> total{1, special};
    comm.max(most);
    comm.min(least);
    max_and_sum(comm, together, total);
    EXPECT_EQ(most[0], 3.5);
    EXPECT_EQ(most[1], -tiny);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(most[2]), std::bit_cast<std::uint64_t>(0.0));
    EXPECT_TRUE(std::isnan(most[3]));
    EXPECT_EQ(least[0], -3.5);
    EXPECT_EQ(least[1], tiny);
    EXPECT_EQ(std::bit_cast<std::uint64_t>(least[2]), std::bit_cast<std::uint64_t>(-0.0));
    EXPECT_TRUE(std::isnan(least[3]));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(most[3]), std::bit_cast<std::uint64_t>(least[3]));
    EXPECT_EQ(std::memcmp(together.data(), most.data(), most.size() * sizeof(double)), 0);
    EXPECT_EQ(total, (std::vector<std::int64_t>{comm.size(), special * comm.size()}));
  }
}

TEST(Comm, broadcasts_from_any_root) {
  const Comm comm(MPI_COMM_WORLD);
  for (int root = 0; root < comm.size(); ++root) {
    const std::string text = "from " + std::to_string(root);
    EXPECT_EQ(comm.broadcast(comm.rank() == root ? text : "something longer than that", root), text);
    EXPECT_EQ(comm.broadcast(comm.rank() == root ? std::string() : "x", root), "");
  }
}

TEST(Comm, gathers_in_the_order_of_ranks) {
  const Comm comm(MPI_COMM_WORLD);
  const int n = comm.size();
  const auto by_rank = comm.all_gather(comm.rank() + 0.5);
  const auto counts = comm.all_gather(std::int64_t{10} * comm.rank());
  for (int r = 0; r < n; ++r) {
    EXPECT_EQ(by_rank[static_cast<std::size_t>(r)], r + 0.5);
    EXPECT_EQ(counts[static_cast<std::size_t>(r)], 10 * r);
  }

  for (int root = 0; root < n; ++root) {  // rank r gives r % 3 bytes of value r: some give none
    const std::vector<std::byte> mine(static_cast<std::size_t>(comm.rank() % 3),
                                      static_cast<std::byte>(comm.rank()));
    std::vector<std::byte> expected;
    if (comm.rank() == root)
      for (int r = 0; r < n; ++r)
        expected.insert(expected.end(), static_cast<std::size_t>(r % 3), static_cast<std::byte>(r));
    EXPECT_EQ(comm.gather(mine, root), expected);
  }
  comm.barrier();
}

}  // namespace

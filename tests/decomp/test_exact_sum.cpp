// ExactSum against hardware addition, 128-bit integers, known hard cases, and itself in other orders.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "decomp/exact_sum.hpp"

namespace {

using decomp::Comm;
using decomp::ExactSum;
using Limits = std::numeric_limits<double>;
__extension__ typedef __int128 Int128;

constexpr double tiny = Limits::denorm_min();
constexpr double huge = Limits::max();
constexpr double half_ulp_of_huge = 0x1p970;

double sum_of(const std::vector<double>& terms) {
  ExactSum sum;
  for (const double x : terms) sum.add(x);
  return sum.value();
}

std::uint64_t bits_of(double x) { return std::bit_cast<std::uint64_t>(x); }

/// Any finite double, every exponent alike.
double any_finite(std::mt19937_64& engine) {
  for (;;) {
    const double x = std::bit_cast<double>(std::uint64_t{engine()});
    if (std::isfinite(x)) return x;
  }
}

TEST(ExactSum, KnownValues) {
  EXPECT_EQ(bits_of(ExactSum().value()), bits_of(0.0));
  EXPECT_EQ(bits_of(sum_of({-0.0, -0.0})), bits_of(0.0));
  EXPECT_EQ(sum_of({1e308, 1, -1e308}), 1);
  EXPECT_EQ(sum_of({0x1p1000, 0x1p-1000, -0x1p1000}), 0x1p-1000);
  EXPECT_EQ(bits_of(sum_of({0.1, -0.1})), bits_of(0.0));
  EXPECT_EQ(sum_of({-1.5}), -1.5);
  std::vector<double> tenths(10, 0.1);
  EXPECT_EQ(sum_of(tenths), 1.0);  // 10 * double(0.1) lies a quarter of an ulp above 1
}

TEST(ExactSum, TiesGoToEvenUnlessAnythingBelowDecides) {
  EXPECT_EQ(sum_of({1, 0x1p-53}), 1);
  EXPECT_EQ(sum_of({1 + 0x1p-52, 0x1p-53}), 1 + 0x1p-51);
  EXPECT_EQ(sum_of({1, 0x1p-53, tiny}), 1 + 0x1p-52);
  EXPECT_EQ(sum_of({1, 0x1p-53, -tiny}), 1);
  EXPECT_EQ(sum_of({-1, -0x1p-53, -tiny}), -1 - 0x1p-52);
  EXPECT_EQ(sum_of({2 - 0x1p-52, 0x1p-53}), 2);  // the carry reaches the exponent
}

TEST(ExactSum, SubnormalsAreExact) {
  EXPECT_EQ(sum_of({tiny}), tiny);
  EXPECT_EQ(sum_of({-tiny, -tiny, -tiny}), -3 * tiny);
  EXPECT_EQ(sum_of({Limits::min(), -tiny}), Limits::min() - tiny);
  EXPECT_EQ(sum_of({Limits::min() - tiny, tiny}), Limits::min());
  EXPECT_EQ(sum_of({1, tiny, -1}), tiny);
}

TEST(ExactSum, OverflowsOnlyIfTheSumDoes) {
  EXPECT_EQ(sum_of({huge, huge, -huge}), huge);
  EXPECT_EQ(sum_of({huge, huge}), Limits::infinity());
  EXPECT_EQ(sum_of({-huge, -huge}), -Limits::infinity());
  EXPECT_EQ(sum_of({huge, half_ulp_of_huge}), Limits::infinity());  // a tie, and infinity is the even side
  EXPECT_EQ(sum_of({huge, half_ulp_of_huge, -tiny}), huge);
  EXPECT_EQ(sum_of({huge, std::nextafter(half_ulp_of_huge, 0.0)}), huge);
  std::vector<double> many(100000, huge);
  EXPECT_EQ(sum_of(many), Limits::infinity());
  many.resize(200000 - 1, -huge);
  EXPECT_EQ(sum_of(many), huge);
}

TEST(ExactSum, NonFiniteTermsGiveNan) {
  EXPECT_TRUE(std::isnan(sum_of({1, Limits::infinity()})));
  EXPECT_TRUE(std::isnan(sum_of({Limits::quiet_NaN(), 1})));
  EXPECT_TRUE(std::isnan(sum_of({Limits::infinity(), -Limits::infinity()})));
}

TEST(ExactSum, DoublesItselfPastEveryCarry) {
  ExactSum up, down;
  up.add(1.1);
  down.add(-1.1);
  for (int i = 0; i < 900; ++i) {
    up.add(up);
    down.add(down);
    ASSERT_EQ(up.value(), std::ldexp(1.1, i + 1));
    ASSERT_EQ(down.value(), -up.value());
  }
  up.add(down);
  EXPECT_EQ(bits_of(up.value()), bits_of(0.0));
}

TEST(ExactSum, OfTwoTermsIsTheHardwareSum) {
  std::mt19937_64 engine(1);
  for (int n = 0; n < 200000; ++n) {
    const double a = any_finite(engine);
    double b = any_finite(engine);
    if (n % 2 == 0) {  // the same neighbourhood, where rounding and cancellation happen
      const double scaled = std::ldexp(a, static_cast<int>(engine() % 120) - 60);
      b = std::bit_cast<double>(bits_of(scaled) ^ (engine() & 0x800000000000001fU));
      if (!std::isfinite(b)) continue;
    }
    ASSERT_EQ(sum_of({a, b}), a + b) << std::hexfloat << a << ' ' << b;
  }
}

RC_GTEST_PROP(ExactSum, MatchesLongIntegers, (const std::vector<std::int64_t>& terms, std::uint8_t scale)) {
  // term * 2^shift with 53-bit terms: the conversion of __int128 to double rounds to nearest even
  Int128 expected = 0;
  ExactSum sum;
  const int exponent = static_cast<int>(scale) - 128;
  for (std::size_t i = 0; i < terms.size(); ++i) {
    const std::int64_t term = terms[i] >> (terms[i] & 1 ? 11 : 40);
    const int shift = static_cast<int>(static_cast<std::uint64_t>(terms[i]) >> 3 & 63);
    expected += static_cast<Int128>(term) * (static_cast<Int128>(1) << shift);
    sum.add(std::ldexp(static_cast<double>(term), shift + exponent));
  }
  RC_ASSERT(bits_of(sum.value()) == bits_of(std::ldexp(static_cast<double>(expected), exponent)));
}

TEST(ExactSum, OrderAndGroupingDoNotMatter) {
  std::mt19937_64 engine(2);
  std::vector<double> terms;
  for (int n = 0; n < 3000; ++n) terms.push_back(std::ldexp(any_finite(engine), -40));
  const double expected = sum_of(terms);
  for (int round = 0; round < 5; ++round) {
    std::shuffle(terms.begin(), terms.end(), engine);
    ASSERT_EQ(bits_of(sum_of(terms)), bits_of(expected));
    std::vector<ExactSum> groups(1 + engine() % 50);
    for (const double x : terms) groups[engine() % groups.size()].add(x);
    ExactSum all;
    for (const ExactSum& g : groups) all.add(g);
    ASSERT_EQ(bits_of(all.value()), bits_of(expected));
  }
}

TEST(ExactSum, RanksGetTheSameBitsAsOneRank) {
  const Comm comm(MPI_COMM_WORLD);
  std::mt19937_64 engine(3);  // the same terms on every rank
  std::vector<double> expected;
  std::vector<ExactSum> sums(5);
  for (ExactSum& sum : sums) {
    ExactSum serial;
    for (int n = 0; n < 500; ++n) {
      const double x = std::ldexp(any_finite(engine), -40);
      serial.add(x);
      if (static_cast<int>(engine() % static_cast<std::uint64_t>(comm.size())) == comm.rank()) sum.add(x);
    }
    expected.push_back(serial.value());
  }
  ExactSum::all_reduce(comm, sums);
  for (std::size_t i = 0; i < sums.size(); ++i) EXPECT_EQ(bits_of(sums[i].value()), bits_of(expected[i]));

  sums[0].add(1.0);  // a reduced sum can be added to and reduced again
  sums[1] = {};
  if (comm.rank() == comm.size() - 1) sums[1].add(Limits::quiet_NaN());
  ExactSum::all_reduce(comm, std::span(sums).first(2));
  EXPECT_TRUE(std::isfinite(sums[0].value()) || std::isinf(expected[0]));
  EXPECT_TRUE(std::isnan(sums[1].value()));
  ExactSum::all_reduce(comm, {});
}

}  // namespace

// Timers. Ranks may share cores, so a region can only take longer than asked: every bound is one-sided or
// compares readings of the same clock.
#include <gtest/gtest.h>
#include <time.h>

#include <chrono>
#include <set>
#include <string_view>
#include <thread>

#include "decomp/timer.hpp"

namespace {

using decomp::Region;
using decomp::Timers;
using Clock = std::chrono::steady_clock;

constexpr double pause = 1e-3;

double since(Clock::time_point t) { return std::chrono::duration<double>(Clock::now() - t).count(); }

void work() {
  const auto start = Clock::now();
  while (since(start) < pause) {
  }
}

double sum_of_regions(const Timers& timers) {
  double sum = 0;
  for (int r = 0; r < decomp::region_count; ++r) sum += timers.seconds(static_cast<Region>(r));
  return sum;
}

TEST(Timer, RegionsAreExclusiveAndNest) {
  const auto start = Clock::now();
  Timers timers;
  double inner = 0;
  {
    const auto outer_scope = timers.time(Region::pairs);
    work();
    const auto inner_start = Clock::now();
    {
      const auto inner_scope = timers.time(Region::halo_wait);
      work();
      work();
    }
    inner = since(inner_start);
    work();
  }
  const double pairs = timers.seconds(Region::pairs);
  const double wait = timers.seconds(Region::halo_wait);
  EXPECT_GE(pairs, 2 * pause);
  EXPECT_GE(wait, 2 * pause);
  EXPECT_LE(wait, inner);
  EXPECT_EQ(timers.calls(Region::pairs), 1);
  EXPECT_EQ(timers.calls(Region::halo_wait), 1);
  EXPECT_EQ(timers.calls(Region::other), 0);
  EXPECT_EQ(timers.seconds(Region::pairs), pairs);  // its clock stands
  EXPECT_LE(pairs + wait, since(start));            // nothing counted twice
}

TEST(Timer, TotalIsTheSumOfRegions) {
  const auto start = Clock::now();
  Timers timers;
  for (int n = 0; n < 3; ++n) {
    const auto a = timers.time(Region::lists);
    const auto b = timers.time(Region::order);
    const auto c = timers.time(Region::lists);
    work();
  }
  const double before = sum_of_regions(timers);
  const double total = timers.total();
  const double after = sum_of_regions(timers);
  constexpr double rounding = 1e-12;
  EXPECT_LE(before, total + rounding);
  EXPECT_LE(total, after + rounding);
  EXPECT_LE(total, since(start));
  EXPECT_GE(total, 3 * pause);
  EXPECT_EQ(timers.calls(Region::lists), 6);
}

double cpu() {
  timespec t{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &t);
  return static_cast<double>(t.tv_sec) + 1e-9 * static_cast<double>(t.tv_nsec);
}

void work_for_cpu() {
  const double start = cpu();
  while (cpu() - start < pause) {
  }
}

TEST(Timer, CostIsCpuTimeOfComputationSinceTheLastCall) {
  Timers timers;
  const double start = cpu();
  for (const Region r : {Region::contacts, Region::lists}) {
    const auto scope = timers.time(r);
    work_for_cpu();
  }
  const double both = cpu() - start;
  {
    const auto scope = timers.time(Region::reduce);
    work_for_cpu();
  }
  const double first = timers.take_cost();
  EXPECT_GE(first, 2 * pause);
  EXPECT_LE(first, both);
  EXPECT_EQ(timers.take_cost(), 0);
  double second = 0;
  {
    const auto scope = timers.time(Region::update);
    work_for_cpu();
    second = timers.take_cost();  // a running region counts up to now
    work_for_cpu();
  }
  const double third = timers.take_cost();
  EXPECT_GE(second, pause);
  EXPECT_GE(third, pause);
  EXPECT_LE(first + second + third, timers.cost() + 1e-12);
}

TEST(Timer, SleepIsNoCost) {
  Timers timers;
  {
    const auto scope = timers.time(Region::pairs);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
  EXPECT_LT(timers.take_cost(), 0.025);
  EXPECT_GE(timers.seconds(Region::pairs), 0.05);
}

TEST(Timer, WaitingIsNoComputation) {
  for (const Region r : {Region::halo_wait, Region::reduce, Region::output, Region::migrate, Region::other})
    EXPECT_FALSE(decomp::is_computation(r)) << decomp::name_of(r);
  for (const Region r : {Region::pairs, Region::update, Region::contacts, Region::lists, Region::order})
    EXPECT_TRUE(decomp::is_computation(r)) << decomp::name_of(r);
  std::set<std::string_view> names;
  for (int r = 0; r < decomp::region_count; ++r) names.insert(decomp::name_of(static_cast<Region>(r)));
  EXPECT_EQ(names.size(), static_cast<std::size_t>(decomp::region_count));
  EXPECT_FALSE(names.contains(""));
}

TEST(Timer, SummaryIsTheSameOnAllRanks) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Timers timers;
  {
    const auto scope = timers.time(Region::pairs);
    for (int n = 0; n <= comm.rank() % 2; ++n) work();
  }
  const double mine = timers.seconds(Region::pairs);
  const auto rows = timers.summary(comm);
  ASSERT_EQ(rows.size(), static_cast<std::size_t>(decomp::region_count));
  for (const Timers::Row& row : rows) {
    constexpr double rounding = 1e-12;
    EXPECT_LE(row.min, row.mean + rounding);
    EXPECT_LE(row.mean, row.max + rounding);
    EXPECT_EQ(row.calls, row.region == Region::pairs ? 1 : 0);
    double largest = row.mean, smallest = row.mean;
    comm.max(std::span(&largest, 1));
    comm.min(std::span(&smallest, 1));
    EXPECT_EQ(largest, smallest);
  }
  const Timers::Row& pairs = rows[static_cast<std::size_t>(Region::pairs)];
  EXPECT_EQ(pairs.region, Region::pairs);
  EXPECT_LE(pairs.min, mine);
  EXPECT_GE(pairs.max, mine);
  EXPECT_GE(pairs.max, (comm.size() > 1 ? 2 : 1) * pause);
}

}  // namespace

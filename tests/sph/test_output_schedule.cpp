#include <gtest/gtest.h>

#include "output/output_schedule.hpp"

namespace {

using sph::OutputSchedule;

TEST(OutputSchedule, IsDueAtTheFirstStepAtOrBeyondEachMultiple) {
  OutputSchedule s(0.1);
  EXPECT_TRUE(s.due(0));
  s.done(0);
  EXPECT_FALSE(s.due(0.09));
  EXPECT_TRUE(s.due(0.1));
  s.done(0.37);
  EXPECT_FALSE(s.due(0.37));
  EXPECT_TRUE(s.due(0.41));
  EXPECT_FALSE(OutputSchedule(0).due(1));
}

// Shorter than any step, down to what cannot be counted: due at every step, and found without counting there.
TEST(OutputSchedule, IntervalsFarBelowTheStepAreDueAtEach) {
  for (const double interval : {1e-15, 1e-17, 1e-20, 1e-300, 5e-324}) {
    OutputSchedule s(interval);
    double time = 0;
    for (int step = 0; step < 5; ++step) {
      EXPECT_TRUE(s.due(time)) << interval;
      s.done(time);
      EXPECT_FALSE(s.due(time)) << interval;
      time += 0.01;
    }
  }
}

}  // namespace

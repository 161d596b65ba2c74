// Melt that is pumped into a crack at a given rate (models/resets.hpp), which grows by it: the plane crack of Khristianovich, Geertsma
// and de Klerk whose length the toughness of the rock sets. Its pressure is that under which the tips just fail, K(a, p) = K_Ic, its
// volume V(a, p) what has come in; in infinite rock a = (E' Q t / 2 sqrt(pi) K_Ic)^(2/3) (Detournay 2004, eq. 45), here in a row of
// cracks (slab.hpp). What the melt is compressed by comes in too.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdio>
#include <string>

#include "accuracy/pinned.hpp"
#include "accuracy/slab.hpp"

namespace {

using measure::Row, measure::Sample, measure::samples, measure::run_until, measure::text;

constexpr double toughness = 0.01, stiffness = 0.49;  ///< of the melt, rho c^2
constexpr double sound = 1.095;                       ///< of the rock: sqrt(K + 4/3 mu)

/// What has come in when a crack begins to grow further.
double needed(const Row& row) {
  const double p = toughness / row.intensity(1);
  return row.volume(p) + 2 * row.half_length() * p / stiffness;
}

struct Growth {
  double length = 0;  ///< when it grew on, over what the volume says: mean of its steps
  int steps = 0;
};

Growth pumped(const Row& first, int last, double average) {
  const decomp::Comm comm(MPI_COMM_SELF);
  const double until = 15 * first.period(), rate = needed({last, first.rows, first.turned}) / until;
  sph::Simulation s = first.start(
      comm,
      {text("group.0.becomes.0.toughness", toughness), "group.0.becomes.0.keeps=both",
       text("group.0.becomes.0.average", average / sound), "group.0.viscosity=0.02", "group.1.viscosity=1e-3",
       "reset=[{lower=[-4, -100], upper=[4, 100], inflow=" + text("", rate).substr(1) + "}]",
       text("time.until", until)});
  Growth out;
  int m = first.m;
  run_until(s, until, [&] {
    int melt = 0;
    for (const Sample& q : samples(s)) melt += q.group == 1 ? 1 : 0;
    const int now = (melt - 1) / 2;
    if (now == m) return;
    if (m >= first.m + 3) {  // but for what is of the start
      out.length += std::pow(needed({m, first.rows, first.turned}) / (rate * s.global().time), 2.0 / 3);
      ++out.steps;
    }
    m = now;
  });
  out.length /= out.steps;
  std::printf("pumped crack, overload a mean over %.0f dx/c: %.3f as long as its volume says, %d steps\n",
              average, out.length, out.steps);
  return out;
}

// Of the overload at hand alone it would be 1.46 times as long: what fails sends waves that break what is next.
TEST(PumpedCracks, GrowAsTheirToughnessSays) {
  const Growth g = pumped({6, 81, false}, 16, 20);
  EXPECT_GE(g.steps, 7);
  EXPECT_NEAR(PINNED(g.length), 1, 0.08);
}

}  // namespace

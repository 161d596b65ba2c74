// The cylinders of Ida's paper as they are there: 3095 particles 1 m apart, h = 0.833 dx, K = 1e10 Pa. So coarse they
// rise by less than the early law of test_cylinder.cpp, 1.29 m at 1 s; the elastic one is held most. Bubbly
// magma breaks where half of its volume is gas; the paper's picture of 13.6 s has a part of the cylinder broken.
// When the first particle breaks, here 11.9 s, rounding decides (mixed precision: 11.1 s) and resolution (dx = 0.5 m: 10.3 s).
#include <gtest/gtest.h>

#include <cstdint>
#include <set>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"

namespace {

using measure::Sample;
using sph::Field;

/// A case of the paper; the cylinder is what it was at the start, broken or not.
class Case {
 public:
  explicit Case(const char* scene, const std::vector<std::string>& overrides = {})
      : s_(comm_,
           sph::read_scene(std::string(PEPERITE_TEST_DIR "/../apps/buoyant_cylinder/") + scene, overrides)) {
    double nearest = 1;
    each([&](std::uint64_t id, const Sample& q) {
      if (group_of(q) != "cylinder") return;
      cylinder_.insert(id);
      const double away = std::hypot(q.x[0] - 22, q.x[1] - 16);
      if (away < nearest) nearest = away, centre_ = id;
    });
    EXPECT_EQ(s_.particles().owned(), 3095);
    EXPECT_EQ(cylinder_.size(), 193);
    start_ = mean();
  }

  void until(double time) { measure::run_until(s_, time); }
  [[nodiscard]] double time() const { return s_.global().time; }
  [[nodiscard]] double noise() const { return measure::pressure_noise(s_); }

  /// How far the cylinder has risen, and its centre particle [m].
  [[nodiscard]] double risen() const { return mean() - start_; }
  [[nodiscard]] double centre_risen() const {
    double y = 0;
    each([&](std::uint64_t id, const Sample& q) {
      if (id == centre_) y = q.x[1] - 16;
    });
    return y;
  }
  /// How many particles have broken.
  [[nodiscard]] int broken() const {
    int n = 0;
    each([&](std::uint64_t, const Sample& q) { n += group_of(q) == "spray" ? 1 : 0; });
    return n;
  }
  /// Mean gas fraction of the cylinder.
  [[nodiscard]] double gas() const {
    double sum = 0;
    const double* psi = s_.particles().data<Field::void_fraction>();
    const std::uint64_t* id = s_.particles().data<Field::id>();
    for (std::size_t i = 0; i < s_.particles().owned(); ++i)
      if (cylinder_.contains(id[i])) sum += psi[i];
    return sum / static_cast<double>(cylinder_.size());
  }

 private:
  template <class F>
  void each(F f) const {
    const std::vector<Sample> all = measure::samples(s_);
    const std::uint64_t* id = s_.particles().data<Field::id>();
    for (std::size_t i = 0; i < all.size(); ++i) f(id[i], all[i]);
  }
  [[nodiscard]] const std::string& group_of(const Sample& q) const { return s_.scene().groups[q.group].name; }
  [[nodiscard]] double mean() const {
    double sum = 0;
    each([&](std::uint64_t id, const Sample& q) {
      if (cylinder_.contains(id)) sum += q.x[1];
    });
    return sum / static_cast<double>(cylinder_.size());
  }

  const decomp::Comm comm_{MPI_COMM_SELF};
  sph::Simulation s_;
  std::set<std::uint64_t> cylinder_;
  std::uint64_t centre_ = 0;
  double start_ = 0;
};

/// Rise [m], and the worst pressure noise of the whole seconds to 3 s [Pa].
struct Rise {
  double at_1 = 0, at_3 = 0, centre_at_1 = 0, centre_at_3 = 0, noise = 0;
};

Rise rise(Case& c, const char* label) {
  Rise r;
  for (int second = 1; second <= 3; ++second) {
    c.until(second);
    if (second == 1) r.at_1 = c.risen(), r.centre_at_1 = c.centre_risen();
    r.noise = std::max(r.noise, c.noise());
  }
  r.at_3 = c.risen(), r.centre_at_3 = c.centre_risen();
  std::printf("%s cylinder of 3095: %.3f m at 1 s, %.3f m at 3 s, its centre %.3f, %.3f m; noise %.1f kPa\n",
              label, r.at_1, r.at_3, r.centre_at_1, r.centre_at_3, r.noise / 1e3);
  return r;
}

TEST(PaperCylinder, FluidAndBubbly) {
  Case fluid("fluid.toml");
  const Rise of_fluid = rise(fluid, "fluid");
  EXPECT_NEAR(PINNED(of_fluid.at_1), 1.29, 0.2 * 1.29);
  PINNED(of_fluid.at_3);
  PINNED(of_fluid.centre_at_1);
  PINNED(of_fluid.centre_at_3);
  EXPECT_LE(PINNED(of_fluid.noise), 60e3);
  fluid.until(5);

  Case bubbly("gas.toml");
  const Rise of_bubbly = rise(bubbly, "bubbly");
  EXPECT_NEAR(of_bubbly.at_1, of_fluid.at_1, 1e-6) << "no gas yet";
  PINNED(of_bubbly.at_3);
  PINNED(of_bubbly.centre_at_3);
  EXPECT_LE(PINNED(of_bubbly.noise), 60e3);
  bubbly.until(5);
  EXPECT_GT(PINNED(bubbly.risen()), PINNED(fluid.risen()));

  double first = 0;
  for (int k = 501; k <= 1360; ++k) {  // as often as the series
    bubbly.until(0.01 * k);
    if (first == 0 && bubbly.broken() > 0) first = bubbly.time();
  }
  const int broken = bubbly.broken();
  std::printf("bubbly cylinder of 3095: first breaks at %.2f s; at 13.6 s %d of 193 are broken, gas %.2f\n",
              first, broken, bubbly.gas());
  EXPECT_NEAR(PINNED(first), 11.7, 1.2);
  EXPECT_NEAR(PINNED(broken), 0.3 * 193, 0.2 * 193);
  PINNED(bubbly.gas());
}

TEST(PaperCylinder, Elastic) {
  Case elastic("solid.toml");
  const Rise r = rise(elastic, "elastic");
  EXPECT_NEAR(PINNED(r.at_1), 1.29, 0.35 * 1.29);
  PINNED(r.at_3);
  EXPECT_NEAR(r.centre_at_3, r.at_3, 0.002 * r.at_3) << "it keeps its shape";
  EXPECT_LE(PINNED(r.noise), 80e3);
}

TEST(PaperCylinder, Ida) {
  Case ida("fluid.toml", {"formulation=ida"});
  const Rise r = rise(ida, "ida");
  EXPECT_NEAR(PINNED(r.at_1), 1.29, 0.2 * 1.29);
  PINNED(r.at_3);
  PINNED(r.centre_at_1);
  PINNED(r.centre_at_3);
  EXPECT_GE(PINNED(r.noise), 1e6) << "what the default formulation is there for";
}

}  // namespace

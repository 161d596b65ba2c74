// Few particles in a wide domain: memory follows the cells that are occupied, and the bits no cells at all.
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <fstream>

#include "pairs/occupied.hpp"
#include "sph/step/simulation.hpp"

namespace sph {
namespace {

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

/// 512 grains of 1 cm that fly apart in a cube of this width [m].
Scene grains_in(const std::string& width, const std::vector<std::string>& overrides) {
  const std::string text = R"(
dimension = 3
[domain]
lower = [0, 0, 0]
upper = [)" + width + "," + width +
                           "," + width + R"(]
gravity = [1, 2, -9.81]
[contact]
law = "linear"
[[group]]
name = "sand"
kind = "grain"
density = 2500
diameter = 0.01
normal_stiffness = 1e4
restitution = 0.5
friction = 0.5
[start]
origin = [0.3, 0.3, 0.3]
lower = [0.3, 0.3, 0.3]
upper = [0.388, 0.388, 0.388]
jitter = 0.05
seed = 4
velocity = [1, 0.5, -1]
[[start.region]]
group = "sand"
[time]
dt = 4e-5
steps = 1
)";
  return parse_scene(text, "wide", overrides);
}

#ifdef __SANITIZE_ADDRESS__
constexpr bool keeps_freed_memory = true;
#else
constexpr bool keeps_freed_memory = false;
#endif

/// While it lives, so many bytes more may be allocated than now.
class Allowance {
 public:
  explicit Allowance(std::size_t bytes) {
    std::size_t pages = 0;
    std::ifstream("/proc/self/statm") >> pages;
    getrlimit(RLIMIT_AS, &before_);
    rlimit now = before_;
    now.rlim_cur = pages * 4096 + bytes;
    setrlimit(RLIMIT_AS, &now);
  }
  ~Allowance() { setrlimit(RLIMIT_AS, &before_); }
  Allowance(const Allowance&) = delete;
  Allowance& operator=(const Allowance&) = delete;

 private:
  rlimit before_{};
};

std::string end_of(const Scene& scene, int steps) {
  Simulation s(world(), scene);
  EXPECT_EQ(s.particle_count(), 512);
  for (int k = 0; k < steps; ++k) s.step();
  return s.fingerprint();
}

// 6.8e6, 5e7, 6e9 and 1e18 cells. Balancing takes up to 80 MB for its columns.
TEST(WideDomains, MemoryFollowsTheGrains) {
  if (keeps_freed_memory) GTEST_SKIP() << "the address sanitizer's own memory is in the way of the limit";
  for (const char* width : {"2", "4", "19", "10000"}) {
    const Allowance allowance(std::size_t{160} << 20);
    EXPECT_NO_THROW(end_of(grains_in(width, {}), 200)) << width;
  }
}

TEST(WideDomains, CellsAreNotInTheBits) {
  const std::string expected = end_of(grains_in("2", {}), 800);  // 160 cells along each axis
  for (const char* skin : {"decomposition.skin=2", "decomposition.skin=0.5"})
    EXPECT_EQ(end_of(grains_in("2", {skin}), 800), expected) << skin;  // 66: cells by number; 133
  EXPECT_EQ(end_of(grains_in("2", {"decomposition.balance=\"chaos\"", "decomposition.rebuild_every=3"}), 800),
            expected);
}

TEST(WideDomains, OccupiedCountsTheSame) {
  const std::vector<std::size_t> cells{7, 63, 64, 65, 7, 9000, 4095, 9000, 0};
  Occupied few(70000, 1 << 20), many(std::size_t{1} << 40, 9);
  ASSERT_TRUE(Occupied::dense(70000, 1 << 20));
  ASSERT_FALSE(Occupied::dense(std::size_t{1} << 40, 9));
  for (const std::size_t c : cells) few.mark(c), many.mark(c);
  EXPECT_EQ(few.number(), 7U);
  EXPECT_EQ(many.number(), 7U);
  for (std::size_t c = 0; c < 10000; ++c) EXPECT_EQ(few.before(c), many.before(c)) << c;
}

}  // namespace
}  // namespace sph

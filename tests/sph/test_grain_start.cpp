// Grains of the start: radii and masses, particle files, snapshots and tiles, the same bits on any ranks.
#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <map>

#include "sph/core/fingerprint.hpp"
#include "sph/models/parts.hpp"
#include "sph/output/snapshot.hpp"
#include "sph/plan/distribution.hpp"
#include "sph/scene/grain_mass.hpp"
#include "sph/start/placement.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

const FieldSet smooth_grains{Field::id,   Field::position, Field::velocity,
                             Field::mass, Field::group,    Field::radius};
const FieldSet rough_grains = smooth_grains | FieldSet{Field::spin};

std::string text_of(const std::string& start) {
  return R"(
title = "grains"
[domain]
lower = [0, -0.1, 0]
upper = [0.2, 0.1, 0.1]
periodic = [true, false, false]
[contact]
law = "linear"
[[group]]
name = "sand"
kind = "grain"
density = 2000
diameter = [0.01, 0.02]
normal_stiffness = 700
restitution = 0.5
friction = 0.5
[[group]]
name = "glued"
kind = "grain"
density = 3000
diameter = 0.012
fixed = true
velocity = [0.25, 0, 0]
normal_stiffness = 700
restitution = 0.5
[[group]]
name = "glass"
kind = "grain"
normal_stiffness = 7000
restitution = 0.9
[time]
until = 1
[start]
)" + start;
}

const std::string lattice = R"(spacing = 0.025
jitter = 0.1
seed = 5
velocity = [0, 0.5, -1]
[[start.region]]
group = "sand"
[[start.region]]
group = "glued"
shape = "box"
lower = [0, -0.1, 0]
upper = [0.2, 0.1, 0.02]
)";
const std::string header = "id,x,y,z,vx,vy,vz,group,radius,wx,wy,wz\n";

Scene scene_of(const std::string& start, const std::vector<std::string>& options = {}) {
  return parse_scene(text_of(start), "grains.toml", options);
}

/// This rank's share, with what is needed to compare it with other starts.
struct Placed {
  Placed(const decomp::Comm& comm, const Scene& s, FieldSet fields = rough_grains)
      : scale(position_scale(s)), distribution(comm, s, scale), particles(s.dim, fields) {
    place_particles(s, scale, distribution, particles);
    wrap.origin = scale.origin;
    for (std::size_t a = 0; a < 3; ++a)
      if (s.domain.periodic[a]) wrap.period[a] = distribution.grid().length()[a];
  }
  [[nodiscard]] std::string print() const {
    return fingerprint(distribution.comm(), particles, {}, scale, wrap);
  }
  [[nodiscard]] std::int64_t count() const {
    return distribution.comm().sum(static_cast<std::int64_t>(particles.owned()));
  }
  PositionScale scale;
  Distribution distribution;
  Particles particles;
  Wrap wrap;
};

class GrainStart : public ::testing::Test {
 protected:
  /// A start's fingerprint, which must be that of one rank on any number of them.
  std::string same_on_all_ranks(const Scene& s) {
    const std::string all = Placed(world_, s).print();
    for (int ranks = 1; ranks < world_.size(); ++ranks)
      on_ranks(world_, ranks, [&](const decomp::Comm& comm) {
        EXPECT_EQ(Placed(comm, s).print(), all) << ranks << " ranks";
      });
    return all;
  }
  std::string refusal(const Scene& s) {
    try {
      (void)Placed(world_, s);
    } catch (const InputError& error) {
      return error.what();
    }
    return "(accepted)";
  }
  void write(const std::string& name, const std::string& text) {
    if (world_.rank() == 0) std::ofstream(dir_ / name) << text;
    world_.barrier();
  }
  /// Options that start from a file of the scratch directory.
  std::string file(const std::string& name) { return "file = \"" + (dir_ / name).string() + "\"\n"; }
  std::string tile(const std::string& name, const std::string& repeat) {
    return "tile = { file = \"" + (dir_ / name).string() + "\", repeat = " + repeat + " }\n";
  }

  decomp::Comm world_{MPI_COMM_WORLD};
  ScratchDirectory scratch_{world_};
  std::filesystem::path dir_ = scratch_.path();
};

TEST_F(GrainStart, RadiiFollowFromSeedAndId) {
  const Scene s = scene_of(lattice);
  const Placed placed(world_, s);
  EXPECT_EQ(placed.count(), 8 * 8 * 4);
  const Particles& p = placed.particles;
  double least = 1, largest = 0;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const double r = p.data<Field::radius>()[i], mass = p.data<Field::mass>()[i];
    const double* v = p.data<Field::velocity>() + 3 * i;
    EXPECT_EQ(p.data<Field::spin>()[3 * i], 0);
    if (p.data<Field::group>()[i] == 1) {
      EXPECT_EQ(r, 0.006);
      EXPECT_EQ(mass, grain_mass(3000, r));
      EXPECT_EQ((Double3{v[0], v[1], v[2]}), (Double3{0.25, 0, 0}));
      continue;
    }
    EXPECT_TRUE(r >= 0.005 && r <= 0.01) << r;
    EXPECT_EQ(mass, grain_mass(2000, r));
    EXPECT_EQ((Double3{v[0], v[1], v[2]}), (Double3{0, 0.5, -1}));
    least = std::min(least, r);
    largest = std::max(largest, r);
  }
  EXPECT_LT(-world_.max(static_cast<std::int64_t>(-1e6 * least)), 5300);
  EXPECT_GT(world_.max(static_cast<std::int64_t>(1e6 * largest)), 9700);
  const std::string print = same_on_all_ranks(s);
  EXPECT_NE(print, same_on_all_ranks(scene_of(lattice, {"start.seed=6"})));
  EXPECT_NEAR(grain_mass(1000, 0.5), 523.5987755982989, 1e-12);
}

TEST_F(GrainStart, SmoothGrainsHaveNoSpin) {
  const Placed placed(world_, scene_of(lattice), smooth_grains);
  EXPECT_EQ(placed.count(), 8 * 8 * 4);
  EXPECT_EQ(placed.particles.data<Field::spin>(), nullptr);
  EXPECT_EQ(placed.particles.data<Field::density>(), nullptr);
}

TEST_F(GrainStart, ReadsRadiusAndSpinFromRowsInAnyOrder) {
  const std::string a = "7,0.01,0,0.05,1,2,3,sand,0.0075,4,5,6\n", b = "9,0.19,0,0.05,1,2,3,1,0.006,4,5,6\n";
  write("a.csv", header + a + b);
  write("b.csv", header + b + a);
  const std::string print = same_on_all_ranks(scene_of(file("a.csv")));
  EXPECT_EQ(same_on_all_ranks(scene_of(file("b.csv"))), print);
  const Placed placed(world_, scene_of(file("a.csv")));
  const Particles& p = placed.particles;
  EXPECT_EQ(placed.count(), 2);
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const bool sand = p.data<Field::id>()[i] == 7;
    EXPECT_EQ(p.data<Field::radius>()[i], sand ? 0.0075 : 0.006);
    EXPECT_EQ(p.data<Field::mass>()[i], sand ? grain_mass(2000, 0.0075) : grain_mass(3000, 0.006));
    EXPECT_EQ(p.data<Field::velocity>()[3 * i], sand ? 1 : 0.25);
    EXPECT_EQ(p.data<Field::spin>()[3 * i + 2], sand ? 6 : 0);
  }
  write("c.csv", "id,x,y,z,vx,vy,vz,group,radius\n7,0.01,0,0.05,1,2,3,sand,0.0075\n");
  EXPECT_EQ(Placed(world_, scene_of(file("c.csv"))).count(), 1);
}

TEST_F(GrainStart, RefusesRowsThatCannotBe) {
  const std::string good = "7,0.01,0,0.05,0,0,0,sand,0.0075,0,0,0\n";
  const auto refused = [&](const std::string& text, const std::string& says) {
    write("bad.csv", text);
    for (const std::string& start : {file("bad.csv"), tile("bad.csv", "[1, 1, 1]")}) {
      const std::string message = refusal(scene_of(start));
      EXPECT_NE(message.find(says), std::string::npos) << message << "\n  lacks: " << says;
      EXPECT_EQ(message.rfind((dir_ / "bad.csv").string() + ": ", 0), 0U) << message;
    }
    world_.barrier();
  };
  const auto row = [&](const std::string& radius) {
    return header + good + "8,0.05,0,0.05,0,0,0,sand," + radius + ",0,0,0\n";
  };
  refused(row("0"), "line 3: radius is 0; it must be positive");
  refused(row("-0.0"), "line 3: radius is -0; it must be positive");
  refused(row("-0.0075"), "line 3: radius is -0.0075");
  refused(row("nan"), "line 3: radius is not finite");
  refused(row("inf"), "line 3: radius is not finite");
  refused(row("0.02"), "line 3: radius is 0.02 m; half the diameter of group \"sand\" is 0.005 to 0.01 m");
  refused(row("big"), "line 3: radius is \"big\"; it must be a number");
  refused(header + good + "7,0.05,0,0.05,0,0,0,sand,0.0075,0,0,0\n", "line 3: id 7");
  refused(header + good + "8,0.01,0,0.05,0,0,0,sand,0.0075,0,0,0\n", "line 3: ");
  refused(header + good + "8,0.01,0,0.05,0,0,0,sand,0.0075,0,0,0\n", "at exactly the point of");
  refused(header + good + "8,0.21,0,0.05,0,0,0,sand,0.0075,0,0,0\n8,0.01,0,0.2,0,0,0,sand,0.0075,0,0,0\n",
          "line 4: particle 8 lies outside the");
  refused(header + good + "8,0.05,0,0.05,0,0,0,glass,0.0075,0,0,0\n", "group \"glass\" has no diameter");
  refused(header + good + "8,0.05,0,0.05,0,0,0,sand,0.0075,0,nan,0\n", "line 3: spin is not finite");
  refused("id,x,y,z,vx,vy,vz,group\n",
          "column \"radius\" is missing; the header must name id,x,y,z,vx,vy,vz,group,"
          "radius and may name wx,wy,wz");
  refused("id,x,y,z,vx,vy,vz,group,radius,wx\n", "it must name all or none");
  refused("id,x,y,z,vx,vy,vz,group,radius,rho\n", "unknown column \"rho\"");
}

TEST_F(GrainStart, ASnapshotKeepsEveryBit) {
  const Scene s = scene_of(lattice);
  Placed first(world_, s);
  for (std::size_t i = 0; i < first.particles.owned(); ++i)
    if (first.particles.data<Field::group>()[i] == 0)
      for (std::size_t a = 0; a < 3; ++a)
        first.particles.data<Field::spin>()[3 * i + a] =
            0.1 * static_cast<double>(first.particles.data<Field::id>()[i]);
  const std::string print = first.print();
  write_snapshot(world_, dir_ / "s.h5", first.particles, {}, first.scale, first.wrap,
                 {to_toml(s), print, {"sand", "glued", "glass"}}, {}, 1000);
  EXPECT_EQ(same_on_all_ranks(scene_of(file("s.h5"))), print);
}

TEST_F(GrainStart, TilesAreRepeatedSideBySide) {
  // Ids 40 and 11 become numbers 1 and 0 of each copy.
  write("t.csv",
        header + "40,0.01,-0.09,0.05,1,2,3,sand,0.0075,4,5,6\n11,0.05,-0.02,0.05,0,0,0,sand,0.005,0,0,0\n");
  const Scene s = scene_of(tile("t.csv", "[2, 2, 1]"));
  (void)same_on_all_ranks(s);
  const Placed placed(world_, s);
  EXPECT_EQ(placed.count(), 8);
  const Particles& p = placed.particles;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const std::uint64_t id = p.data<Field::id>()[i], copy = id / 2;
    const bool second = id % 2 == 1;
    const std::int64_t* q = p.data<Field::position>() + 3 * i;
    EXPECT_NEAR(placed.scale.metres(q[0]), (second ? 0.01 : 0.05) + 0.1 * static_cast<double>(copy % 2),
                1e-15);
    EXPECT_NEAR(placed.scale.metres(q[1]), (second ? -0.09 : -0.02) + 0.1 * static_cast<double>(copy / 2),
                1e-15);
    EXPECT_EQ(p.data<Field::radius>()[i], second ? 0.0075 : 0.005);
    EXPECT_EQ(p.data<Field::velocity>()[3 * i + 2], second ? 3 : 0);
    EXPECT_EQ(p.data<Field::spin>()[3 * i], second ? 4 : 0);
  }
  EXPECT_NE(
      refusal(scene_of(tile("t.csv", "[2, 4, 1]"))).find("line 3: particle 11 lies outside the tile in y"),
      std::string::npos);
  EXPECT_NE(refusal(scene_of(tile("t.csv", "[1000000, 1000000, 1000000]"))).find("would make"),
            std::string::npos);
}

TEST_F(GrainStart, SnapshotsAreTilesOfTheirDomain) {
  // Grains at a seam lie on either side of it.
  const Scene s = scene_of(lattice, {"start.jitter=0.49"});
  const Placed first(world_, s);
  write_snapshot(world_, dir_ / "s.h5", first.particles, {}, first.scale, first.wrap,
                 {to_toml(s), first.print(), {"sand", "glued", "glass"}}, {}, 1000);
  const Scene once = scene_of(tile("s.h5", "[1, 1, 1]"));
  // Its ids are those of the lattice, with a margin of one point on each side; a tile counts from 0.
  EXPECT_NE(same_on_all_ranks(once), first.print());
  const Scene wide = scene_of(tile("s.h5", "[3, 1, 2]"), {"domain.upper=[0.6, 0.1, 0.2]"});
  (void)same_on_all_ranks(wide);
  EXPECT_EQ(Placed(world_, wide).count(), 6 * first.count());
  const std::string message = refusal(scene_of(tile("s.h5", "[2, 1, 1]"), {"domain.upper=[0.5, 0.1, 0.1]"}));
  EXPECT_NE(message.find("its domain is 0.2 m long in x; 2 copies in the scene's domain have 0.25 m"),
            std::string::npos)
      << message;
}

}  // namespace
}  // namespace sph::test

// What a scene of grains writes does not depend on ranks, skin or lists, and leaves no trace; what differs
// between two states is named.
#include <cstring>
#include <sstream>

#include "grain_output_fixture.hpp"
#include "sph/checkpoint/checkpoint.hpp"
#include "sph/inspect/inspect.hpp"

namespace sph::test {
namespace {

std::string contents(const std::filesystem::path& path) {
  std::ostringstream out;
  out << std::ifstream(path, std::ios::binary).rdbuf();
  return out.str();
}

/// A bed that overlaps everywhere, thrown at the floor: contacts come and go, some across the periodic face.
Scene thrown(const std::string& law, const std::vector<std::string>& options = {}) {
  return parse_scene(domain + law + R"([start]
spacing = 0.02
jitter = 0.03
seed = 5
lower = [0, 0.02, 0]
upper = [0.2, 0.18, 0.1]
velocity = [0.5, 0.1, -0.5]
[[start.region]]
group = "sand"
)",
                     "thrown.toml", options);
}

TEST_F(GrainOutput, IsTheSameOnAnyRanks) {
  for (const std::string& law : {springs, hertz}) {
    std::string expected;
    std::vector<double> series;
    for (int ranks = 1; ranks <= world_.size(); ++ranks)
      on_ranks(world_, ranks, [&](const decomp::Comm& comm) {
        Simulation s(comm, thrown(law, {"time.dt=2e-4"}));
        std::vector<double> values;
        for (int n = 0; n < 30; ++n) {
          s.step();
          for (double x : Monitors(s).values(s)) values.push_back(x);
        }
        write(s, scratch_.path() / "a.h5");
        const std::string bytes = contents(scratch_.path() / "a.h5");
        if (ranks == 1) {
          expected = bytes;
          series = values;
          EXPECT_GT(read<std::uint64_t>(scratch_.path() / "a.h5", "contacts/id", Element::u64).size(), 300u);
        } else if (comm.rank() == 0) {
          EXPECT_TRUE(bytes == expected) << ranks << " ranks";
          EXPECT_EQ(std::memcmp(values.data(), series.data(), 8 * values.size()), 0) << ranks << " ranks";
        }
        comm.barrier();
      });
  }
}

TEST_F(GrainOutput, LooksAtContactsWithoutATrace) {
  const Scene scene = thrown(springs, {"time.dt=2e-4"});
  Simulation seen(world_, scene), unseen(world_, scene);
  Simulation other(world_, thrown(springs, {"time.dt=2e-4", "decomposition.skin=0.02"}));
  for (int n = 0; n < 60; ++n) {
    seen.step();
    unseen.step();
    other.step();
    const std::vector<double> values = Monitors(seen).values(seen);
    EXPECT_EQ(values, Monitors(other).values(other)) << "lists of another skin";
  }
  EXPECT_EQ(seen.fingerprint(), unseen.fingerprint());
  EXPECT_GT(other.rebuilds(), unseen.rebuilds());
}

TEST_F(GrainOutput, DifferencesOfContactsAndWalls) {
  Simulation s(world_, scene_of(springs, stack));
  s.step();
  const auto save = [&](const char* name, const decomp::Payload& contacts, const GlobalState& global) {
    const RunRecord record{global, s.scale(), to_toml(s.scene()), ""};
    write_checkpoint(world_, scratch_.path() / name, s.particles(), &contacts, record, s.wrap(),
                     {record.scene_toml, s.fingerprint(), {}}, 1);
  };
  /// Adds to the bits of history[component] of grain 3's contact with `partner`.
  const auto changed = [&](std::uint64_t partner, std::size_t component) {
    decomp::Payload out = s.contacts();
    const std::size_t width = s.grains()->pairs().lists().entry_bytes();
    for (std::size_t row = 0; row < out.rows(); ++row)
      for (std::uint64_t at = out.offset[row]; at < out.offset[row + 1]; at += width) {
        std::uint64_t key;
        std::memcpy(&key, out.bytes.data() + at, 8);
        if (s.particles().data<Field::id>()[row] == 3 && key == partner)
          out.bytes[at + 8 * (1 + component)] ^= std::byte{1};
      }
    return out;
  };
  const auto difference = [&] { return first_difference(scratch_.path() / "a", scratch_.path() / "b"); };
  save("a", s.contacts(), s.global());
  save("b", s.contacts(), s.global());
  EXPECT_EQ(difference(), "");
  save("b", changed(7, 1), s.global());
  EXPECT_EQ(difference().rfind("contact 3-7: history[1]: ", 0), 0u) << difference();
  save("b", changed(wall_key, 0), s.global());
  EXPECT_EQ(difference().rfind("contact 3-wall 0: history[0]: ", 0), 0u) << difference();
  GlobalState moved = s.global();
  moved.walls[0].force[2] += 5;
  save("b", s.contacts(), moved);
  EXPECT_EQ(difference().rfind("wall 0: force[2]: ", 0), 0u) << difference();

  write(s, scratch_.path() / "s.h5");
  EXPECT_EQ(first_difference(scratch_.path() / "a", scratch_.path() / "s.h5"), "");
}

}  // namespace
}  // namespace sph::test

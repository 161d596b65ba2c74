// What stops a run says what is wrong, whatever the skin: as a fault of the scene at its start, as what was
// found first later on.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <functional>
#include <string>
#include <vector>

#include "sph/core/error.hpp"
#include "sph/step/simulation.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

constexpr const char* clump = R"(
dimension = 2
[domain]
lower = [-4, -4]
upper = [44, 36]
[kernel]
h_over_dx = 1
[[group]]
name = "a"
density = 1000
sound_speed = 100
MATERIAL
[start]
spacing = 1
file = "FILE"
[time]
steps = 10
dt = 1.15e-2
)";

struct Row {
  double x, y, vx, vy, mass;
};

/// `row(i, j)` for 12 x 12 particles, those of j < `width`.
class FaultTest : public ::testing::Test {
 protected:
  Scene scene(const std::string& material, const std::function<Row(int, int)>& row, int width = 12,
              const std::vector<std::string>& overrides = {}) {
    const std::filesystem::path path = scratch_.path() / "start.csv";
    if (comm_.rank() == 0) {
      std::ofstream out(path);
      out.precision(17);
      out << "id,x,y,vx,vy,group,rho,mass\n";
      for (int i = 0; i < 12; ++i)
        for (int j = 0; j < width; ++j) {
          const Row r = row(i, j);
          out << 12 * i + j << ',' << r.x << ',' << r.y << ',' << r.vx << ',' << r.vy << ",a,1000," << r.mass
              << '\n';
        }
    }
    comm_.barrier();
    std::string text = clump;
    text.replace(text.find("MATERIAL"), 8, material);
    text.replace(text.find("FILE"), 4, path.string());
    return parse_scene(text, "clump", overrides);
  }

  /// What stops it within a few steps, with the state that it leaves.
  struct End {
    std::string text, fingerprint;
  };
  End end_of(const Scene& scene) {
    Simulation s(comm_, scene);
    try {
      for (int k = 0; k < 10; ++k) s.step();
    } catch (const GuardError& error) {
      return {error.what(), s.fingerprint()};
    }
    return {"(went on)", {}};
  }
  std::string refusal(const Scene& scene) {
    try {
      const Simulation s(comm_, scene);
    } catch (const InputError& error) {
      return error.what();
    } catch (const GuardError& error) {
      return std::string("no InputError: ") + error.what();
    }
    return "(accepted)";
  }

  decomp::Comm comm_{MPI_COMM_WORLD};
  ScratchDirectory scratch_{comm_};
};

/// Towards the centre at 60 m/s, one in nine 30 times as heavy.
Row falling(int i, int j) {
  const int k = 12 * i + j;
  const double x = 10.5 + i + 0.04 * (k * 21 % 11 - 5), y = 10.5 + j + 0.04 * (k * 34 % 11 - 5);
  const double length = std::sqrt((x - 16) * (x - 16) + (y - 16) * (y - 16));
  return {x, y, -60 * (x - 16) / length, -60 * (y - 16) / length, k % 9 == 0 ? 3e4 : 1e3};
}

const auto says = [](const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
};

TEST_F(FaultTest, IsToldBeforeTheSolverGivesUpOverIt) {
  const std::string text =
      end_of(scene("kind = \"fluid\"\nviscosity = 1e6", falling, 12, {"terms.implicit_viscosity=true"})).text;
  EXPECT_TRUE(says(text, "particle ") && says(text, "out of all range")) << text;
}

TEST_F(FaultTest, HasNoNumberThatIsNone) {
  const auto apart = [](int i, int j) {
    Row r = falling(i, j);
    r.vx = -r.vx;
    r.vy = -r.vy;
    return r;
  };
  const std::string pressure =
      end_of(scene("kind = \"fluid\"\neos = \"birch_murnaghan\"\nbulk_modulus_derivative = 12", apart, 12,
                   {"time.dt=", "time.cfl=0.8"}))
          .text;
  EXPECT_TRUE(says(pressure, "has no finite pressure and a density of -")) << pressure;
  const std::string speed = refusal(scene("kind = \"fluid\"", [](int i, int j) {
    return Row{10.0 + i, 10.0 + j, i == 3 && j == 4 ? 1e200 : 0, 0, 1e3};
  }));
  EXPECT_TRUE(says(speed, "40 at (13, 14) m, has no finite speed: it might move any distance")) << speed;
}

constexpr const char* body = "kind = \"solid\"\nlagrangian = \"total\"\npoisson_ratio = 0.3";

TEST_F(FaultTest, OfAStartIsOneOfItsScene) {
  const std::string text = refusal(scene(
      body,
      [](int i, int) {
        return Row{10.0 + i, 10, 0, 0, 1e3};
      },
      1));
  EXPECT_EQ(text.rfind("clump: start: ", 0), 0U) << text;
  EXPECT_TRUE(says(text, "neighbours in one line")) << text;
}

// A bond beyond the range of lists counts no longer, however wide their skin is.
TEST_F(FaultTest, LeavesTheSameStateWithAnySkin) {
  const auto halves = [](int i, int j) {
    return Row{10.0 + i, 10.0 + j, i < 6 ? -400.0 : 400.0, 13.0 * (i + j), 1e3};
  };
  for (const std::string precision : {"precision=double", "precision=mixed"}) {
    const auto end = [&](const std::string& skin) {
      return end_of(scene(body, halves, 12, {precision, "time.dt=1e-3", "decomposition.skin=" + skin}));
    };
    const End wanted = end("1");
    EXPECT_TRUE(says(wanted.text, "of its ")) << wanted.text;
    for (const std::string skin : {"0", "0.1", "0.5"}) {
      const End found = end(skin);
      EXPECT_EQ(found.text, wanted.text) << skin;
      EXPECT_EQ(found.fingerprint, wanted.fingerprint) << skin << ", " << precision;
    }
  }
}

}  // namespace
}  // namespace sph::test

// Reading scenes: defaults, derived values, units, --set, and the exact round trip through to_toml.
#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

#include "sph/laws/eos/law.hpp"
#include "sph/scene/scene.hpp"

namespace {

namespace fs = std::filesystem;
using Options = std::vector<std::string>;

const fs::path tests_dir = PEPERITE_TEST_DIR, accuracy_dir = PEPERITE_ACCURACY_DIR;
const fs::path apps_dir = tests_dir.parent_path() / "apps";

const std::string small = R"(
[domain]
lower = [0, 0]
upper = [20, 20]
[kernel]
h_over_dx = 1.5
[[group]]
name = "wall"
kind = "wall"
[[group]]
name = "melt"
kind = "fluid"
density = 2500
sound_speed = 20
viscosity = 500
[start]
spacing = 0.5
[[start.region]]
group = "melt"
[time]
until = 1
)";

sph::Scene parse(const std::string& text, const Options& options = {}) {
  return sph::parse_scene(text, "dir/small.toml", options);
}

std::string message_of(const std::string& text, const Options& options = {}) {
  try {
    (void)parse(text, options);
  } catch (const sph::InputError& e) {
    return e.what();
  }
  return "(accepted)";
}

std::vector<fs::path> good_scenes() {
  std::vector<fs::path> files;
  for (const fs::path& dir : {apps_dir / "buoyant_cylinder", tests_dir / "scenes", tests_dir / "every_key"})
    for (const fs::directory_entry& e : fs::directory_iterator(dir))
      if (e.path().extension() == ".toml") files.push_back(e.path());
  return files;
}

TEST(Scene, Defaults) {
  const sph::Scene s = parse(small);
  EXPECT_EQ(s.name, "small");
  EXPECT_EQ(s.file, "dir/small.toml");
  EXPECT_EQ(s.dim, 2);
  EXPECT_EQ(s.terms.formulation, sph::Formulation::conservative);
  EXPECT_EQ(s.terms.precision, sph::Precision::double_);
  EXPECT_EQ(s.kernel.shape, sph::KernelShape::quintic);
  EXPECT_EQ(s.domain.gravity, sph::Double3{});
  EXPECT_EQ(s.start.lattice.lower, s.domain.lower);
  EXPECT_EQ(s.start.lattice.upper, s.domain.upper);
  EXPECT_EQ(s.start.lattice.origin, s.domain.lower);
  EXPECT_EQ(s.terms, sph::Terms{});
  sph::Decomposition usual;
  usual.skin = 0.1;
  EXPECT_EQ(s.decomposition, usual);
  EXPECT_EQ(s.output, sph::OutputControl{});
  EXPECT_FALSE(s.time.dt.has_value());
  EXPECT_EQ(s.time.cfl, 0.8);
}

TEST(Scene, DerivedValues) {
  const sph::Scene s = parse(small);
  EXPECT_EQ(s.kernel.smoothing_length, 0.75);
  EXPECT_EQ(s.support(), 2.25);
  EXPECT_EQ(parse(small, {"kernel.shape=wendland_c2"}).support(), 1.5);
  EXPECT_EQ(s.group_index("melt"), 1);
  EXPECT_EQ(s.group_index("rock"), -1);
  EXPECT_EQ(s.groups[1].eos.bulk_modulus, 2500.0 * 20 * 20);
  EXPECT_EQ(s.groups[0].density, 2500);
  EXPECT_EQ(s.groups[0].eos.bulk_modulus, s.groups[1].eos.bulk_modulus);
  EXPECT_EQ(s.groups[0].viscosity, 500);
  EXPECT_TRUE(s.has_kind(sph::GroupKind::wall));
  EXPECT_FALSE(s.has_kind(sph::GroupKind::solid));
  EXPECT_FALSE(has_eos(s, sph::EosKind::bubbly));
}

TEST(Scene, SolidFromPoissonsRatio) {
  const sph::Scene s = sph::read_scene((apps_dir / "buoyant_cylinder" / "solid.toml").string(), {});
  const sph::Group& solid = s.groups[static_cast<std::size_t>(s.group_index("cylinder"))];
  EXPECT_EQ(solid.solid.shear_modulus, 6e9);
  EXPECT_NEAR(solid.eos.bulk_modulus - 2 * solid.solid.shear_modulus / 3, 6e9, 1e-3);
}

TEST(Scene, IdaHasNoDensityDiffusionUnlessItIsAskedFor) {
  EXPECT_EQ(parse(small, {"formulation=ida"}).terms.density_diffusion, 0);
  EXPECT_NE(message_of(small, {"formulation=ida", "terms.density_diffusion=0.1"}).find("\"ida\" has none"),
            std::string::npos);
}

TEST(Scene, DefaultCutsAreAcrossGravity) {
  const std::string path = (tests_dir / "scenes" / "box3d_fluid.toml").string();
  const auto axes = [&](const Options& options) {
    return sph::read_scene(path, options).decomposition.cut_axes;
  };
  EXPECT_EQ(axes({}), (std::array{0, 1}));
  EXPECT_EQ(axes({"domain.gravity=[0,-9.8,0]"}), (std::array{0, 2}));
  EXPECT_EQ(axes({"domain.gravity=[-9.8,0,0]", "start.pressure=zero"}), (std::array{1, 2}));
  EXPECT_EQ(axes({"decomposition.cut_axes=[\"z\",\"x\"]"}), (std::array{2, 0}));
}

TEST(Scene, UnitsGiveTheSameBitsAsTheNumber) {
  const auto viscosity = [](const std::string& value) {
    return parse(small, {"group.melt.viscosity=" + value}).groups[1].viscosity;
  };
  EXPECT_EQ(viscosity("500 Pa s"), 500);
  EXPECT_EQ(viscosity("0.5 kPa s"), 500);
  EXPECT_EQ(viscosity("500 Pa*s"), 500);
  EXPECT_EQ(viscosity("9.3 mPa s"), 0.0093);
  EXPECT_EQ(viscosity("1.7e3 kg/m/s"), 1.7e3);
  EXPECT_EQ(viscosity("2 g/cm/s"), 0.2);
  const auto spacing = [](const std::string& value) {
    return parse(small, {"start.spacing=" + value}).start.spacing;
  };
  EXPECT_EQ(spacing("57 cm"), 0.57);
  EXPECT_EQ(spacing("333mm"), 0.333);
  EXPECT_EQ(spacing("0.0007 km"), 0.7);
  const auto until = [](const std::string& value) {
    return *parse(small, {"time.until=" + value}).time.until;
  };
  EXPECT_EQ(until("1.1 ms"), 0.0011);
  EXPECT_EQ(until("2 min"), 120);
  EXPECT_EQ(until("1.5 h"), 5400);
  const auto density = [](const std::string& value) {
    return parse(small, {"group.melt.density=" + value}).groups[1].density;
  };
  EXPECT_EQ(density("2.7 g/cm3"), 2700);
  EXPECT_EQ(density("2700 kg m^-3"), 2700);
  EXPECT_EQ(density("2.7 t/m^3"), 2700);
  EXPECT_EQ(parse(small, {"domain.surface_pressure=1 atm"}).domain.surface_pressure, 101325);
  EXPECT_EQ(parse(small, {"domain.surface_pressure=1013.25 hPa"}).domain.surface_pressure, 101325);
  EXPECT_EQ(parse(small, {"domain.gravity=[0, \"-9.81 m/s2\"]"}).domain.gravity[1], -9.81);
  EXPECT_EQ(parse(small, {"domain.gravity=[0, \"-9.81 N/kg\"]"}).domain.gravity[1], -9.81);
  EXPECT_EQ(parse(small, {"start.jitter=5 %"}).start.lattice.jitter, 0.05);
}

TEST(Scene, OverridesReachEveryKey) {
  const sph::Scene s =
      parse(small, {"group.melt.viscosity=1e3", "group.0.velocity=[1,0]", "time.until=", "time.steps=1e6",
                    "title=a plain title", "decomposition.balance=chaos", "decomposition.chaos_seed=9",
                    "start.region.0.shape=ball", "start.region.0.centre=[10,10]",
                    "start.region.0.radius=\"50 cm\"", "time.dt = 1 ms", "output.average_space=true"});
  EXPECT_EQ(s.groups[1].viscosity, 1000);
  EXPECT_EQ(s.groups[0].wall.velocity[0], 1);
  EXPECT_FALSE(s.time.until.has_value());
  EXPECT_EQ(s.time.steps, 1'000'000);
  EXPECT_EQ(s.name, "a plain title");
  EXPECT_EQ(s.decomposition.cuts, sph::CutRule::chaos);
  EXPECT_EQ(s.decomposition.chaos_seed, 9U);
  EXPECT_EQ(s.start.lattice.regions[0].radius, 0.5);
  EXPECT_EQ(s.time.dt, 1e-3);
  EXPECT_TRUE(s.output.average_space);
}

TEST(Scene, LaterOverridesWin) {
  EXPECT_EQ(parse(small, {"time.until=2", "time.until=3"}).time.until, 3);
  EXPECT_EQ(parse(small, {"time.cfl=0.5", "time.cfl=", "time.dt=1"}).time.dt, 1);
}

TEST(Scene, BadOverridesNameTheOption) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"time.until", "--set time.until: --set: there is no \"key=value\" in it; write --set table.key=value"},
      {"=3", "--set =3: --set: there is no"},
      {"time..until=3", "--set time..until=3: time..until: the key has an empty part"},
      {"time.untl=3", "--set time.untl=3: time.untl: unknown key; did you mean \"until\"?"},
      {"tiem.until=3", "--set tiem.until=3: tiem: unknown key; did you mean \"time\"?"},
      {"group.mlet.viscosity=3",
       "group.mlet.viscosity: there is no element named \"mlet\"; did you mean \"melt\"?"},
      {"group.7.viscosity=3", "group.7.viscosity: there is no element 7; the indices are 0 to 1"},
      {"time.until.x=3", "time.until.x: goes through a whole number, which has no keys"},
      {"group.melt.viscosity=-3", "--set group.melt.viscosity=-3: group.melt.viscosity: is -3"},
      {"start.spacing=5 kg", "--set start.spacing=5 kg: start.spacing: \"5 kg\" is a mass"},
      {"start.spacing=[1", "--set start.spacing=[1: start.spacing: the value is not TOML"},
      {"start.spacing=", "dir/small.toml:16:1: start.spacing: is missing"},
      {"group.0=", "--set group.0=: group.0: an element of an array cannot be removed"},
      {"title=1\nx=2", "the value is not TOML"},
  };
  for (const auto& [option, expected] : cases) {
    const std::string message = message_of(small, {option});
    EXPECT_NE(message.find(expected), std::string::npos) << option << " gave " << message;
    EXPECT_EQ(message.find('\n'), std::string::npos) << message;
  }
}

TEST(Scene, PathsAreRelativeToWhereTheyWereWritten) {
  std::string text = small;
  text.replace(text.find("[[start.region]]\ngroup = \"melt\"\n"), 32, "file = \"p.csv\"\n");
  EXPECT_EQ(parse(text).start.file, (fs::current_path() / "dir" / "p.csv").string());
  EXPECT_EQ(parse(text, {"start.file=p.csv"}).start.file, (fs::current_path() / "p.csv").string());
  EXPECT_EQ(parse(text, {"start.file=/data/p.csv"}).start.file, "/data/p.csv");
  EXPECT_EQ(parse(sph::to_toml(parse(text))), parse(text, {"title=small"}));
}

TEST(Scene, ShippedScenesRoundTrip) {
  for (const fs::path& file : good_scenes()) {
    SCOPED_TRACE(file.string());
    const sph::Scene s = sph::read_scene(file.string(), {});
    const std::string text = sph::to_toml(s);
    const sph::Scene again = sph::parse_scene(text, s.file, {});
    EXPECT_EQ(again, s);
    EXPECT_EQ(sph::to_toml(again), text);
  }
}

TEST(Scene, EveryOptionRoundTrips) {
  const Options options{"formulation=ida",
                        "precision=mixed",
                        "decomposition.balance=replay",
                        "decomposition.replay=a.txt",
                        "decomposition.record=b.txt",
                        "decomposition.skin=0.35",
                        "decomposition.rebuild_every=3",
                        "decomposition.overlap=false",
                        "decomposition.cost=counts",
                        "start.lattice=hexagonal",
                        "start.velocity=[1.1,-0.3]",
                        "start.seed=12345678901",
                        "title='a \"quoted\\title\"'",
                        "time.steps=7",
                        "output.average_time=0.1",
                        "output.checkpoint_files=3",
                        "start.jitter=0.1"};
  const sph::Scene s = parse(small, options);
  EXPECT_EQ(s.name, "a \"quoted\\title\"");
  EXPECT_EQ(parse(sph::to_toml(s)), s);
  const sph::Scene slips = parse(small, {"group.0.slip=true", "terms.viscosity=symmetric"});
  EXPECT_TRUE(slips.groups[0].wall.slip);
  EXPECT_EQ(slips.terms.viscous.form, sph::ViscosityForm::symmetric);
  EXPECT_EQ(parse(sph::to_toml(slips)), slips);
}

TEST(Scene, IdealGasHasDefaultsOfItsOwn) {
  const Options gas{"group.melt.sound_speed=", "group.melt.eos=ideal_gas", "group.melt.heat_ratio=1.4",
                    "group.melt.start_pressure=2 bar"};
  const sph::Scene s = parse(small, gas);
  EXPECT_TRUE(has_eos(s, sph::EosKind::ideal_gas));
  EXPECT_EQ(s.groups[1].eos.bulk_modulus, 1.4 * 2e5);
  EXPECT_EQ(s.groups[0].eos.bulk_modulus, s.groups[1].eos.bulk_modulus);
  EXPECT_EQ(s.groups[0].eos.law, sph::linear_eos());
  EXPECT_EQ(s.terms.density_diffusion, 0);
  EXPECT_EQ(s.terms.artificial_viscosity, 1);
  EXPECT_EQ(s.terms.gas.quadratic_viscosity, 2);
  EXPECT_EQ(s.terms.gas.conduction, 0.3);
  EXPECT_EQ(parse(sph::to_toml(s)), s);
  Options quiet = gas;
  quiet.insert(quiet.end(), {"terms.artificial_viscosity=0", "terms.quadratic_viscosity=0.5",
                             "terms.artificial_conduction=0"});
  const sph::Scene without = parse(small, quiet);
  EXPECT_EQ(without.terms.gas.conduction, 0);
  EXPECT_EQ(parse(sph::to_toml(without)), without);
}

TEST(Scene, LargestGrowthFollowsThePeriodsAndNotTheSkin) {
  const auto growth = [](const char* skin) {
    return parse(R"(dimension = 2
[domain]
lower = [0, 0]
upper = [1, 0.3]
periodic = [true, true]
[kernel]
h_over_dx = 1
[[group]]
name = "gas"
kind = "fluid"
eos = "ideal_gas"
heat_ratio = 1.4
density = 1
start_pressure = 1
[start]
spacing = 0.02
[[start.region]]
group = "gas"
[time]
until = 1
)",
                 {skin})
        .kernel.largest_growth;
  };
  EXPECT_NEAR(growth("decomposition.skin=0.2"), 0.3 / (3 * 0.06) - 0.2, 1e-6);
  EXPECT_EQ(growth("decomposition.skin=0"), growth("decomposition.skin=0.2"));
  EXPECT_EQ(growth("decomposition.skin=0.05"), growth("decomposition.skin=0.2"));
}

TEST(Scene, CentralPullRoundTrips) {
  std::ifstream in(accuracy_dir / "oscillating_drop.toml");
  const std::string drop((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  EXPECT_EQ(parse(drop).domain.central_pull, 1);
  const sph::Scene s = parse(drop, {"domain.central_pull=\"0.3 1/s2\"", "domain.pull_centre=[0.5, 0.25]"});
  const sph::Scene again = parse(sph::to_toml(s));
  EXPECT_EQ(again.domain.central_pull, 0.3);
  EXPECT_EQ(again.domain.pull_centre, (sph::Double3{0.5, 0.25, 0}));
}

TEST(Scene, RoundTripKeepsEveryBitOfDoubles) {
  sph::Scene s = parse(small);
  s.start.velocity.kind = sph::InitialVelocity::uniform;
  std::uint64_t state = 1;
  for (int k = 0; k < 2000; ++k) {
    state = state * 6364136223846793005U + 1442695040888963407U;
    const double x = std::bit_cast<double>(state);
    if (!std::isfinite(x)) continue;
    s.start.velocity.uniform = {x, -x, 0};
    const sph::Scene again = parse(sph::to_toml(s));
    ASSERT_EQ(std::bit_cast<std::uint64_t>(again.start.velocity.uniform[0]), std::bit_cast<std::uint64_t>(x))
        << x;
    ASSERT_EQ(std::bit_cast<std::uint64_t>(again.start.velocity.uniform[1]), std::bit_cast<std::uint64_t>(-x))
        << x;
  }
  for (const double x : {0.0, -0.0, 1e16, 123456789012345680.0, std::numeric_limits<double>::max(),
                         std::numeric_limits<double>::min(), std::numeric_limits<double>::denorm_min()}) {
    s.start.velocity.uniform = {x, 0.1, 0};
    const sph::Scene again = parse(sph::to_toml(s));
    EXPECT_EQ(std::bit_cast<std::uint64_t>(again.start.velocity.uniform[0]), std::bit_cast<std::uint64_t>(x))
        << x;
  }
}

TEST(Scene, ShiftingKnowsWhetherThereIsAFreeSurface) {
  const std::string tank = (accuracy_dir / "hydrostatic.toml").string();
  EXPECT_FALSE(sph::read_scene(tank, {}).open());
  EXPECT_TRUE(sph::read_scene(tank, {"terms.shifting=true"}).open());
  // Without the empty region on top the walls close the tank.
  EXPECT_FALSE(sph::read_scene(tank, {"terms.shifting=true", "start.region.2.group=wall"}).open());
  EXPECT_FALSE(sph::read_scene((accuracy_dir / "poiseuille.toml").string(), {}).open());
}

TEST(Scene, CylinderCasesHaveThePapersNumbers) {
  for (const char* name : {"fluid.toml", "solid.toml", "gas.toml"}) {
    const sph::Scene s = sph::read_scene((apps_dir / "buoyant_cylinder" / name).string(), {});
    EXPECT_EQ(s.support(), 2.5);
    EXPECT_EQ(s.start.spacing, 1);
    EXPECT_EQ(s.groups[0].eos.bulk_modulus, 1e10);
    EXPECT_EQ(s.domain.gravity, (sph::Double3{0, -9.8, 0}));
    EXPECT_EQ(s.domain.surface_pressure, 1e5);
    EXPECT_EQ(s.time.dt, std::string(name) == "solid.toml" ? 1.75e-4 : 2e-4);
    EXPECT_EQ(s.time.until, 20);
    EXPECT_EQ(s.terms.density_diffusion, 0.1);
  }
  const sph::Scene gas = sph::read_scene((apps_dir / "buoyant_cylinder" / "gas.toml").string(), {});
  EXPECT_EQ(gas.groups[1].becomes.at(0).group, gas.group_index("spray"));
  EXPECT_EQ(gas.groups[1].becomes.at(0).void_fraction_above, 0.5);
}

}  // namespace

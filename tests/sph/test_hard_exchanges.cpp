// What no time step may break: contents and enthalpies stay above 0, pressures and temperatures between those of the start
// where nothing moves, and gas and heat are counted, however sharp the contrasts.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

#include "sph/output/monitors.hpp"
#include "sph/step/simulation.hpp"

namespace {

using sph::Field;
using sph::Simulation;

const decomp::Comm& world() {
  static const decomp::Comm comm(MPI_COMM_WORLD);
  return comm;
}

std::string magma(const std::string& name, const std::string& more) {
  return "[[group]]\nname = \"" + name +
         "\"\nkind = \"fluid\"\neos = \"bubbly\"\ndensity = 2400\nbulk_modulus = 1e9\ngas_rt = 5e5\n"
         "solubility_pressure = 5.92e10\nsolubility_exponent = 0.5\n" +
         more + "\n";
}

/// A box of 16 by 16 spacings of magma at 10 MPa over its weight, in which nothing moves, with a ball of other magma.
std::string still_box(const std::string& inside, const std::string& outside, double radius) {
  return "kernel = { h_over_dx = 1 }\n[domain]\nlower = [0, 0]\nupper = [16, 19]\nperiodic = [true, false]\n"
         "gravity = [0, -10]\nsurface_pressure = 1e5\n" +
         magma("outside", outside) + magma("inside", inside) +
         "[[group]]\nname = \"floor\"\nkind = \"wall\"\n[terms]\nmotion = false\n[start]\nspacing = "
         "1\njitter = 0.1\n"
         "pressure = \"hydrostatic\"\nlayer = [{ group = \"outside\", top = 18, pressure = 1e7 }]\n"
         "region = [{ group = \"floor\" }, { group = \"outside\", shape = \"box\", lower = [0, 3], upper = "
         "[16, 18] },\n"
         "{ group = \"inside\", shape = \"ball\", centre = [8, 10], radius = " +
         std::to_string(radius) +
         " }, { group = \"none\", shape = \"box\", lower = [0, 18], upper = [16, 19] }]\n[time]\nsteps = 1\n"
         "[[monitor]]\nkind = \"budget\"\n";
}

struct Range {
  double lowest, highest;
};
template <Field F>
Range range(const Simulation& s, const std::string& group = "") {
  double ends[2]{-1e300, -1e300};
  const double* value = s.particles().data<F>();
  for (std::size_t i = 0; i < s.particles().owned(); ++i) {
    const sph::Group& g = s.scene().groups[s.particles().data<Field::group>()[i]];
    if (g.kind == sph::GroupKind::wall || !(group.empty() || g.name == group)) continue;
    EXPECT_TRUE(std::isfinite(value[i]));
    ends[0] = std::max(ends[0], -value[i]);
    ends[1] = std::max(ends[1], value[i]);
  }
  s.comm().max(ends);
  return {-ends[0], ends[1]};
}

void expect_gas_kept(const sph::Monitors& monitors, Simulation& s, const std::vector<double>& first) {
  const std::vector<double> now = monitors.values(s);
  EXPECT_NEAR((now[1] - now[2]) / first[1], 1, 1e-13);
}

// Permeabilities that differ a millionfold, gas that leaves through a surface at 1 bar.
TEST(HardExchanges, PermeabilityContrastOfAMillion) {
  const std::string content = "gas_content = 0.02\n";
  for (const char* implicit : {"false", "true"}) {
    Simulation s(world(), sph::parse_scene(still_box(content + "permeability = { coefficient = 6.3e-17 }",
                                                     content + "permeability = { coefficient = 6.3e-11 }", 4),
                                           "contrast", {"terms.implicit_gas_flow=" + std::string(implicit)}));
    const sph::Monitors monitors(s);
    const std::vector<double> first = monitors.values(s);
    const Range pressures = range<Field::pressure>(s);
    for (int k = 0; k < 300; ++k) s.step();
    const Range now = range<Field::pressure>(s);
    EXPECT_GE(now.lowest, 0);
    EXPECT_LE(now.highest, 1.001 * pressures.highest);
    EXPECT_GT(range<Field::gas_content>(s).lowest, 0);
    EXPECT_LT(monitors.values(s)[2], -1e-4 * first[1]) << "some gas has left";
    expect_gas_kept(monitors, s, first);
  }
}

// What has no gas gives none, though in an implicit step the pressure there may rise above what is beside it.
TEST(HardExchanges, MagmaWithoutGasGivesNone) {
  const std::string content = "gas_content = 0.02\n";
  for (const char* inside : {"6.3e-11", "6.3e-9"}) {
    Simulation s(world(),
                 sph::parse_scene(still_box(content + "permeability = { coefficient = " + inside + " }",
                                            content + "permeability = { coefficient = 6.3e-11 }", 4),
                                  "emptied",
                                  {"terms.implicit_gas_flow=true",
                                   "reset=[{ lower = [5, 7], upper = [11, 13], gas_content = 0 }]"}));
    const sph::Monitors monitors(s);
    const std::vector<double> first = monitors.values(s);
    for (int k = 0; k < 200; ++k) s.step();
    EXPECT_GE(range<Field::gas_content>(s).lowest, 0);
    expect_gas_kept(monitors, s, first);
  }
}

// One particle that lets nothing through, in magma that loses its gas.
TEST(HardExchanges, ASealedParticleKeepsItsGas) {
  for (const char* implicit : {"false", "true"}) {
    Simulation s(world(), sph::parse_scene(
                              still_box("gas_content = 0.03",
                                        "gas_content = 0.02\npermeability = { coefficient = 6.3e-11 }", 0.8),
                              "sealed", {"terms.implicit_gas_flow=" + std::string(implicit)}));
    const Range before = range<Field::gas_content>(s, "inside");
    for (int k = 0; k < 200; ++k) s.step();
    EXPECT_EQ(range<Field::gas_content>(s, "inside").lowest, before.lowest);
    EXPECT_EQ(range<Field::gas_content>(s, "inside").highest, before.highest);
    EXPECT_GT(range<Field::gas_content>(s, "outside").lowest, 0);
  }
}

// A hundredth of the volume is liquid.
TEST(HardExchanges, FoamOfNinetyNinePercent) {
  for (const char* implicit : {"false", "true"}) {
    Simulation s(
        world(),
        sph::parse_scene(still_box("gas_content = 0.06\npermeability = { coefficient = 6.3e-11 }",
                                   "gas_content = 0.05\npermeability = { coefficient = 6.3e-11 }", 4),
                         "foam",
                         {"start.layer.0.pressure=1e5", "terms.implicit_gas_flow=" + std::string(implicit)}));
    EXPECT_GT(range<Field::void_fraction>(s).highest, 0.99);
    const sph::Monitors monitors(s);
    const std::vector<double> first = monitors.values(s);
    for (int k = 0; k < 200; ++k) s.step();
    EXPECT_GT(range<Field::gas_content>(s).lowest, 0);
    expect_gas_kept(monitors, s, first);
  }
}

// A plug that held 100 bar is gone in one step: the magma is thrown out at hundreds of metres a second.
TEST(HardExchanges, AVentThatOpensInOneStep) {
  const std::string content =
      "gas_content = 0.02\nviscosity = 1e4\npermeability = { coefficient = 6.3e-11 }\n";
  const std::string scene =
      "kernel = { h_over_dx = 1.2 }\n[domain]\nlower = [0, -3]\nupper = [6.5, 3000]\nperiodic = [true, "
      "false]\n"
      "gravity = [0, -9.81]\nsurface_pressure = 1e5\n" +
      magma("magma", content + "becomes = [{ group = \"spray\", void_fraction_above = 0.75 }]") +
      magma("spray", "gas_content = 0.02\nviscosity = 100\npermeability = { coefficient = 6.3e-11 }") +
      "[[group]]\nname = \"floor\"\nkind = \"wall\"\n[terms]\nimplicit_viscosity = true\n[start]\nspacing = "
      "0.5\n"
      "lower = [0, -2]\nupper = [6.5, 30]\npressure = \"hydrostatic\"\n"
      "layer = [{ group = \"magma\", top = 30, pressure = \"9.9 MPa\" }]\n"
      "region = [{ group = \"floor\" }, { group = \"magma\", shape = \"box\", lower = [0, 0], upper = [6.5, "
      "30] }]\n"
      "[time]\ncfl = 0.5\nsteps = 1\n[[monitor]]\nkind = \"budget\"\n";
  for (const char* implicit : {"false", "true"}) {
    Simulation s(world(),
                 sph::parse_scene(scene, "vent", {"terms.implicit_gas_flow=" + std::string(implicit)}));
    const sph::Monitors monitors(s);
    const std::vector<double> first = monitors.values(s);
    for (int k = 0; k < 1500; ++k) s.step();
    EXPECT_GT(range<Field::gas_content>(s).lowest, 0);
    EXPECT_GT(range<Field::density>(s).lowest, 0);
    EXPECT_GT(monitors.values(s)[2], -first[1]);
    expect_gas_kept(monitors, s, first);
  }
}

/// What stops it within a hundred steps.
std::string end_of(const std::string& text, const std::vector<std::string>& more) {
  Simulation s(world(), sph::parse_scene(text, "hard", more));
  try {
    for (int k = 0; k < 100; ++k) s.step();
  } catch (const sph::GuardError& error) {
    return error.what();
  }
  return "";
}

// Hardly any of the gas is in bubbles, and none comes out of solution: pressures change tenfold faster than in equilibrium.
TEST(HardExchanges, GasThatStaysInSolution) {
  const std::string content =
      "gas_content = 0.0135\nexsolution_time = 1e9\n"
      "permeability = { law = \"kozeny_carman\", coefficient = 1e-6 }";
  Simulation s(world(), sph::parse_scene(still_box(content, content, 4), "slow",
                                         {"terms.implicit_gas_flow=true", "terms.gas_escape=false",
                                          "group.floor.gas_pressure=1.1e7"}));
  const sph::Monitors monitors(s);
  const std::vector<double> first = monitors.values(s);
  const Range pressures = range<Field::pressure>(s);
  for (int k = 0; k < 300; ++k) s.step();
  EXPECT_LE(range<Field::pressure>(s).highest, 1.1e7);
  EXPECT_GE(range<Field::pressure>(s).lowest, pressures.lowest);
  expect_gas_kept(monitors, s, first);
}

// What was bubbly takes its gas along, which does not flow where it is now.
TEST(HardExchanges, GasOfWhatIsNoLongerBubbly) {
  const std::string flows = "gas_content = 0.02\npermeability = { coefficient = 6.3e-11 }\n";
  const std::string glass =
      "[[group]]\nname = \"glass\"\nkind = \"fluid\"\ndensity = 2400\nbulk_modulus = 1e9\n";
  Simulation s(world(), sph::parse_scene(
                            still_box(flows + "becomes = [{ group = \"glass\", void_fraction_above = 0.01 }]",
                                      flows, 4) +
                                glass,
                            "glass", {"terms.implicit_gas_flow=true"}));
  const sph::Monitors monitors(s);
  const std::vector<double> first = monitors.values(s);
  for (int k = 0; k < 50; ++k) s.step();
  EXPECT_GT(range<Field::gas_content>(s, "glass").lowest, 0);
  expect_gas_kept(monitors, s, first);
}

// So much gas that it would be denser than the liquid at saturation: told of the particle, not of the law.
TEST(HardExchanges, GasThatNoLawHolds) {
  const std::string foam = "gas_content = 0.05\npermeability = { coefficient = 6.3e-11 }\n";
  const std::vector<std::string> strong{"group.outside.bulk_modulus=1e11", "group.inside.bulk_modulus=1e11"};
  for (const char* implicit : {"false", "true"}) {
    std::vector<std::string> more = strong;
    more.insert(more.end(), {"group.floor.gas_pressure=1e6", "start.layer.0.pressure=1e5",
                             "terms.implicit_gas_flow=" + std::string(implicit)});
    const std::string end = end_of(still_box(foam, foam, 4), more);
    EXPECT_NE(end.find("of which the densest gas is denser than the liquid"), std::string::npos) << end;
  }
  std::string heavy =
      still_box(foam + "becomes = [{ group = \"heavy\", void_fraction_above = 0.5 }]", foam, 4) +
      magma("heavy", "gas_content = 0.01");
  heavy.replace(heavy.rfind("5.92e10"), 7, "5.92e12");
  const std::string end = end_of(heavy, {"group.heavy.bulk_modulus=1e11", "start.layer.0.pressure=1e5"});
  EXPECT_NE(end.find("too much for \"heavy\" which it becomes"), std::string::npos) << end;
}

// Foam of a hundredth liquid that high-pressure walls fill with gas until it has more of it than liquid: no step would be
// short enough, and no advice to shorten it is given.
TEST(HardExchanges, GasThatOutweighsTheLiquid) {
  const std::string foam = "gas_content = 0.05\npermeability = { coefficient = 6.3e-11 }\n";
  for (const char* implicit : {"false", "true"}) {
    const std::string end =
        end_of(still_box(foam, foam, 4), {"group.floor.gas_pressure=3e7", "start.layer.0.pressure=1e5",
                                          "terms.implicit_gas_flow=" + std::string(implicit)});
    EXPECT_NE(end.find("more gas than liquid, which bubbly magma does not have; lower the gas_pressure of "
                       "walls, or the void fraction"),
              std::string::npos)
        << end;
    EXPECT_EQ(end.find("time.dt"), std::string::npos) << end;
  }
}

// Nothing moves, and in the first step all becomes tight: no step would be too long.
TEST(HardExchanges, GasThatNoLongerFlows) {
  const std::string flows =
      "gas_content = 0.02\npermeability = { coefficient = 6.3e-11 }\n"
      "becomes = [{ group = \"tight\", void_fraction_above = 0.01 }]";
  for (const char* implicit : {"false", "true"}) {
    const std::string end = end_of(still_box(flows, flows, 4) + magma("tight", "gas_content = 0.02"),
                                   {"terms.implicit_gas_flow=" + std::string(implicit)});
    EXPECT_NE(end.find("nothing limits the time step; give time.dt"), std::string::npos) << end;
  }
}

// Foam of a hundredth of its liquid's density, with a hundredth of its heat: steps follow from what it is.
TEST(HardExchanges, ConductionOfFoam) {
  const auto foam = [](const std::string& temperature) {
    return "gas_content = 0.05\ntemperature = " + temperature +
           "\nheat = { specific_heat = 1000, conductivity = 2 }";
  };
  const std::string box = still_box(foam("1300"), foam("1000"), 4);
  Simulation s(world(), sph::parse_scene(box, "foam", {"start.layer.0.pressure=1e5"}));
  const sph::Monitors monitors(s);
  const std::vector<double> first = monitors.values(s);
  for (int k = 0; k < 50; ++k) s.step();
  EXPECT_GE(range<Field::temperature>(s).lowest, 1000 - 1e-9);
  EXPECT_LE(range<Field::temperature>(s).highest, 1300 + 1e-9);
  EXPECT_LT(range<Field::temperature>(s).highest, 1299);
  EXPECT_NEAR(monitors.values(s)[1] / first[1], 1, 1e-13);
  // Beyond what foam bears, not beyond what the liquid does.
  try {
    Simulation(world(), sph::parse_scene(box, "foam", {"start.layer.0.pressure=1e5", "time.dt=1e5"}));
    ADD_FAILURE() << "accepted";
  } catch (const sph::InputError& error) {
    EXPECT_NE(std::string(error.what()).find("time.dt: 100000 s is above the limit of explicit conduction"),
              std::string::npos)
        << error.what();
  }
}

// Ten million times the explicit limit: what the iterations leave is a share of what the step changes, not of what an
// explicit one would.
TEST(HardExchanges, ConductionInOneStepToTheEnd) {
  const auto warm = [](const std::string& temperature) {
    return "gas_content = 0.01\ntemperature = " + temperature +
           "\nheat = { specific_heat = 1000, conductivity = 2 }";
  };
  Simulation s(world(), sph::parse_scene(still_box(warm("1300"), warm("1000"), 4), "long",
                                         {"terms.implicit_conduction=true", "time.dt=3e12"}));
  const sph::Monitors monitors(s);
  const std::vector<double> first = monitors.values(s);
  for (int k = 0; k < 3; ++k) s.step();
  EXPECT_LT(range<Field::temperature>(s).highest - range<Field::temperature>(s).lowest, 0.01);
  EXPECT_NEAR(monitors.values(s)[1] / first[1], 1, 1e-13);
}

// Rock that hardly conducts, or not at all, beside walls that radiate to 0 K: it gives what it conducts to them at most.
TEST(HardExchanges, RadiationOfWhatHardlyConducts) {
  for (const double conductivity : {0.0, 1e-6}) {
    Simulation s(world(), sph::parse_scene(
                              "kernel = { h_over_dx = 1 }\n[domain]\nlower = [0, -4]\nupper = [16, 14]\n"
                              "periodic = [true, false]\n[[group]]\nname = \"rock\"\nkind = \"fluid\"\n"
                              "density = 2500\nsound_speed = 100\ntemperature = 1500\nheat = { "
                              "specific_heat = 1000, conductivity = " +
                                  std::to_string(conductivity) +
                                  " }\n[[group]]\nname = \"wall\"\nkind = \"wall\"\n"
                                  "radiation = { emissivity = 1, temperature = 0 }\n[start]\nspacing = 1\n"
                                  "region = [{ group = \"wall\" }, { group = \"rock\", shape = \"box\", "
                                  "lower = [0, 0], upper = [16, 10] }]\n[terms]\nmotion = false\n"
                                  "[time]\nsteps = 1\ndt = 100\n[[monitor]]\nkind = \"budget\"\n",
                              "radiates", {}));
    const sph::Monitors monitors(s);
    for (int k = 0; k < 10; ++k) s.step();
    const double most = 2 * 16 * 1000 * (conductivity * 1500 / 0.5);
    EXPECT_LE(monitors.values(s)[2], 1e-9);
    EXPECT_GE(monitors.values(s)[2], -1.01 * most - 1e-6);
  }
}

}  // namespace

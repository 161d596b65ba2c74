#include <gtest/gtest.h>

#include <fstream>
#include <nlohmann/json.hpp>

#include "sph/core/error.hpp"
#include "sph/files/provenance.hpp"
#include "sph/run/report.hpp"
#include "state_fixture.hpp"

namespace sph::test {
namespace {

using decomp::Region;

Performance some_performance() {
  Performance p;
  p.label.scene = "cylinder";
  p.label.fingerprint = "00ff";
  p.loop.ranks = 8;
  p.loop.steps = 10000;
  p.loop.particles = 1020000;
  p.loop.end = {10000, 2.0, 2e-4, 1, 1, {}, {}, {}, {}, {}};
  p.loop.wall_seconds = 124.3;
  p.loop.imbalance = 1.06;
  p.events.rebuilds = 231;
  p.bytes.per_particle = 312;
  p.bytes.state_per_particle = 96;
  p.regions = {{Region::pairs, 80.1, 84.9, 88.7, 20000},
               {Region::order, 5.0, 6.0, 7.5, 231},
               {Region::contacts, 0, 0, 0, 0},
               {Region::halo_wait, 4.0, 9.1, 12.9, 20000}};
  return p;
}

TEST(Report, StatusLine) {
  Status s;
  s.global = {12000, 1.234, 1e-4, 0, 0, {}, {}, {}, {}, {}};
  s.particle_steps_per_second = 1.9e7;
  s.imbalance = 1.07;
  s.kinetic_energy = 321;
  s.seconds_left = 42 * 60 + 10;
  EXPECT_EQ(status_line(s),
            "step 12000  t 1.234 s  dt 1.0e-4  1.9e7 upd/s  imb 1.07  Ekin 3.21e+02 J  left 0:42:10");
  s.seconds_left = -1;
  s.particle_steps_per_second = 0;
  s.global.dt = 1;
  EXPECT_EQ(status_line(s),
            "step 12000  t 1.234 s  dt 1.0e0  0.0e0 upd/s  imb 1.07  Ekin 3.21e+02 J  left ?");
  s.seconds_left = 100 * 3600 + 59.7;
  EXPECT_NE(status_line(s).find("left 100:01:00"), std::string::npos);
}

TEST(Report, FinalTable) {
  const std::string table = final_table(some_performance());
  EXPECT_EQ(table.substr(0, table.find('\n')),
            "Loop 124.3 s  8 ranks  10000 steps  1.02e+06 particles  82.1 Mupd/s  10.3 Mupd/s/rank  "
            "imbalance 1.06");
  EXPECT_NE(table.find("pairs          80.100     84.900     88.700    5.7   84.9 | 20000\n"),
            std::string::npos)
      << table;
  EXPECT_EQ(table.find("contacts"), std::string::npos) << "a section that never ran";
  EXPECT_NE(table.find("work done only for the bits: 6.000 s (6.0 %)\n"), std::string::npos) << table;
  EXPECT_NE(table.find("bytes per particle: 312 (96 state)"), std::string::npos) << table;
  EXPECT_NE(table.find("list rebuilds 231 "), std::string::npos) << table;
}

TEST(Report, FinalTableOfARunThatDidNothing) {
  const std::string table = final_table({});
  EXPECT_EQ(table.find("nan"), std::string::npos) << table;
  EXPECT_EQ(table.find("inf"), std::string::npos) << table;
}

TEST(Report, PerfJsonHasTheSameNumbers) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  const ScratchDirectory scratch(comm);
  const auto path = scratch.path() / ("perf" + std::to_string(comm.rank()) + ".json");
  write_perf_json(path, some_performance());
  std::ifstream in(path);
  const nlohmann::json json = nlohmann::json::parse(in);
  EXPECT_EQ(json["steps"], 10000);
  EXPECT_EQ(json["imbalance"], 1.06);
  EXPECT_EQ(json["seconds"]["order"]["mean"], 6.0);
  EXPECT_EQ(json["build"]["hdf5"], build_info().hdf5);
  EXPECT_THROW(write_perf_json(scratch.path() / "missing" / "perf.json", {}), OutputError);
}

TEST(Report, BuildInfoIsFilledIn) {
  for (const std::string& text :
       {build_info().version, build_info().compiler, build_info().mpi, build_info().hdf5})
    EXPECT_FALSE(text.empty());
  EXPECT_EQ(build_info().mpi.find('\n'), std::string::npos);
}

}  // namespace
}  // namespace sph::test

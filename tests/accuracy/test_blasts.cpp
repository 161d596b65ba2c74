// Blasts and an implosion: gases that thin out and are compressed by more than one smoothing length could
// follow.
#include <gtest/gtest.h>
#include <unistd.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "accuracy/measure.hpp"
#include "accuracy/pinned.hpp"

namespace {

using measure::Sample;

struct Row {
  double x[3]{}, v[3]{}, mass = 1, u = 1;
};

sph::Simulation gas(const decomp::Comm& comm, const std::string& scene, int dim, const std::vector<Row>& rows,
                    std::vector<std::string> settings) {
  const std::filesystem::path file =
      std::filesystem::temp_directory_path() / ("peperite_" + std::to_string(getpid()) + ".csv");
  std::ofstream csv(file);
  csv.precision(17);
  csv << (dim == 2 ? "id,x,y,vx,vy,group,rho,mass,u\n" : "id,x,y,z,vx,vy,vz,group,rho,mass,u\n");
  int id = 0;
  for (const Row& r : rows) {
    csv << ++id;
    for (int a = 0; a < dim; ++a) csv << ',' << r.x[a];
    for (int a = 0; a < dim; ++a) csv << ',' << r.v[a];
    csv << ",0,1," << r.mass << ',' << r.u << '\n';
  }
  csv.close();
  settings.push_back("start.file=" + file.string());
  const measure::Removed removed{file};
  return sph::Simulation(comm, sph::read_scene(std::string(PEPERITE_ACCURACY_DIR) + "/" + scene, settings));
}

/// As blast.py makes it: n particles a side, energy 1 in a Gaussian in the middle of a cold gas.
sph::Simulation blast(const decomp::Comm& comm, int n, int dim, double width, double growth) {
  std::vector<Row> rows;
  double sum = 0;
  const double mass = std::pow(n, -dim);
  for (int k = 0; k < (dim == 3 ? n : 1); ++k)
    for (int j = 0; j < n; ++j)
      for (int i = 0; i < n; ++i) {
        Row r{{(i + 0.5) / n, (j + 0.5) / n, (k + 0.5) / n}, {}, mass, 0};
        double square = 0;
        for (int a = 0; a < dim; ++a) square += (r.x[a] - 0.5) * (r.x[a] - 0.5);
        r.u = std::exp(-square / (width * width));
        sum += r.u * mass;
        rows.push_back(r);
      }
  for (Row& r : rows) r.u = r.u / sum + 2.5e-5;
  const bool flat = dim == 2;
  return gas(comm, "blast.toml", dim, rows,
             {"dimension=" + std::to_string(dim), "start.spacing=" + std::to_string(1.0 / n),
              flat ? "domain.lower=[0, 0]" : "domain.lower=[0, 0, 0]",
              flat ? "domain.upper=[1, 1]" : "domain.upper=[1, 1, 1]",
              flat ? "domain.periodic=[true, true]" : "domain.periodic=[true, true, true]",
              "kernel.largest_growth=" + std::to_string(growth)});
}

struct Energies {
  double kinetic = 0, all = 0, gained = 0;  ///< gained: sum m r^2
};

Energies energies(const sph::Simulation& s) {
  Energies e;
  const double* u = s.particles().data<sph::Field::specific_energy>();
  const std::vector<Sample> all = measure::samples(s);
  for (std::size_t i = 0; i < all.size(); ++i) {
    double v2 = 0;
    for (int a = 0; a < s.scene().dim; ++a) {
      v2 += all[i].v[a] * all[i].v[a];
      e.gained += all[i].mass * (all[i].x[a] - 0.5) * (all[i].x[a] - 0.5);
    }
    e.kinetic += 0.5 * all[i].mass * v2;
    e.all += all[i].mass * (u[i] + 0.5 * v2);
  }
  return e;
}

// Of a Gaussian 0.05 wide at t = 0.1: finite volumes along the radius (blast.py, 2000 cells).
TEST(Blast, OfAGaussianKeepsItsMotion) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s = blast(comm, 64, 2, 0.05, 4);
  const double before = energies(s).all;
  measure::run_until(s, 0.1);
  const Energies after = energies(s);
  std::printf("Gaussian blast, 64 across: kinetic energy %+.1f %%, energy %+.2e\n",
              100 * (after.kinetic / 0.2058 - 1), after.all / before - 1);
  EXPECT_NEAR(PINNED(after.kinetic), 0.2058, 0.03 * 0.2058);
  EXPECT_NEAR(PINNED(after.all / before), 1, 0.01);
}

// Sedov (1959): xi, kinetic over total energy, sum m (r^2 - r_0^2) / (rho R^(D + 2)) as in blast.py.
TEST(Blast, OfAPointFollowsSedov) {
  const decomp::Comm comm(MPI_COMM_SELF);
  struct Case {
    int n, dim;
    double growth, time, xi, share, moment;
  };
  for (const Case& c :
       {Case{64, 2, 4, 0.1, 1.00402, 0.20880, 1.03383}, Case{28, 3, 2, 0.05, 1.03278, 0.21873, 1.17021}}) {
    sph::Simulation s = blast(comm, c.n, c.dim, 2.0 / c.n, c.growth);
    const Energies before = energies(s);
    double t0 = 0, r0 = 0;
    const auto radius = [&](const Energies& e) {
      return std::pow((e.gained - before.gained) / c.moment, 1.0 / (c.dim + 2));
    };
    measure::run_until(s, 0.6 * c.time);
    t0 = s.global().time, r0 = radius(energies(s));
    measure::run_until(s, c.time);
    const Energies after = energies(s);
    const double t = s.global().time, wanted = c.xi * std::pow(t, 2.0 / (c.dim + 2)), r = radius(after);
    const double exponent = std::log(r / r0) / std::log(t / t0);
    std::printf("Sedov in %dD, %d across: radius %+.2f %%, exponent %.4f, KE/E %+.1f %%, energy %+.2e\n",
                c.dim, c.n, 100 * (r / wanted - 1), exponent, 100 * (after.kinetic / after.all / c.share - 1),
                after.all / before.all - 1);
    EXPECT_NEAR(PINNED(r / wanted), 1, 0.015);
    EXPECT_NEAR(PINNED(exponent), 2.0 / (c.dim + 2), 0.015);
    EXPECT_NEAR(PINNED(after.kinetic / after.all / c.share), 1, 0.05);
  }
}

TEST(Blast, NohsImplosion) {
  const decomp::Comm comm(MPI_COMM_SELF);
  constexpr int n = 80;
  std::vector<Row> rows;
  for (int j = 0; j < n; ++j)
    for (int i = 0; i < n; ++i) {
      Row r{{(i + 0.5) * 2 / n - 1, (j + 0.5) * 2 / n - 1, 0}, {}, 4.0 / (n * n), 1.5e-6};
      const double away = std::hypot(r.x[0], r.x[1]);
      if (away >= 1) continue;
      for (int a = 0; a < 2; ++a) r.v[a] = -r.x[a] / away;
      rows.push_back(r);
    }
  sph::Simulation s = gas(comm, "noh.toml", 2, rows, {"start.spacing=" + std::to_string(2.0 / n)});
  measure::run_until(s, 0.6);
  double sum = 0;
  int count = 0;
  for (const Sample& q : measure::samples(s))
    if (const double r = std::hypot(q.x[0], q.x[1]); r > 0.05 && r < 0.15) sum += q.rho, ++count;
  std::printf("Noh's implosion, %d across: density %.2f of 16\n", n, sum / count);
  EXPECT_NEAR(PINNED(sum / count), 16, 0.09 * 16);
}

}  // namespace

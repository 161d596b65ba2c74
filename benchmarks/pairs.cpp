// Speed of the SPH step on one core, against a calibration kernel timed alternately in the same process, so
// that a figure can be compared between machines and moods of a machine. Prints, for each case, millions of
// true directed pairs a second (each pair within the support counted once a step, whatever the number of
// passes; rebuild, sorting by id and halo included) and what the canonical order of partners costs against
// lists left in the order they were found, which no application can choose.
#include <CLI/CLI.hpp>
#include <chrono>
#include <cstdio>
#include <numeric>
#include <string>
#include <vector>

#include "program.hpp"
#include "sph/core/simd.hpp"
#include "sph/pairs/fusions.hpp"
#include "sph/step/simulation.hpp"
#include "timing.hpp"

namespace {

/// Sixteen million lane-steps of the arithmetic a pair costs: sqrt, division, a chain of products and sums.
double calibration_seconds() {
  using V = sph::Simd<float>;
  V x(1.5f), sum = V::zero();
  const double start = cpu_seconds();
  for (int k = 0; k < 1'000'000; ++k) {
    const V r = sqrt(x * x + V(0.25f));
    const V f = (V(3.0f) - r) / max(r, V(1e-30f));
    sum += f * f * (x + r);
    x = x + V(1e-7f);
  }
  const double seconds = cpu_seconds() - start;
  return sum[0] > 0 ? seconds : 0;  // keeps the loop
}

struct Case {
  const char* name;
  int dim, side;
  bool stress;
  const char* precision;
};

std::string shortest(double x) {
  char text[32];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

std::string scene_text(const Case& c) {
  const std::string kind = c.stress ? "solid" : "fluid";
  const auto triple = [&](const char* a) {
    return std::string("[") + a + ", " + a + (c.dim == 3 ? std::string(", ") + a : "") + "]";
  };
  const auto flags = std::string("[true, true") + (c.dim == 3 ? ", true]" : "]");
  return "title = \"" + std::string(c.name) + "\"\ndimension = " + std::to_string(c.dim) +
         "\nprecision = \"" + c.precision + "\"\n[domain]\nlower = " + triple("0") +
         "\nupper = " + triple("1") + "\nperiodic = " + flags +
         "\n[kernel]\nh_over_dx = 0.8333333333333334\n[[group]]\nname = \"matter\"\nkind = \"" + kind +
         "\"\ndensity = 1\nsound_speed = 10\nviscosity = 0.001\n" +
         (c.stress ? "poisson_ratio = 0.25\n" : "") + "[start]\nspacing = " + shortest(1.0 / c.side) +
         "\njitter = 0.1\nvelocity = \"taylor_green\"\nflow_speed = 1\nflow_length = 1\npressure = "
         "\"taylor_green\"\n"
         "[[start.region]]\ngroup = \"matter\"\n[time]\ncfl = 0.8\nsteps = 1\n";
}

/// Directed pairs within the support, from the present lists.
double true_pairs(const sph::Simulation& s) {
  const sph::Particles& p = s.particles();
  const std::size_t d = static_cast<std::size_t>(p.dim());
  const std::int64_t* x = p.data<sph::Field::position>();
  const double reach = s.scene().support() / s.scale().quantum;
  const std::size_t lanes = static_cast<std::size_t>(s.lists().lanes());
  double pairs = 0;
  for (const sph::RowRange& range : s.sets().front().ranges)
    for (std::size_t first = range.first, b = range.first_block; first < range.last; first += lanes, ++b) {
      const auto entries = s.lists().block(b);
      for (std::size_t k = 0; k < entries.size(); ++k) {
        const std::size_t i = first + k % lanes, j = entries[k];
        if (i >= range.last || i == j) continue;
        double r2 = 0;
        for (std::size_t a = 0; a < d; ++a) {
          const double e = static_cast<double>(x[j * d + a] - x[i * d + a]);
          r2 += e * e;
        }
        pairs += r2 < reach * reach;
      }
    }
  return pairs;
}

/// A lattice numbers its particles along the rows; a real start file does not.
void shuffle_ids(sph::Particles& p) {
  auto* id = p.data<sph::Field::id>();
  std::uint64_t z = 1;
  for (std::size_t i = p.owned(); i-- > 1;) {
    z = z * 6364136223846793005u + 1442695040888963407u;
    std::swap(id[i], id[(z >> 33) % (i + 1)]);
  }
}

/// CPU seconds of all passes over all particles with the given lists.
double pass_seconds(sph::Simulation& s, sph::Particles& particles, const sph::NeighbourLists& lists,
                    const sph::RowRanges& ranges) {
  static decomp::LargeVector<std::byte> rows;
  const double start = cpu_seconds();
  for (const sph::Entry* entry : sph::entries_of(s.plan()))
    for (const sph::Stage& stage : entry->stages) {
      if (stage.fusion == nullptr) continue;
      const sph::PassContext context =
          s.physics()->constants().context(particles, lists, rows, s.global().dt);
      stage.fusion->pack(context, 0, particles.rows());
      for (const sph::RowRange& r : ranges) stage.fusion->run(context, r);
    }
  return cpu_seconds() - start;
}

void measure(const decomp::Comm& comm, const Case& c, bool shuffled) {
  sph::Simulation s(comm, sph::parse_scene(scene_text(c), c.name, {}));
  // The benchmark looks at the same particles with other lists; nothing but ids and sums is written.
  auto& particles = const_cast<sph::Particles&>(s.particles());
  if (shuffled) shuffle_ids(particles);
  for (int k = 0; k < 10; ++k) s.step();
  constexpr int block = 20, repeats = 7;
  std::vector<double> step, calibration, canonical, free_order, order_share;
  for (int r = 0; r < repeats; ++r) {
    calibration.push_back(calibration_seconds());
    const double sorting = s.timers().seconds(decomp::Region::order), wall = s.timers().total(),
                 start = cpu_seconds();
    for (int k = 0; k < block; ++k) s.step();
    step.push_back((cpu_seconds() - start) / block);
    order_share.push_back((s.timers().seconds(decomp::Region::order) - sorting) /
                          (s.timers().total() - wall));
    sph::NeighbourLists found(s.lists().lanes()), by_id(s.lists().lanes());
    sph::RowRanges ranges = s.sets().front().ranges;
    decomp::Timers ignored;
    found.build(particles, s.distribution().grid(), s.distribution().own_cells(),
                s.distribution().list_radius(), ranges, ignored, sph::PartnerOrder::as_found);
    by_id.build(particles, s.distribution().grid(), s.distribution().own_cells(),
                s.distribution().list_radius(), ranges, ignored);
    pass_seconds(s, particles, found, ranges);
    free_order.push_back(pass_seconds(s, particles, found, ranges));
    canonical.push_back(pass_seconds(s, particles, by_id, ranges));
  }
  const double n = static_cast<double>(s.particle_count()), pairs = true_pairs(s);
  const double seconds = median(step), order = median(order_share) * seconds;
  const double bits = (order + median(canonical) - median(free_order)) / (seconds - order);
  std::printf(
      "%-10s %-6s %-8s %7.0f  %6.1f ns/particle-step  %5.1f pairs  %6.1f M pairs/s  %5.2f of calibration  "
      "bits %+.1f %%\n",
      c.name, c.precision, shuffled ? "shuffled" : "lattice", n, 1e9 * seconds / n, pairs / n,
      1e-6 * pairs / seconds, seconds / pairs * 16e6 / median(calibration), 100 * bits);
  std::fflush(stdout);
}

/// The paper's own case: CPU microseconds per particle-step (Ida: 186).
void measure_cylinder(const decomp::Comm& comm, const char* path) {
  for (const char* precision : {"double", "mixed"}) {
    sph::Simulation s(comm, sph::read_scene(path, {std::string("precision=") + precision}));
    for (int k = 0; k < 200; ++k) s.step();
    std::vector<double> step;
    for (int r = 0; r < 9; ++r) {
      const double start = cpu_seconds();
      for (int k = 0; k < 200; ++k) s.step();
      step.push_back((cpu_seconds() - start) / 200);
    }
    std::printf("cylinder   %-6s           %7.0f  %6.3f CPU-microseconds/particle-step (the paper: 186)\n",
                precision, static_cast<double>(s.particle_count()),
                1e6 * median(step) / static_cast<double>(s.particle_count()));
  }
}

}  // namespace

int main(int argc, char** argv) {
  CLI::App app("Speed of the SPH step on one core", "pairs");
  std::string scene = PEPERITE_SOURCE_DIR "/apps/buoyant_cylinder/fluid.toml";
  app.add_option("scene", scene, "of the buoyant cylinder, for its time a particle")
      ->check(CLI::ExistingFile);
  if (const auto code = parse(app, argc, argv)) return *code;
  return run_under_mpi(app, argc, argv, [&] {
    const decomp::Comm comm(MPI_COMM_SELF);
    std::printf("calibration kernel: %.2f ns per 16 lane-steps\n", 1e3 * calibration_seconds());
    for (const char* precision : {"mixed", "double"})
      for (const Case& c :
           {Case{"2D stress", 2, 300, true, precision}, Case{"3D stress", 3, 44, true, precision},
            Case{"2D fluid", 2, 300, false, precision}, Case{"3D fluid", 3, 44, false, precision}}) {
        measure(comm, c, false);
        measure(comm, c, true);
      }
    measure_cylinder(comm, scene.c_str());
  });
}

#include "run/screen.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <string>
#include <vector>

#include "files/agree.hpp"
#include "run/cost.hpp"
#include "sph/files/provenance.hpp"
#include "sph/laws/contact/law.hpp"
#include "sph/laws/drag/law.hpp"
#include "sph/models/models.hpp"
#include "sph/output/monitors.hpp"
#include "sph/run/report.hpp"
#include "start/start_sounds.hpp"

namespace sph {
namespace {

double seconds(std::chrono::steady_clock::duration d) { return std::chrono::duration<double>(d).count(); }

/// Of all ranks together, and the largest over the mean.
struct Work {
  double sum = 0, imbalance = 1;
};
Work work_of(const decomp::Comm& comm, double seconds_here) {
  double sum = 0, largest = 0;
  for (double s : comm.all_gather(seconds_here)) {
    sum += s;
    largest = std::max(largest, s);
  }
  return {sum, sum > 0 ? largest * comm.size() / sum : 1};
}

const char* name_of(Formulation f) { return f == Formulation::ida ? "ida" : "conservative"; }
const char* name_of(Precision p) { return p == Precision::mixed ? "mixed" : "double"; }

/// Of the models that there are.
std::string method_of(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  std::vector<std::string> methods;
  if (simulation.physics() != nullptr)
    methods.push_back(
        fmt::format("{}, {} pairs", name_of(scene.terms.formulation), name_of(scene.terms.precision)));
  if (simulation.grains() != nullptr)
    methods.push_back(fmt::format("grains, {} contacts", scene.grains.contact.law->name));
  if (simulation.melt() != nullptr) methods.emplace_back("slow flow of melts");
  if (has_drag(scene) || scene.is_suspension())
    methods.back() += fmt::format(", {} drag", scene.grains.drag.law->word);
  return fmt::format("{}", fmt::join(methods, "; "));
}

std::string formulation_of(const Simulation& simulation) {
  const Scene& scene = simulation.scene();
  if (scene.is_suspension()) return "grains in melts";
  if (simulation.melt() != nullptr) return "slow flow of melts";
  if (simulation.physics() == nullptr) return "grains";
  if (simulation.grains() != nullptr) return "grains in a fluid";
  return name_of(scene.terms.formulation);
}

void print(const decomp::Comm& comm, const std::string& text) {
  if (comm.rank() != 0) return;
  std::fwrite(text.data(), 1, text.size(), stdout);
  std::fflush(stdout);
}

}  // namespace

Screen::Screen(Simulation& simulation, Clock::time_point launched)
    : simulation_(simulation),
      first_(simulation.global()),
      setup_seconds_(seconds(begin_ - launched)),
      last_(first_),
      last_computation_(simulation.timers().cost()) {}

void Screen::banner() const {
  const BuildInfo& build = build_info();
  const Scene& scene = simulation_.scene();
  const GlobalState& g = simulation_.global();
  std::string end;
  if (scene.time.until) end += fmt::format(" to t = {} s", *scene.time.until);
  if (scene.time.steps) end += fmt::format(" to step {}", *scene.time.steps);
  const std::string text = fmt::format(
      "peperite {} ({}), {} {}, {}, HDF5 {}\n{}: {}\n{}D, {}, {} particles, {} ranks\n"
      "from step {}, t = {} s{}, dt = {:.4g} s{}\n",
      build.version, build.git, build.compiler, build.build_type, build.mpi, build.hdf5, scene.file,
      scene.name, scene.dim, method_of(simulation_), simulation_.particle_count(), simulation_.comm().size(),
      g.step, g.time, end, g.dt,
      simulation_.physics() == nullptr
          ? ""
          : fmt::format(", c dt/h = {:.3g}",
                        simulation_.physics()->steps().courant_number(
                            g.dt, fastest_sounds(simulation_.comm(), scene, simulation_.particles()))));
  print(simulation_.comm(), text);
}

double Screen::seconds_left() const {
  const GlobalState& now = simulation_.global();
  const TimeControl& end = simulation_.scene().time;
  const double wall = seconds(Clock::now() - begin_);
  double left = -1;
  const auto consider = [&](double done, double to_do) {
    if (done <= 0) return;
    const double estimate = wall * std::max(to_do, 0.0) / done;
    left = left < 0 ? estimate : std::min(left, estimate);
  };
  if (end.until) consider(now.time - first_.time, *end.until - now.time);
  if (end.steps)
    consider(static_cast<double>(now.step - first_.step), static_cast<double>(*end.steps - now.step));
  return left;
}

void Screen::status() {
  const GlobalState& now = simulation_.global();
  const double wall = seconds(Clock::now() - last_time_);
  const double work = simulation_.timers().cost();
  Status status;
  status.global = now;
  status.particle_steps_per_second = static_cast<double>(simulation_.particle_count()) *
                                     static_cast<double>(now.step - last_.step) / std::max(wall, 1e-9);
  status.imbalance = work_of(simulation_.comm(), work - last_computation_).imbalance;
  status.kinetic_energy = kinetic_energy(simulation_);
  status.seconds_left = seconds_left();
  print(simulation_.comm(), status_line(status) + "\n");
  last_ = now;
  last_time_ = Clock::now();
  last_computation_ = work;
}

void Screen::final_report(const std::filesystem::path& dir) {
  Performance p = performance_of(simulation_);
  p.loop.wall_seconds = seconds(Clock::now() - begin_);
  p.loop.setup_seconds = setup_seconds_;
  p.loop.steps = simulation_.global().step - first_.step;
  p.label.formulation = formulation_of(simulation_);
  p.label.precision = name_of(simulation_.scene().terms.precision);
  const Work work = work_of(simulation_.comm(), simulation_.timers().cost());
  p.loop.cost_seconds = work.sum;
  p.loop.imbalance = work.imbalance;
  all_or_none(simulation_.comm(), "report", [&] {
    if (simulation_.comm().rank() == 0) write_perf_json(dir / "perf.json", p);
  });
  print(simulation_.comm(), final_table(p));
  print_fingerprint(simulation_);
}

void print_fingerprint(const Simulation& s) {
  print(s.comm(),
        fmt::format("fingerprint {} step {} t {}\n", s.fingerprint(), s.global().step, s.global().time));
}

}  // namespace sph

#include "matrix_case.hpp"

#include <algorithm>
#include <fstream>
#include <stdexcept>

#include "random_cuts.hpp"
#include "saved_state.hpp"
#include "shuffled_start.hpp"
#include "sph/checkpoint/checkpoint.hpp"
#include "sph/inspect/inspect.hpp"
#include "sph/output/snapshot.hpp"

namespace equivalence {
namespace {

namespace fs = std::filesystem;

/// Grains in a fluid or in melts do not start from files, nor do melts.
bool may_be_shuffled(const Row& row) {
  const std::string_view scene = row[Factor::scene];
  return scene != "mixture" && scene != "melts2d" && !scene.starts_with("chamber");
}

/// The scene as anybody would run it on one rank.
sph::Scene reference_scene(const Row& row) {
  sph::Scene scene = scene_of(row);
  const auto axes = scene.decomposition.cut_axes;
  scene.decomposition = {};
  scene.decomposition.cut_axes = axes;
  scene.decomposition.skin = 0.05;  // or what moves as one is hardly ever listed anew
  return scene;
}

std::string lines_of(const fs::path& path) {
  std::ifstream in(path);
  return {std::istreambuf_iterator<char>(in), {}};
}

}  // namespace

std::vector<Leg> legs_of(const Case& c, std::uint64_t seed) {
  const Row& row = c.row;
  const std::int64_t steps = c.steps.back();
  const int ranks = row.ranks();
  const std::string_view restart = row[Factor::restart];
  if (restart == "none" || steps < 2) return {{ranks, 0, steps}};
  const std::string text = to_text(row);
  const auto at =
      1 + static_cast<std::int64_t>(draw(seed, text + " step") % static_cast<std::uint64_t>(steps - 1));
  int first = ranks, second = ranks;
  if (restart == "from_one") first = 1;
  if (restart == "to_one") second = 1;
  for (std::uint64_t k = 0; restart == "other" && first == ranks; ++k)
    first = 2 + static_cast<int>(draw(seed, text + " ranks" + std::to_string(k)) % 7);
  return {{first, 0, at}, {second, at, steps}};
}

std::string Cases::key(const Row& row) {
  return std::string(row[Factor::scene]) + "_" + std::string(row[Factor::precision]);
}
fs::path Cases::run_dir(const Row& row) const { return scratch_ / ("run_" + key(row)); }
fs::path Cases::start_file(const Row& row) const { return scratch_ / ("start_" + key(row) + ".csv"); }

void Cases::prepare(const decomp::Comm& one, const Case& c) {
  fs::remove_all(run_dir(c.row));
  fs::create_directories(run_dir(c.row));
  mismatch_step_ = -1;
  Reference& reference = references_[key(c.row)];
  if (!reference.simulation) {
    reference.simulation = std::make_unique<sph::Simulation>(one, reference_scene(c.row));
    reference.start = liveliness(*reference.simulation);
    if (may_be_shuffled(c.row) && !write_shuffled_start(start_file(c.row), *reference.simulation, seed_))
      throw std::runtime_error("a position of this scene is no double: its start cannot be a file");
  }
  sph::Simulation& simulation = *reference.simulation;
  while (simulation.global().step < c.steps.back()) {
    simulation.step();
    reference.fingerprint[simulation.global().step] = simulation.fingerprint();
  }
  constexpr std::int64_t long_enough = 300;
  if (simulation.global().step >= long_enough)
    check_lively(simulation.scene(), reference.start, liveliness(simulation));
}

void Cases::set_cuts(const decomp::Comm& comm, const Row& row, const Leg& leg, sph::Scene& scene) const {
  const std::string_view cuts = row[Factor::cuts];
  sph::Decomposition& d = scene.decomposition;
  // Balanced by time, runs of a second hardly move a cut; by counts, policies decide at every rebuild.
  d.cost = cuts == "time" ? sph::CostSource::time : sph::CostSource::counts;
  d.cuts = cuts == "time"     ? sph::CutRule::literal
           : cuts == "counts" ? sph::CutRule::quasi_newton
           : cuts == "hybrid" ? sph::CutRule::hybrid
                              : sph::CutRule::fixed;
  if (comm.size() == 1 || (cuts != "chaos" && cuts != "replay")) return;

  const sph::Distribution distribution(comm, scene, sph::position_scale(scene));
  const decomp::Cuts& start = distribution.partition().cuts();
  d.chaos_seed = dividing_seed(start, draw(seed_, to_text(row) + " cuts" + std::to_string(leg.from)));
  d.cuts = cuts == "chaos" ? sph::CutRule::chaos : sph::CutRule::replay;
  if (cuts == "chaos") return;
  // Uniform cuts would not show whether a recording is followed: it is one of chaos, as long as it can be
  // used.
  d.replay = (run_dir(row) / "cuts.txt").string();
  d.record = (run_dir(row) / "followed.txt").string();
  if (comm.rank() == 0) {
    // Where particles come or go lists may be made twice a step.
    write_random_cuts(d.replay, start, d.chaos_seed, 2 * (leg.to - leg.from) + 2);
    fs::remove(d.record);  // of the leg before: a record is appended to
  }
  comm.barrier();
}

std::unique_ptr<sph::Simulation> Cases::begin(const decomp::Comm& comm, const Row& row, sph::Scene& scene,
                                              const Leg& leg) const {
  if (leg.from > 0)
    return std::make_unique<sph::Simulation>(comm, scene, sph::find_checkpoint(comm, run_dir(row)));
  if (row[Factor::order] == "shuffled" && may_be_shuffled(row)) scene.start.file = start_file(row).string();
  return std::make_unique<sph::Simulation>(comm, scene);
}

bool Cases::differs(const sph::Simulation& s, const Row& row) const {
  const std::string fingerprint = s.fingerprint();
  const bool mine =
      s.comm().rank() == 0 && fingerprint != references_.at(key(row)).fingerprint.at(s.global().step);
  return s.comm().max(std::int64_t{mine}) > 0;
}

Outcome Cases::run(const decomp::Comm& comm, const Case& c, const Leg& leg) {
  const Row& row = c.row;
  sph::Scene scene = scene_of(row);
  set_cuts(comm, row, leg, scene);
  const auto simulation = begin(comm, row, scene, leg);
  if (simulation->global().step != leg.from) throw std::runtime_error("resumed at another step");
  std::int64_t shared = 0;
  if (leg.from > 0 && differs(*simulation, row)) {
    mismatch_step_ = leg.from;
    write_state(run_dir(row) / "row.h5", *simulation);
    return {"step " + std::to_string(leg.from) + ", as it is read", 0};
  }
  while (simulation->global().step < leg.to) {
    simulation->step();
    shared += has_boundary(*simulation) ? 1 : 0;
    const std::int64_t step = simulation->global().step;
    if (!std::binary_search(c.steps.begin(), c.steps.end(), step)) continue;
    if (!differs(*simulation, row)) continue;
    write_state(run_dir(row) / "row.h5", *simulation);
    mismatch_step_ = step;
    return {"step " + std::to_string(step), simulation->rebuilds()};
  }
  if (leg.to - leg.from >= 100) check_shared_out(*simulation, shared);
  if (leg.to < c.steps.back()) write_restart(run_dir(row), *simulation, 0);
  Outcome outcome{"", simulation->rebuilds()};
  if (comm.rank() == 0 && !scene.decomposition.record.empty() &&
      !lines_of(scene.decomposition.replay).starts_with(lines_of(scene.decomposition.record)))
    outcome.mismatch = "the cuts do not follow the recording";
  return outcome;
}

std::string Cases::explain(const decomp::Comm& one, const Row& row) const {
  if (mismatch_step_ < 0) return "";
  sph::Simulation simulation(one, reference_scene(row));
  while (simulation.global().step < mismatch_step_) simulation.step();
  write_state(run_dir(row) / "reference.h5", simulation);
  const std::string fields = sph::first_difference(run_dir(row) / "reference.h5", run_dir(row) / "row.h5");
  return fields.empty() ? "the particles agree: walls or contact histories differ" : fields;
}

}  // namespace equivalence

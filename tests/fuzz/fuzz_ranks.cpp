// The hands of bit_fuzz: one MPI program on 8 ranks that reads cases, one JSON object a line, and says what
// became of them. A case is a scene, run on one rank as anybody would, and rows: the same scene on k ranks
// with other cuts, lists, messages and restarts. Rows are not judged here: bit_fuzz compares them with the
// run on one rank.
//
//   {"case": "7", "scene": FILE, "folder": DIR, "steps": [1, 9], "rows": [{"ranks": 5, "set":
//   ["decomposition.skin=0"],
//    "cuts": "chaos", "seed": 3, "shuffle": true, "restart": {"at": 4, "ranks": 2, "files": 3}}, ...]}
//
// A row that cannot have so many ranks gets as many as its cells allow. An error on all ranks is an outcome
// like any other; one on some ranks leaves the rest waiting for ever, so that the program says so and ends.
#include <mpi.h>

#include <chrono>
#include <iostream>
#include <nlohmann/json.hpp>

#include "../system/factors.hpp"
#include "../system/first_ranks.hpp"
#include "../system/matrix_scenes.hpp"
#include "../system/random_cuts.hpp"
#include "../system/saved_state.hpp"
#include "../system/shuffled_start.hpp"
#include "agreed.hpp"
#include "keys/all_keys.hpp"
#include "keys/law_keys.hpp"
#include "sph/checkpoint/checkpoint.hpp"

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using namespace equivalence;
using fuzz::Report;

struct Outcome {
  Report report;
  int ranks = 1;
  json fingerprints = json::object();  ///< by step
  std::int64_t particles = 0, rebuilds = 0, migrated = 0, shared = 0;
};

json to_json(const Outcome& o, double seconds) {
  return {{"code", o.report.code},          {"text", o.report.text},    {"ranks", o.ranks},
          {"fingerprints", o.fingerprints}, {"particles", o.particles}, {"rebuilds", o.rebuilds},
          {"migrated", o.migrated},         {"shared", o.shared},       {"seconds", seconds}};
}

std::vector<std::string> texts(const json& object, const char* key) {
  return object.value(key, std::vector<std::string>{});
}

class Bench {
 public:
  explicit Bench(const decomp::Comm& world)
      : world_(world), comms_(std::make_unique<SubComms>(world)), scratch_(world, "bit_fuzz") {}

  void run(const json& c) {
    json said{{"case", c.at("case")}, {"rows", json::array()}};
    Outcome reference;
    const auto begin = std::chrono::steady_clock::now();
    const auto seconds = [&] {
      return std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    };
    if (world_.rank() == 0) reference = on_one_rank(c);
    // Said first: it is what a row is judged by whose ranks do not all live.
    if (world_.rank() == 0)
      std::cout << json{{"case", c.at("case")}, {"reference", to_json(reference, seconds())}}.dump()
                << std::endl;
    sleep_until_all_are_here(world_.get());
    const bool runs = world_.max(std::int64_t{reference.report.code}) != fuzz::code_input;
    for (std::size_t k = 0; runs && k < c.at("rows").size(); ++k) {
      const double start = seconds();
      const Outcome outcome = row(c, c.at("rows")[k], k);
      said["rows"].push_back(to_json(outcome, seconds() - start));
    }
    if (world_.rank() == 0) std::cout << said.dump() << std::endl;
  }

 private:
  static std::vector<std::int64_t> steps_of(const json& c) { return c.at("steps"); }

  static void advance(sph::Simulation& simulation, const std::vector<std::int64_t>& compared, std::int64_t to,
                      Outcome& outcome) {
    while (simulation.global().step < to) {
      simulation.step();
      outcome.shared += has_boundary(simulation) ? 1 : 0;
      const std::int64_t step = simulation.global().step;
      if (std::binary_search(compared.begin(), compared.end(), step))
        outcome.fingerprints[std::to_string(step)] = simulation.fingerprint();
    }
    outcome.rebuilds += simulation.rebuilds();
    outcome.migrated += simulation.distribution().migrated();
  }

  Outcome on_one_rank(const json& c) {
    Outcome outcome;
    fs::remove(start_file());
    outcome.report = fuzz::agreed(*comms_->first(1), c.at("case"), [&] {
      const sph::Scene scene = sph::read_scene(c.at("scene"), {});
      sph::Simulation simulation(*comms_->first(1), scene);
      outcome.particles = simulation.particle_count();
      if (std::any_of(c.at("rows").begin(), c.at("rows").end(),
                      [](const json& r) { return r.value("shuffle", false); }))
        (void)write_shuffled_start(start_file(), simulation, 1);  // scene_of() looks for it
      const std::vector<std::int64_t> steps = steps_of(c);
      advance(simulation, steps, steps.back(), outcome);
    });
    return outcome;
  }

  [[nodiscard]] fs::path start_file() const { return scratch_.path() / "shuffled.csv"; }

  sph::Scene scene_of(const json& c, const json& r) const {
    sph::Scene scene = sph::read_scene(c.at("scene"), texts(r, "set"));
    if (r.value("shuffle", false) && fs::exists(start_file())) scene.start.file = start_file().string();
    return scene;
  }

  /// As many ranks as the row asks for, or as its cells allow.
  int ranks_for(const sph::Scene& scene, int wanted) const {
    const sph::Distribution alone(*comms_->first(1), scene, sph::position_scale(scene));
    const decomp::Int3& cells = alone.grid().cells();
    const auto [row, column] = scene.decomposition.cut_axes;
    return static_cast<int>(std::min<std::int64_t>(
        wanted,
        decomp::max_ranks(cells[static_cast<std::size_t>(row)], cells[static_cast<std::size_t>(column)])));
  }

  void set_cuts(const json& c, const json& r, const decomp::Comm& comm, sph::Scene& scene,
                std::size_t leg) const {
    const std::string cuts = r.value("cuts", "");
    if (cuts != "chaos" && cuts != "replay") return;
    sph::Decomposition& d = scene.decomposition;
    d.cuts = sph::CutRule::chaos;
    d.chaos_seed = r.at("seed").get<std::uint64_t>() + leg;
    if (comm.size() == 1) return;
    const sph::Distribution distribution(comm, scene, sph::position_scale(scene));
    const decomp::Cuts& start = distribution.partition().cuts();
    constexpr std::uint64_t attempts = 20;
    d.chaos_seed = dividing_seed(start, d.chaos_seed, attempts);
    if (cuts == "chaos") return;
    d.cuts = sph::CutRule::replay;
    d.replay = (scratch_.path() / "cuts.txt").string();
    d.record = (scratch_.path() / "followed.txt").string();
    if (comm.rank() == 0) write_random_cuts(d.replay, start, d.chaos_seed, 2 * steps_of(c).back() + 2);
    comm.barrier();
  }

  Outcome row(const json& c, const json& r, std::size_t number) {
    Outcome outcome;
    const std::vector<std::int64_t> steps = steps_of(c);
    const std::string name = c.at("case").get<std::string>() + " row " + std::to_string(number);
    struct Leg {
      int ranks;
      std::int64_t to;
    };
    std::vector<Leg> legs{Leg{r.at("ranks").get<int>(), steps.back()}};
    int files = 0;
    if (r.contains("restart")) {
      const json& restart = r.at("restart");
      files = restart.at("files").get<int>();
      legs.front().to = restart.at("at").get<std::int64_t>();
      legs.push_back({restart.at("ranks").get<int>(), steps.back()});
    }
    for (std::size_t leg = 0; leg < legs.size() && outcome.report.code == 0; ++leg) {
      std::int64_t ranks = 0;
      if (world_.rank() == 0)
        outcome.report = fuzz::agreed(*comms_->first(1), name, [&] {
          if (leg == 0) fs::remove_all(scratch_.path() / "run");
          ranks = ranks_for(scene_of(c, r), legs[leg].ranks);
        });
      sleep_until_all_are_here(world_.get());
      ranks = world_.max(ranks);
      if (ranks > world_.rank() && outcome.report.code == 0)
        outcome.report = fuzz::agreed(*comms_->first(static_cast<int>(ranks)), name, [&] {
          stretch(c, r, *comms_->first(static_cast<int>(ranks)), leg, legs[leg].to, files, outcome);
        });
      outcome.ranks = std::max(outcome.ranks, static_cast<int>(ranks));
      sleep_until_all_are_here(world_.get());
      outcome.report.code = static_cast<int>(world_.max(std::int64_t{outcome.report.code}));
      // Messages may be under way that nobody will receive.
      if (outcome.report.code != 0) comms_ = std::make_unique<SubComms>(world_);
    }
    outcome.migrated = world_.sum(outcome.migrated);
    outcome.shared = world_.sum(outcome.shared);
    return outcome;
  }

  void stretch(const json& c, const json& r, const decomp::Comm& comm, std::size_t leg, std::int64_t to,
               int files, Outcome& outcome) {
    sph::Scene scene = scene_of(c, r);
    set_cuts(c, r, comm, scene, leg);
    const fs::path dir = scratch_.path() / "run";
    if (comm.rank() == 0) fs::create_directories(dir);
    const auto simulation =
        leg == 0 ? std::make_unique<sph::Simulation>(comm, scene)
                 : std::make_unique<sph::Simulation>(comm, scene, sph::find_checkpoint(comm, dir));
    advance(*simulation, steps_of(c), to, outcome);
    if (to < steps_of(c).back()) write_restart(dir, *simulation, files);
  }

  const decomp::Comm& world_;
  std::unique_ptr<SubComms> comms_;
  Scratch scratch_;
};

void print_keys() {
  for (const sph::keys::KeyTable* table : sph::keys::all)
    for (const sph::keys::Key& key : sph::keys::keys_of(*table))
      std::cout << table->name << (table->name.empty() ? "" : ".") << key.name << '\n';
}

}  // namespace

int main(int argc, char** argv) {
  const std::string option = argc > 1 ? argv[1] : "";
  if (option == "--keys") {
    print_keys();
    return 0;
  }
  if (option == "--help") {
    std::cout << "fuzz_ranks: runs the cases that bit_fuzz writes to it, a line each, on 8 ranks; --keys "
                 "lists those of a scene\n";
    return 0;
  }
  if (!option.empty()) {
    std::cerr << "fuzz_ranks: unknown option " << option << "; see --help\n";
    return 2;
  }
  MPI_Init(&argc, &argv);
  try {
    const decomp::Comm world(MPI_COMM_WORLD);
    if (world.size() != most_ranks) throw std::runtime_error("the cases run on 8 ranks");
    Bench bench(world);
    for (std::string line;;) {
      if (world.rank() == 0 && !std::getline(std::cin, line)) line.clear();
      sleep_until_all_are_here(world.get());
      line = world.broadcast(line, 0);
      if (line.empty()) break;
      bench.run(json::parse(line));
    }
  } catch (const std::exception& error) {
    std::cerr << "fuzz_ranks: " << error.what() << std::endl;
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
  return 0;
}

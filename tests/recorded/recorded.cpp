// The bits of the scenes in fingerprints.json are those recorded there, on any machine, compiler and number
// of ranks: what changes the code and not the physics changes none of them, and what changes the physics says
// so by a new list.
//
//   recorded FILE [--write] [--only TEXT]   --write: record the bits of now; --only: scenes whose names hold
//   TEXT
//
// An entry names a scene of the equivalence matrix ("matrix", "precision") or a file and what is set in it
// ("scene", "set"), and after how many steps its fingerprint is taken.
#include <mpi.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>
#include <string>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/run/self_check.hpp"
#include "sph/scene/scene.hpp"
#include "sph/step/simulation.hpp"
#include "system/matrix_scenes.hpp"

namespace {

using Json = nlohmann::ordered_json;

struct Options {
  std::string file, only;
  bool write = false, help = false;
};

constexpr const char* usage =
    "recorded FILE [--write] [--only TEXT]: are the bits of the scenes in FILE those recorded there?";

Options parse(int argc, char** argv) {
  Options o;
  for (int k = 1; k < argc; ++k) {
    const std::string word = argv[k];
    if (word == "--help" || word == "-h")
      o.help = true;
    else if (word == "--write")
      o.write = true;
    else if (word == "--only" && k + 1 < argc)
      o.only = argv[++k];
    else if (o.file.empty() && !word.starts_with("-"))
      o.file = word;
    else
      throw std::runtime_error("unknown option " + word);
  }
  if (o.file.empty() && !o.help) throw std::runtime_error("no file is given");
  return o;
}

std::string name_of(const Json& entry) {
  if (entry.contains("matrix"))
    return entry["matrix"].get<std::string>() + " " + entry["precision"].get<std::string>();
  std::string name = entry["scene"];
  for (const std::string set : entry["set"]) name += " " + set;
  return name;
}

sph::Scene scene_of(const Json& entry) {
  if (entry.contains("matrix"))
    return equivalence::scene_of(
        equivalence::row_from_text("scene=" + entry["matrix"].get<std::string>() +
                                   " precision=" + entry["precision"].get<std::string>() +
                                   " ranks=2 cuts=uniform overlap=on order=placed list=large restart=none"));
  return sph::read_scene(std::string(PEPERITE_SOURCE_DIR) + "/" + entry["scene"].get<std::string>(),
                         entry["set"].get<std::vector<std::string>>());
}

std::string fingerprint_of(const decomp::Comm& comm, const Json& entry) {
  sph::Simulation simulation(comm, scene_of(entry));
  for (std::int64_t step = 0; step < entry["steps"].get<std::int64_t>(); ++step) simulation.step();
  return simulation.fingerprint();
}

int run(const decomp::Comm& comm, const Options& options) {
  Json list = Json::parse(std::ifstream(options.file));
  int checked = 0, differ = 0;
  for (Json& entry : list) {
    const std::string name = name_of(entry);
    if (name.find(options.only) == std::string::npos) continue;
    const std::string print = fingerprint_of(comm, entry);
    ++checked;
    if (options.write)
      entry["fingerprint"] = print;
    else if (comm.rank() == 0 && entry["fingerprint"] != print) {
      ++differ;
      std::printf("%s, %s steps: %s, recorded %s\n", name.c_str(), entry["steps"].dump().c_str(),
                  print.c_str(), entry["fingerprint"].get<std::string>().c_str());
      std::fflush(stdout);
    }
  }
  if (comm.rank() != 0) return 0;
  if (options.write) std::ofstream(options.file) << list.dump(1) << '\n';
  std::printf("%d scenes, %d with other bits than those recorded\n", checked, differ);
  return differ == 0 && checked > 0 ? 0 : 1;
}

}  // namespace

int main(int argc, char** argv) {
  Options options;
  try {
    options = parse(argc, argv);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "recorded: error: %s (see --help)\n", error.what());
    return 2;
  }
  if (options.help) {
    std::puts(usage);
    return 0;
  }
  MPI_Init(&argc, &argv);
  int status = 0;
  try {
    sph::self_check();
    status = run(decomp::Comm(MPI_COMM_WORLD), options);
  } catch (const std::exception& error) {
    std::fprintf(stderr, "recorded: %s\n", error.what());
    MPI_Abort(MPI_COMM_WORLD, 1);
  }
  MPI_Finalize();
  return status;
}

// The partition and its balancers without particles, on as many ranks as asked for; and what a step would
// take.
//
//     build/bin/scale_sim policies [--ranks 16 64 256 484] [--noise 0.02] [--slow-rank R] [--calls 300]
//     build/bin/scale_sim scaling RUN [--ranks 1000 10000 100000]    RUN: folder of a run on few ranks
//     build/bin/scale_sim check RUN...                               the model beside runs that were done
//     build/bin/scale_sim flow [--ranks 1000 10000 100000] [--tiles 2]  a flow of melts
//     mpirun -n 4 build/bin/scale_sim flow --check                   what it sends beside what it was said to
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <algorithm>

#include "../program.hpp"
#include "commands.hpp"

namespace {

void add_network(CLI::App* command, scale_sim::Network& network) {
  command->add_option("--latency", network.latency, "of a message [s]")->check(CLI::PositiveNumber);
  command->add_option("--bandwidth", network.bandwidth, "of a rank while all send [bytes/s]")
      ->check(CLI::PositiveNumber);
  command->add_option("--disk", network.disk, "of the file system [bytes/s]")->check(CLI::PositiveNumber);
}

CLI::App* add_flow(CLI::App& app, scale_sim::FlowPrediction& flow) {
  CLI::App* of_melts = app.add_subcommand("flow", "one flow of melts by the model");
  of_melts->add_option("--ranks", flow.ranks, "numbers of ranks")->check(CLI::Range(2, 1 << 30));
  of_melts->add_option("--iterations", flow.iterations, "of the solver")->check(CLI::Range(1, 40));
  of_melts->add_option("--cells", flow.cells, "across the grid that is measured")->check(CLI::Range(16, 512));
  of_melts->add_option("--tiles", flow.tiles, "columns of 8 x 8 cells a rank, at least")
      ->check(CLI::PositiveNumber);
  of_melts->add_flag("--check", flow.check, "one flow, counted, on the ranks that there are");
  return of_melts;
}

}  // namespace

int main(int argc, char** argv) {
  using namespace scale_sim;
  CLI::App app("Balancers and scaling without particles", "scale_sim");
  app.require_subcommand(1);
  Network network;

  PolicyTable table;
  CLI::App* policies = app.add_subcommand("policies", "balancers on synthetic costs");
  policies->add_option("--ranks", table.ranks, "numbers of ranks")->check(CLI::PositiveNumber);
  policies->add_option("--noise", table.noise, "of a measured time, relative")->check(CLI::Range(0.0, 0.5));
  policies->add_option("--slow-rank", table.slow_rank, "this rank has half the speed");
  policies->add_option("--calls", table.calls, "of the policy")->check(CLI::Range(3, 100000));

  Scaling scaling;
  CLI::App* predict = app.add_subcommand("scaling", "weak and strong scaling by the model");
  predict->add_option("run", scaling.run, "folder of a finished run on few ranks")
      ->required()
      ->check(CLI::ExistingDirectory);
  predict->add_option("--ranks", scaling.ranks, "numbers of ranks")->check(CLI::PositiveNumber);
  predict->add_option("--particles-per-rank", scaling.particles_per_rank, "of the weak scaling")
      ->check(CLI::PositiveNumber);
  predict->add_option("--particles", scaling.particles, "of the strong scaling")->check(CLI::PositiveNumber);
  add_network(predict, network);

  std::vector<std::filesystem::path> runs;
  CLI::App* check = app.add_subcommand("check", "the model beside runs that were done");
  check->add_option("run", runs, "folders; the first gives the costs of a particle")
      ->required()
      ->check(CLI::ExistingDirectory);
  add_network(check, network);

  FlowPrediction flow;
  CLI::App* of_melts = add_flow(app, flow);
  add_network(of_melts, network);
  if (const auto code = parse(app, argc, argv)) return *code;

  if (table.slow_rank >= *std::ranges::min_element(table.ranks))
    return refuse(app, fmt::format("--slow-rank: there is no rank {}", table.slow_rank));
  if (*of_melts) {
    flow.network = network;
    return run_under_mpi(app, argc, argv, [&] { predict_flow(flow); });
  }
  try {
    if (*policies) compare_policies(table);
    scaling.network = network;
    if (*predict) predict_scaling(scaling);
    if (*check) check_model(runs, network);
  } catch (const std::exception& error) {
    return refuse(app, error.what());
  }
}

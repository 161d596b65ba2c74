// The model beside runs: halo, balance and work of a partition from where the particles are.
#include <fmt/format.h>
#include <hdf5.h>

#include <algorithm>
#include <array>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

#include "commands.hpp"
#include "decomp/cut_policy.hpp"

namespace scale_sim {
namespace {

using namespace decomp;
namespace fs = std::filesystem;

/// Positions [m] of the last snapshot in the folder, `dim` a particle.
std::vector<double> last_positions(const fs::path& run, std::size_t dim) {
  fs::path last;
  for (const auto& entry : fs::directory_iterator(run))
    if (entry.path().filename().string().starts_with("snapshot_")) last = std::max(last, entry.path());
  const hid_t file = H5Fopen(last.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT);
  if (file < 0) throw std::runtime_error("no snapshot in " + run.string());
  const hid_t data = H5Dopen2(file, "/particles/position", H5P_DEFAULT), space = H5Dget_space(data);
  std::vector<double> x(static_cast<std::size_t>(H5Sget_simple_extent_npoints(space)));
  const herr_t read = H5Dread(data, H5T_NATIVE_DOUBLE, H5S_ALL, H5S_ALL, H5P_DEFAULT, x.data());
  H5Sclose(space);
  H5Dclose(data);
  H5Fclose(file);
  if (read < 0 || x.size() % dim != 0) throw std::runtime_error(last.string() + ": cannot read positions");
  return x;
}

struct Recorded {
  CellCosts particles;
  Cuts cuts;
  Layout layout;
};

Recorded recorded(const fs::path& run, const nlohmann::json& perf) {
  const auto& cells = perf.at("cells");
  const auto number = cells.at("number").get<std::array<std::int64_t, 3>>();
  const auto origin = cells.at("origin").get<std::array<double, 3>>();
  const auto edge = cells.at("edge").get<std::array<double, 3>>();
  const auto periodic = cells.at("periodic").get<std::array<bool, 3>>();
  const auto axes = cells.at("cut_axes").get<std::array<std::size_t, 2>>();
  const std::size_t dim = edge[2] > 0 ? 3 : 2, third = 3 - axes[0] - axes[1];
  const std::vector<double> x = last_positions(run, dim);
  const CellColumns columns{number[axes[0]], number[axes[1]]};
  std::vector<double> count(static_cast<std::size_t>(columns.size()));
  for (std::size_t i = 0; i < x.size(); i += dim) {
    const auto cell = [&](std::size_t a) {
      const auto c = static_cast<std::int64_t>((x[i + a] - origin[a]) / edge[a]);
      return std::clamp<std::int64_t>(c, 0, number[a] - 1);
    };
    ++count[columns.index(cell(axes[0]), cell(axes[1]))];
  }
  return {CellCosts(columns, count),
          cuts_from_text(cells.at("cuts")),
          {.periodic = {periodic[axes[0]], periodic[axes[1]]},
           .third = dim == 3 && periodic[third] ? static_cast<double>(number[third]) : 0}};
}

}  // namespace

void check_model(const std::vector<fs::path>& runs, const Network& network) {
  const Code code = read_code(runs.front() / "perf.json");
  fmt::print(
      "         halo copies/particle  largest part/mean        CPU seconds, all ranks\n"
      "  ranks  model  measured     model  measured (time)    model  measured\n");
  for (const fs::path& run : runs) {
    std::ifstream in(run / "perf.json");
    if (!in) throw std::runtime_error("cannot read " + (run / "perf.json").string());
    const auto perf = nlohmann::json::parse(in);
    const Recorded r = recorded(run, perf);
    const Step step = predict(r.particles, r.cuts, r.layout, code, network);
    const double ranks = perf.at("ranks"), steps = perf.at("steps");
    const double migrating = perf.at("seconds").at("migrate").at("mean");  // waiting for others included
    const double cpu = perf.at("cost_seconds").get<double>() + (ranks > 1 ? 0 : migrating);
    fmt::print("{:7} {:6.3f} {:9.3f} {:9.3f} {:16.3f} {:9.2f} {:9.2f}\n", ranks, step.halo,
               perf.at("halo_per_particle").get<double>(), step.imbalance, perf.at("imbalance").get<double>(),
               step.cpu * steps, cpu);
  }
}

}  // namespace scale_sim

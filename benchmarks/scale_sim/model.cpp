#include "model.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <fstream>
#include <nlohmann/json.hpp>
#include <stdexcept>

namespace scale_sim {
namespace {

using namespace decomp;

/// Bytes of the checkpoint beside perf.json.
double checkpoint_bytes(const std::filesystem::path& run) {
  double sum = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(run / "checkpoint"))
    if (entry.is_regular_file()) sum += static_cast<double>(entry.file_size());
  return sum;
}

/// Sum over rows [r0, r1) and columns [c0, c1), which may reach beyond the grid: round it, or into nothing.
double wrapped_sum(const CellCosts& costs, const Layout& layout, std::int64_t r0, std::int64_t r1,
                   std::int64_t c0, std::int64_t c1) {
  double sum = 0;
  const auto pieces = [](std::int64_t lo, std::int64_t hi, std::int64_t cells, bool periodic) {
    std::vector<std::array<std::int64_t, 2>> out{{std::max<std::int64_t>(lo, 0), std::min(hi, cells)}};
    if (periodic && lo < 0) out.push_back({cells + lo, cells});
    if (periodic && hi > cells) out.push_back({0, hi - cells});
    return out;
  };
  for (const auto& r : pieces(r0, r1, costs.rows(), layout.periodic[0]))
    for (const auto& c : pieces(c0, c1, costs.columns(), layout.periodic[1]))
      sum += costs.sum(r[0], r[1], c[0], c[1]);
  return sum;
}

}  // namespace

Code read_code(const std::filesystem::path& perf_json) {
  std::ifstream in(perf_json);
  if (!in) throw std::runtime_error("cannot read " + perf_json.string());
  Code code;
  try {
    const auto perf = nlohmann::json::parse(in);
    const double ranks = perf.at("ranks"), particles = perf.at("particles"), steps = perf.at("steps");
    const double rebuilds = perf.at("rebuilds"), halo = perf.at("halo_per_particle");
    const auto seconds = [&](const char* region) -> double {
      return ranks * perf.at("seconds").at(region).at("mean").get<double>();
    };
    code.particle = (seconds("pairs") + seconds("update") + seconds("contacts")) / (particles * steps);
    code.halo_row = halo > 0 ? seconds("pack") / (halo * particles * steps) : 0;
    code.rebuild_row = (seconds("lists") + seconds("migrate") + seconds("order")) / (particles * rebuilds);
    code.rebuild_every = steps / rebuilds;
    code.refresh_bytes = perf.at("refresh_bytes");
    code.refreshes = perf.at("refreshes").get<double>() / steps;
    code.memory = perf.at("peak_rank_bytes").get<double>() * ranks / particles;
    code.row = perf.at("bytes_per_halo_particle");
    code.setup = perf.at("setup_seconds").get<double>() * ranks / particles;
    code.checkpoint = checkpoint_bytes(perf_json.parent_path()) / particles;
  } catch (const std::exception& error) {
    throw std::runtime_error(perf_json.string() + ": " + error.what());
  }
  return code;
}

Step predict(const CellCosts& particles, const Cuts& cuts, const Layout& layout, const Code& code,
             const Network& network) {
  Step step;
  const double ranks = static_cast<double>(part_count(cuts)), mean = particles.total() / ranks;
  double last = 0, halos = 0;
  for (std::size_t r = 0; r < cuts.column.size(); ++r)
    for (std::size_t c = 0; c + 1 < cuts.column[r].size(); ++c) {
      const std::int64_t r0 = cuts.row[r], r1 = cuts.row[r + 1], c0 = cuts.column[r][c],
                         c1 = cuts.column[r][c + 1];
      const double own = particles.sum(r0, r1, c0, c1);
      const double grown = wrapped_sum(particles, layout, r0 - 1, r1 + 1, c0 - 1, c1 + 1);
      const double halo = grown * (layout.third > 0 ? 1 + 2 / layout.third : 1) - own;
      const bool thin = r1 - r0 < 3 || c1 - c0 < 3;
      const double interior = thin ? 0 : particles.sum(r0 + 1, r1 - 1, c0 + 1, c1 - 1);
      // About eight neighbours; their messages go out at once, and what they bring comes in.
      const double messages =
          code.refreshes * 8 * network.latency + halo * code.refresh_bytes / network.bandwidth;
      Step s;
      s.compute = own * code.particle;
      s.pack = halo * code.halo_row;
      s.messages = messages;
      s.exposed = std::max(0.0, messages - interior * code.particle);
      s.rebuild = own * code.rebuild_row / code.rebuild_every;
      halos += halo;
      step.cpu += s.compute + s.pack + s.rebuild;
      step.imbalance = std::max(step.imbalance, own / mean);
      step.largest_halo = std::max(step.largest_halo, halo);
      step.memory = std::max(step.memory, own * code.memory + halo * code.row);
      if (s.total() <= last) continue;
      last = s.total();
      step.compute = s.compute, step.pack = s.pack, step.exposed = s.exposed, step.rebuild = s.rebuild;
      step.messages = s.messages;
    }
  step.halo = halos / particles.total();
  step.reduce = 2 * network.latency * static_cast<double>(std::bit_width(part_count(cuts) - 1));
  return step;
}

}  // namespace scale_sim

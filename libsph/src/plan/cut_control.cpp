#include "sph/plan/cut_control.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <system_error>
#include <utility>

#include "sph/core/error.hpp"

namespace sph {
namespace {

std::unique_ptr<decomp::CutPolicy> make_policy(const Decomposition& d) {
  switch (d.cuts) {
    case CutRule::literal:
      return decomp::make_literal();
    case CutRule::quasi_newton:
      return decomp::make_quasi_newton();
    case CutRule::hybrid:
      return decomp::make_hybrid();
    case CutRule::chaos:
      return decomp::make_chaos(d.chaos_seed);
    case CutRule::replay: {
      std::error_code none;  // a pipe would be opened for ever
      std::ifstream in;
      if (std::filesystem::is_regular_file(d.replay, none)) in.open(d.replay);
      if (!in.is_open()) throw InputError("decomposition.replay: cannot read '" + d.replay + "'");
      std::vector<decomp::Cuts> cuts;
      for (std::string line; std::getline(in, line);) cuts.push_back(decomp::cuts_from_text(line));
      return decomp::make_replay(std::move(cuts));
    }
    case CutRule::fixed:
      break;
  }
  return decomp::make_fixed();
}

decomp::CutLimits limits_of(const decomp::CellGrid& grid, const Scene& scene) {
  const auto [row, column] = scene.decomposition.cut_axes;
  return {grid.cells()[static_cast<std::size_t>(row)], grid.cells()[static_cast<std::size_t>(column)]};
}

}  // namespace

CutControl::CutControl(const decomp::CellGrid& grid, const Scene& scene)
    : scene_(scene),
      // The literal rule goes one cell a call, so it is called at each rebuild.
      balancer_(make_policy(scene.decomposition), limits_of(grid, scene),
                scene.decomposition.cost == CostSource::time &&
                    (scene.decomposition.cuts == CutRule::quasi_newton ||
                     scene.decomposition.cuts == CutRule::hybrid)) {}

decomp::Cuts CutControl::first(const decomp::Comm& comm, const decomp::CellGrid& grid,
                               std::span<const ParticleSet> sets) const {
  return balancer_.first(comm, counts_of(grid, sets, {}));
}

std::optional<decomp::Cuts> CutControl::next(const decomp::Comm& comm, const decomp::JaggedPartition& now,
                                             double cost_seconds, std::span<const ParticleSet> sets,
                                             const PairCounts& pairs) {
  const double cost =
      scene_.decomposition.cost == CostSource::time ? cost_seconds : static_cast<double>(owned_rows(sets));
  return balancer_.next(comm, now.cuts(), cost, counts_of(now.grid(), sets, pairs));
}

void CutControl::record(int rank, const decomp::Cuts& cuts) {
  const std::string& file = scene_.decomposition.record;
  if (file.empty() || rank != 0) return;
  if (!record_.is_open()) record_.open(file, std::ios::app);  // the run has made it, see run_directory.hpp
  record_ << decomp::to_text(cuts) << '\n' << std::flush;
  if (!record_) throw OutputError("decomposition.record: cannot write " + file);
}

decomp::Balancer::CountCells CutControl::counts_of(const decomp::CellGrid& grid,
                                                   std::span<const ParticleSet> sets,
                                                   const PairCounts& pairs) const {
  return [&, sets](const decomp::CellColumns& columns, std::span<std::int64_t> rows,
                   std::span<std::int64_t> of_pairs) {
    const auto row = static_cast<std::size_t>(scene_.decomposition.cut_axes[0]);
    const auto column = static_cast<std::size_t>(scene_.decomposition.cut_axes[1]);
    for (std::size_t set = 0; set < sets.size(); ++set) {
      const Particles& particles = sets[set].particles;
      const std::size_t d = static_cast<std::size_t>(particles.dim());
      const std::int64_t* x = particles.data<Field::position>();
      const std::vector<std::uint32_t> listed = pairs ? pairs(set) : std::vector<std::uint32_t>();
      for (std::size_t i = 0; i < particles.owned(); ++i) {
        decomp::Int3 p{};
        for (std::size_t a = 0; a < d; ++a) p[a] = x[i * d + a];
        const decomp::Int3 cell = grid.cell_of(p);
        const std::size_t at = columns.index(cell[row], cell[column]);
        ++rows[at];
        if (i < listed.size()) of_pairs[at] += listed[i];
      }
    }
  };
}

std::int64_t owned_rows(std::span<const ParticleSet> sets) {
  std::int64_t n = 0;
  for (const ParticleSet& set : sets) n += static_cast<std::int64_t>(set.particles.owned());
  return n;
}

}  // namespace sph

// What monitors see of melts.
#include <array>
#include <cmath>

#include "decomp/exact_sum.hpp"
#include "sph/models/melt.hpp"
#include "sph/scene/melt_grid.hpp"

namespace sph {
namespace {

constexpr std::array side_names{"x0", "x1", "y0", "y1", "z0", "z1"};

}  // namespace

std::vector<std::string> Melt::columns() const {
  std::vector<std::string> out{"iterations", "residual", "v_rms"};
  if (scene_->domain.melt.diffusivity > 0) out.emplace_back("temperature");
  if (melts_of(*scene_)[0] != melts_of(*scene_)[1]) out.emplace_back("composition");
  for (const MeltSide& s : scene_->domain.melt.sides)
    if (s.temperature || s.heat_flux)
      out.push_back(std::string("heat_") + side_names[static_cast<std::size_t>(s.side)]);
  return out;
}

std::vector<double> Melt::values(const Particles& cells, const GlobalState& global) {
  load(cells);
  const stokes::Patch& p = work_->patch();
  std::array<decomp::ExactSum, 3> sums;
  stokes::for_own(p, [&](std::size_t k) {
    double square = 0;
    for (std::size_t a = 0; a < static_cast<std::size_t>(scene_->dim); ++a)
      square += work_->flow.u[a][k] * work_->flow.u[a][k];
    sums[0].add(square);
    sums[1].add(work_->temperature[k] * (has_grains_ ? 1.0 : work_->share[k]));
    sums[2].add(work_->composition[k] * work_->share[k]);
  });
  decomp::ExactSum::all_reduce(*comm_, sums);
  const double n = static_cast<double>(p.grid.cells[0] * p.grid.cells[1] * p.grid.cells[2]);
  std::vector<double> out{static_cast<double>(global.flow.iterations), global.flow.residual,
                          std::sqrt(sums[0].value() / n)};
  if (work_->conduction) out.push_back(sums[1].value() / n);
  if (melts_of(*scene_)[0] != melts_of(*scene_)[1]) out.push_back(sums[2].value() / n);
  for (const MeltSide& s : scene_->domain.melt.sides)
    if (s.temperature || s.heat_flux)
      out.push_back(work_->conduction->mean_inflow(work_->temperature, static_cast<int>(s.side) / 2,
                                                   static_cast<int>(s.side) % 2));
  return out;
}

}  // namespace sph

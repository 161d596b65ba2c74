#include "sph/models/water.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "models/gas_contents.hpp"
#include "pairs/for_rows.hpp"
#include "sph/core/error.hpp"
#include "sph/models/models.hpp"
#include "sph/terms/water_diffusion.hpp"

namespace sph {
namespace {

constexpr double share = 0.15;  // of h^2 over the diffusivity, see the header

struct WaterContents {
  static constexpr FieldSet reads = FaultView::reads | GasContents::reads | Materials::reads;
  static constexpr FieldSet writes = Materials::writes | GasContents::writes | FieldSet{Field::dissolved_gas};
  const SphConstants* constants;
  const Materials* materials;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
      const RowRange& r = range_of(step.ranges, c);
      for (std::size_t i = r.first; i < r.last; ++i) exchange(p, i, step);
      materials->derive(p, r.first, r.last);
    }
  }

  void exchange(const View<reads, writes>& p, std::size_t i, const Step& step) const {
    const auto stride = static_cast<std::size_t>(p.dim()) + 1;
    const double dt = step.global.dt, gain = p.get<Field::gas_gain>()[i * stride];
    if (gain == 0) return;
    const double more = dt * gain / p.get<Field::liquid_mass>()[i], m = p.get<Field::gas_content>()[i];
    if (GasContents::is_fault(*constants, p, i, m + more, step)) return;
    double& w = p.get<Field::dissolved_gas>()[i];
    w = std::fmin(w, m) + more;
    GasContents::take_in(p, i, dt, more, 0);
  }
};

}  // namespace

double longest_water_step(const Scene& scene) {
  const double h = scene.kernel.smoothing_length;
  double fastest = 0;
  for (const Group& g : scene.groups) fastest = std::max(fastest, g.bubbly.water_diffusivity);
  return fastest > 0 ? share * h * h / fastest : 0;
}

void check_water_step(const Scene& scene) {
  if (const double limit = longest_water_step(scene); scene.time.dt && limit > 0 && *scene.time.dt > limit)
    throw InputError(
        fmt::format("{}: time.dt: {:.6g} s is above the limit of water that diffuses, {:.6g} s; set it to "
                    "that or less, or "
                    "reduce group.water_diffusivity",
                    scene.file, *scene.time.dt, limit));
}

void Water::add_to(Builder& b) const {
  b.add_fields({Field::liquid_mass, Field::dissolved_gas});
  std::vector<Term> terms{term<WaterDiffusion>};
  if (b.scene().has_heat()) terms.push_back(term<WaterHeat>);
  add_exchange(b, "diffusion of water", terms);
  b.add_update("water contents", WaterContents{constants_, materials_});
}

double Water::start(const decomp::Comm&, Particles& p, GlobalState&) {
  check_water_step(*constants_->scene);
  GasContents::start(*constants_, p);
  return constants_->scene->time.dt.value_or(longest_water_step(*constants_->scene));
}

double Water::longest_step(const Reduction&) const {
  return constants_->scene->time.dt.value_or(longest_water_step(*constants_->scene));
}

}  // namespace sph

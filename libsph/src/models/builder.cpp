#include "sph/models/builder.hpp"

#include <utility>

#include "pairs/poison_rows.hpp"
#include "sph/models/models.hpp"
#include "sph/pairs/fusions.hpp"

namespace sph {

Stage Builder::sums_over_pairs(std::string name, const std::vector<Term>& terms, Rows rows,
                               std::optional<Precision> precision) {
  const SphConstants& k = *constants_;
  const Fusion& fusion =
      find_fusion(scene().dim, precision.value_or(scene().terms.precision), scene().kernel.shape, terms);
  fields_ |= fusion.writes;
  const auto work = [&k, &fusion, rows](StepState& s, Side side) {
    const PassContext context = fusion.precision == Precision::double_
                                    ? k.double_context(s.particles, *s.lists, s.rows, s.global.dt)
                                    : k.context(s.particles, *s.lists, s.rows, s.global.dt);
    const std::size_t owned = s.particles.owned();
    // Interior particles have no partner in the halo, so rows of the halo are packed only afterwards.
    const bool interior = side == Side::interior;
    const auto pack = s.iteration == 0 ? fusion.pack : fusion.repack;
    pack(context, interior ? 0 : owned, interior ? owned : s.particles.rows());
    if (interior && s.iteration == 0) poison_rows(context, fusion.row_bytes, owned, s.particles.rows());
    if (rows != Rows::walls)
      fusion.run(context,
                 range_of(s.ranges, interior ? RowClass::interior_movers : RowClass::boundary_movers));
    if (rows != Rows::movers)
      fusion.run(context, range_of(s.ranges, interior ? RowClass::interior_walls : RowClass::boundary_walls));
  };
  return {std::move(name), decomp::Region::pairs, fields_behind(fusion.values), fusion.writes, work, {},
          &fusion};
}

void add_exchange(Builder& b, std::string name, const std::vector<Term>& terms) {
  b.add_loop(
      {{b.sums_over_pairs(std::move(name), terms, Builder::Rows::movers, Precision::double_)}, {}, {}});
}

}  // namespace sph

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
  walls_look_at_movers_ = walls_look_at_movers_ && (rows == Rows::movers || fusion.over_movers);
  const auto work = [&k, &fusion, rows](StepState& s, Side side) {
    SphLists& lists = *s.lists;
    PassContext context = fusion.precision == Precision::double_
                              ? k.double_context(s.particles, lists.all, s.rows, s.global.dt)
                              : k.context(s.particles, lists.all, s.rows, s.global.dt);
    if (lists.bonds.blocks() > 0) context.bonds = &lists.bonds;
    if (lists.walls.blocks() > 0) context.walls = &lists.walls;
    context.fluid = &lists.fluid;
    const std::size_t owned = s.particles.owned();
    // Interior particles have no partner in the halo, so rows of the halo are packed only afterwards.
    const bool interior = side == Side::interior;
    const auto pack = s.iteration == 0 ? fusion.pack : fusion.repack;
    pack(context, interior ? 0 : owned, interior ? owned : s.particles.rows());
    if (fusion.asks_for_fluid)
      interior ? lists.fluid.look_at_interior(s.particles, lists.all, s.ranges)
               : lists.fluid.look_at_boundary(s.particles, lists.all, s.ranges);
    if (interior && s.iteration == 0) poison_rows(context, fusion.row_bytes, owned, s.particles.rows());
    if (rows != Rows::walls)
      fusion.run(context,
                 range_of(s.ranges, interior ? RowClass::interior_movers : RowClass::boundary_movers));
    if (rows != Rows::movers)
      fusion.run(context, range_of(s.ranges, interior ? RowClass::interior_walls : RowClass::boundary_walls));
  };
  FieldSet refresh = fields_behind(fusion.values);
  if (fusion.asks_for_fluid) refresh |= FieldSet{Field::group};
  return {std::move(name), decomp::Region::pairs, refresh, fusion.writes, work, {}, &fusion};
}

void add_exchange(Builder& b, std::string name, const std::vector<Term>& terms) {
  b.add_loop(
      {{b.sums_over_pairs(std::move(name), terms, Builder::Rows::movers, Precision::double_)}, {}, {}});
}

}  // namespace sph

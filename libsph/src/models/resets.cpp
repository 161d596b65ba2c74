#include "sph/models/resets.hpp"

#include <algorithm>

#include "pairs/for_rows.hpp"
#include "sph/laws/enthalpy.hpp"
#include "sph/laws/eos/bubbly.hpp"

namespace sph {
namespace {

struct Resets {
  static constexpr FieldSet reads =
      FaultView::reads | RangeView::reads | Materials::reads | FieldSet{Field::buffer};
  static constexpr FieldSet writes =
      Materials::writes | FieldSet{Field::density,    Field::mass,          Field::gas_content,
                                   Field::enthalpy,   Field::temperature,   Field::heat_inflow,
                                   Field::gas_inflow, Field::dissolved_gas, Field::liquid_mass,
                                   Field::mass_inflow};
  using Rows = View<reads, writes>;
  const SphConstants* constants;
  const Materials* materials;

  void operator()(const Rows& p, const Step& step) const {
    // What inlets lead they renew themselves, and budgets do not have it yet.
    const std::uint32_t* buffer = p.get<Field::buffer>();
    const std::size_t inlets = constants->scene->domain.openings.inlets.size();
    for_movers(step.ranges, [&](std::size_t i) {
      if (buffer != nullptr && buffer[i] != 0 && buffer[i] <= inlets) return;
      for (const Reset& box : constants->scene->domain.resets) {
        if ((box.until && step.global.time >= *box.until) || !contains(box, p, i)) continue;
        if (box.gas_content) fill(p, i, *box.gas_content, step);
        if (box.temperature) heat(p, i, *box.temperature);
        if (box.pressure) raise(p, i, box, step);
      }
    });
  }

  [[nodiscard]] bool contains(const Reset& box, const Rows& p, std::size_t i) const {
    const auto d = static_cast<std::size_t>(p.dim());
    bool inside = true;
    for (std::size_t a = 0; a < d; ++a) {
      const double x =
          constants->scale.metres(constants->wrap(static_cast<int>(a), p.get<Field::position>()[i * d + a]));
      inside = inside && x >= box.lower[a] && x < box.upper[a];
    }
    return inside;
  }

  void fill(const Rows& p, std::size_t i, double content, const Step& step) const {
    const Group& g = constants->scene->groups[p.get<Field::group>()[i]];
    double &m = p.get<Field::gas_content>()[i], &mass = p.get<Field::mass>()[i];
    if (g.eos.law->kind != EosKind::bubbly || m == content) return;
    const double* liquid_mass = p.get<Field::liquid_mass>();
    const double liquid = liquid_mass != nullptr ? liquid_mass[i] : mass / (1 + m);
    const double now = liquid * (1 + content);
    p.get<Field::gas_inflow>()[i] += liquid * (content - m);
    if (const double* h = p.get<Field::enthalpy>()) p.get<Field::heat_inflow>()[i] += (now - mass) * h[i];
    m = content;
    mass = now;
    if (double* w = p.get<Field::dissolved_gas>())
      w[i] = dissolved_gas(g, m, p.get<Field::pressure>()[i] + materials->outer(p, i, g));
    p.get<Field::density>()[i] = materials->density_of(p, i, g, content, step);
    materials->derive(p, i, i + 1);  // as after a restart
    find_out_of_range(*constants, p, i, i + 1, step);
  }

  // While it rises only what is below it gets it.
  void raise(const Rows& p, std::size_t i, const Reset& box, const Step& step) const {
    const double now = step.global.time + step.global.dt;
    const bool rises = now < box.rise_time;
    const double wanted = rises ? *box.pressure * (now / box.rise_time) : *box.pressure;
    if (!rises || wanted > p.get<Field::pressure>()[i]) press(p, i, wanted, step);
  }

  void press(const Rows& p, std::size_t i, double wanted, const Step& step) const {
    const Group& g = constants->scene->groups[p.get<Field::group>()[i]];
    if (g.kind != GroupKind::fluid) return;
    double &mass = p.get<Field::mass>()[i], &rho = p.get<Field::density>()[i];
    const double* content = p.get<Field::gas_content>();
    const double m = content != nullptr ? content[i] : 0.0;
    p.get<Field::pressure>()[i] = wanted;
    const double now = materials->density_of(p, i, g, m, step), more = now / rho, added = (more - 1) * mass;
    p.get<Field::mass_inflow>()[i] += added / (1 + m);
    if (const double* h = p.get<Field::enthalpy>()) p.get<Field::heat_inflow>()[i] += added * h[i];
    if (double* inflow = p.get<Field::gas_inflow>()) inflow[i] += added * (m / (1 + m));
    if (double* liquid = p.get<Field::liquid_mass>()) liquid[i] *= more;
    mass *= more;
    rho = now;
    materials->derive(p, i, i + 1);  // as after a restart
    find_out_of_range(*constants, p, i, i + 1, step);
  }

  void heat(const Rows& p, std::size_t i, double wanted) const {
    double &t = p.get<Field::temperature>()[i], &h = p.get<Field::enthalpy>()[i];
    if (t == wanted) return;
    const Group& g = constants->scene->groups[p.get<Field::group>()[i]];
    const double now = enthalpy(g.heat.material, wanted);
    p.get<Field::heat_inflow>()[i] += p.get<Field::mass>()[i] * (now - h);
    h = now;
    t = temperature(g.heat.material, now);
  }
};

}  // namespace

bool resets_gas(const Scene& scene) {
  return has_eos(scene, EosKind::bubbly) && std::ranges::any_of(scene.domain.resets, [](const Reset& box) {
           return box.gas_content.has_value() || box.pressure.has_value();
         });
}

void add_resets(Builder& b) {
  const Scene& s = b.scene();
  if (resets_gas(s)) b.add_fields({Field::gas_inflow});
  if (s.has_heat()) b.add_fields({Field::heat_inflow});
  if (std::ranges::any_of(s.domain.resets, [](const Reset& box) { return box.pressure.has_value(); }))
    b.add_fields({Field::mass_inflow});
  b.add_kick("resets", Resets{&b.constants(), &b.materials()});
}

}  // namespace sph

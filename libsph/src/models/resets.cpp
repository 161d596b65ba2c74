#include "sph/models/resets.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

#include "pairs/for_rows.hpp"
#include "sph/laws/enthalpy.hpp"
#include "sph/laws/eos/bubbly.hpp"

namespace sph {
namespace {

struct EndStep {
  static constexpr FieldSet reads = Resets::reads, writes = Resets::writes;
  Resets* resets;
  void operator()(const Resets::Rows& p, const Step& step) const { resets->end_step(p, step); }
};

bool acts(const Reset& box, const GlobalState& global) { return !box.until || global.time < *box.until; }

}  // namespace

bool resets_gas(const Scene& scene) {
  return has_eos(scene, EosKind::bubbly) && std::ranges::any_of(scene.domain.resets, [](const Reset& box) {
           return box.gas_content.has_value() || box.pressure.has_value() || !box.inflow.empty();
         });
}

Resets::Resets(std::size_t set, const SphConstants& constants, const Materials& materials)
    : Model(set), constants_(&constants), materials_(&materials) {
  for (const Reset& box : constants.scene->domain.resets) {
    boxes_.push_back({&box, {}});
    if (box.inflow.empty()) continue;
    boxes_.back().inflow = received_.size();
    received_.push_back(0);
  }
}

void Resets::add_to(Builder& b) {
  const Scene& s = b.scene();
  if (resets_gas(s)) b.add_fields({Field::gas_inflow});
  if (s.has_heat()) b.add_fields({Field::heat_inflow});
  if (std::ranges::any_of(s.domain.resets,
                          [](const Reset& box) { return box.pressure.has_value() || !box.inflow.empty(); }))
    b.add_fields({Field::mass_inflow});
  b.add_kick("resets", EndStep{this});
}

void Resets::reserve(Reduction& r) { in_ = r.add_sums(received_.size()); }

double Resets::start(const decomp::Comm& comm, Particles& p, GlobalState& global) {
  global.inflows.assign(received_.size(), {});
  if (received_.empty()) return any_step;
  std::vector<std::int64_t> inside(received_.size(), 0);
  const ViewOf<EndStep> rows(p);
  for (const Box& box : boxes_)
    for (std::size_t i = 0; box.inflow && i < p.owned(); ++i)
      if (!is_led(rows, i) && is_fluid(p.data<Field::group>()[i]) && contains(*box.reset, rows, i))
        ++inside[*box.inflow];
  comm.sum(std::span<std::int64_t>(inside));
  for (std::size_t k = 0; k < boxes_.size(); ++k)
    if (boxes_[k].inflow && inside[*boxes_[k].inflow] == 0 && value_at(boxes_[k].reset->inflow, 0) > 0)
      throw InputError(
          fmt::format("{}: reset.{}.inflow: no fluid is in the box at the start, into which it could come",
                      constants_->scene->file, k));
  for (std::size_t k = 0; k < inside.size(); ++k) global.inflows[k].receivers = inside[k];
  return any_step;
}

void Resets::end_step(const Rows& p, const Step& step) {
  std::ranges::fill(received_, 0);
  for_movers(step.ranges, [&](std::size_t i) {
    if (is_led(p, i)) return;
    for (const Box& box : boxes_) {
      if (!contains(*box.reset, p, i)) continue;
      if (box.inflow) receive(p, i, box, step);
      if (!acts(*box.reset, step.global)) continue;
      if (box.reset->gas_content) fill(p, i, *box.reset->gas_content, step);
      if (box.reset->temperature) heat(p, i, *box.reset->temperature);
      if (box.reset->pressure) raise(p, i, *box.reset, step);
    }
  });
}

bool Resets::report(const StepState&, Reduction& r) {
  std::ranges::copy(received_, r[in_].begin());
  return true;
}

// A fault comes first: where particles are then depends on the lists.
void Resets::guard(const decomp::Comm&, const StepState& s, const Reduction& r) const {
  if (r[Reduction::bad] > 0) return;
  for (std::size_t k = 0; k < boxes_.size(); ++k)
    if (boxes_[k].inflow && due(boxes_[k], s.global) > 0 && r[in_][*boxes_[k].inflow] == 0)
      throw GuardError(fmt::format(
          "step {}: no fluid is in the box of reset.{}, into which its inflow could come; enlarge "
          "the box, or let the inflow end before",
          s.global.step, k));
}

void Resets::act(const Reduction& r, GlobalState& global) {
  for (const Box& box : boxes_) {
    if (!box.inflow) continue;
    Inflow& inflow = global.inflows[*box.inflow];
    const double all = due(box, global), each = share(box, global);
    const std::int64_t now = r[in_][*box.inflow];
    inflow.due = each > 0 && now == inflow.receivers ? 0 : all - static_cast<double>(now) * each;
    inflow.receivers = now;
  }
}

double Resets::due(const Box& box, const GlobalState& global) {
  const double until = box.reset->until.value_or(std::numeric_limits<double>::infinity());
  const double during = std::clamp(until - global.time, 0.0, global.dt);
  const double rate = value_at(box.reset->inflow, global.time + 0.5 * during);
  return global.inflows[*box.inflow].due + rate * during;
}

// Where more came than was to, none comes until that is made up for: a pump takes nothing out.
double Resets::share(const Box& box, const GlobalState& global) {
  const double all = due(box, global);
  const std::int64_t receivers = global.inflows[*box.inflow].receivers;
  return all > 0 && receivers > 0 ? all / static_cast<double>(receivers) : 0.0;
}

// What inlets lead they renew themselves, and budgets do not have it yet.
bool Resets::is_led(const Rows& p, std::size_t i) const {
  const std::uint32_t* buffer = p.get<Field::buffer>();
  return buffer != nullptr && buffer[i] != 0 && buffer[i] <= constants_->scene->domain.openings.inlets.size();
}

bool Resets::is_fluid(std::uint32_t group) const {
  return constants_->scene->groups[group].kind == GroupKind::fluid;
}

template <class V>
bool Resets::contains(const Reset& box, const V& p, std::size_t i) const {
  const auto d = static_cast<std::size_t>(p.dim());
  bool inside = true;
  for (std::size_t a = 0; a < d; ++a) {
    const double x = constants_->scale.metres(
        constants_->wrap(static_cast<int>(a), p.template get<Field::position>()[i * d + a]));
    inside = inside && x >= box.lower[a] && x < box.upper[a];
  }
  return inside;
}

void Resets::fill(const Rows& p, std::size_t i, double content, const Step& step) const {
  const Group& g = constants_->scene->groups[p.get<Field::group>()[i]];
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
    w[i] = dissolved_gas(g, m, p.get<Field::pressure>()[i] + materials_->outer(p, i, g));
  p.get<Field::density>()[i] = materials_->density_of(p, i, g, content, step);
  materials_->derive(p, i, i + 1);  // as after a restart
  find_out_of_range(*constants_, p, i, i + 1, step);
}

// While it rises only what is below it gets it.
void Resets::raise(const Rows& p, std::size_t i, const Reset& box, const Step& step) const {
  const double now = step.global.time + step.global.dt;
  const bool rises = now < box.rise_time;
  const double wanted = rises ? *box.pressure * (now / box.rise_time) : *box.pressure;
  if (!rises || wanted > p.get<Field::pressure>()[i]) press(p, i, wanted, step);
}

void Resets::press(const Rows& p, std::size_t i, double wanted, const Step& step) const {
  const Group& g = constants_->scene->groups[p.get<Field::group>()[i]];
  if (g.kind != GroupKind::fluid) return;
  const double* content = p.get<Field::gas_content>();
  p.get<Field::pressure>()[i] = wanted;
  grow(p, i, materials_->density_of(p, i, g, content != nullptr ? content[i] : 0.0, step), step);
}

void Resets::receive(const Rows& p, std::size_t i, const Box& box, const Step& step) {
  if (!is_fluid(p.get<Field::group>()[i])) return;
  ++received_[*box.inflow];
  const double each = share(box, step.global), mass = p.get<Field::mass>()[i];
  if (each > 0) grow(p, i, p.get<Field::density>()[i] * ((mass + each) / mass), step);
}

/// To a density at constant volume.
void Resets::grow(const Rows& p, std::size_t i, double density, const Step& step) const {
  double &mass = p.get<Field::mass>()[i], &rho = p.get<Field::density>()[i];
  const double* content = p.get<Field::gas_content>();
  const double m = content != nullptr ? content[i] : 0.0, more = density / rho, added = (more - 1) * mass;
  p.get<Field::mass_inflow>()[i] += added / (1 + m);
  if (const double* h = p.get<Field::enthalpy>()) p.get<Field::heat_inflow>()[i] += added * h[i];
  if (double* inflow = p.get<Field::gas_inflow>()) inflow[i] += added * (m / (1 + m));
  if (double* liquid = p.get<Field::liquid_mass>()) liquid[i] *= more;
  mass *= more;
  rho = density;
  materials_->derive(p, i, i + 1);  // as after a restart
  find_out_of_range(*constants_, p, i, i + 1, step);
}

void Resets::heat(const Rows& p, std::size_t i, double wanted) const {
  double &t = p.get<Field::temperature>()[i], &h = p.get<Field::enthalpy>()[i];
  if (t == wanted) return;
  const Group& g = constants_->scene->groups[p.get<Field::group>()[i]];
  const double now = enthalpy(g.heat.material, wanted);
  p.get<Field::heat_inflow>()[i] += p.get<Field::mass>()[i] * (now - h);
  h = now;
  t = temperature(g.heat.material, now);
}

}  // namespace sph

// Openings at the end of a step: what is led there, what is free from then on, what is gone, what is new.
#include "sph/models/openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <string>

#include "core/budget.hpp"
#include "pairs/for_rows.hpp"
#include "sph/laws/enthalpy.hpp"
#include "sph/laws/eos/bubbly.hpp"
#include "sph/scene/positions.hpp"

namespace sph {
namespace {

struct EndStep {
  static constexpr FieldSet reads = OpeningBoxes::reads, writes = OpeningBoxes::writes;
  Openings* openings;
  void operator()(const Openings::Rows& p, const Step& step) const { openings->end_step(p, step); }
};

constexpr std::uint64_t largest_first_id = std::uint64_t{1} << 48;

/// What is counted of a particle besides what budgets count: momentum, kinetic energy.
constexpr std::size_t of_budget = Passage{}.amounts.size(), of_motion = 4, counted = of_budget + of_motion;

/// Of one that comes in: what it had from walls while it was led is in the sums already.
void add_amounts(const Particles& p, std::size_t row, bool comes, std::span<decomp::ExactSum> to) {
  const std::vector<std::string> names = Budget::names(p);
  std::size_t k = 0;
  Budget::visit(p, row, [&](double amount) {
    if (!comes || !Budget::is_inflow(names[k])) to[k].add(amount);
    ++k;
  });
  const auto d = static_cast<std::size_t>(p.dim());
  const double mass = p.data<Field::mass>()[row];
  for (std::size_t a = 0; a < d; ++a) to[of_budget + a].add(mass * p.data<Field::velocity>()[row * d + a]);
  to[of_budget + 3].add(kinetic_energy(p, row));
}

void count(Passage& passage, std::int64_t number, std::span<const decomp::ExactSum> sums) {
  passage.count += number;
  for (std::size_t k = 0; k < of_budget; ++k) passage.amounts[k] += sums[k].value();
  for (std::size_t a = 0; a < 3; ++a) passage.momentum[a] += sums[of_budget + a].value();
  passage.kinetic_energy += sums[of_budget + 3].value();
}

/// What an inlet leads has at the start what it will bring, at the pressure that was painted; the rest of its state
/// follows from that.
void fill(const Scene& scene, Particles& p) {
  const std::uint32_t* buffer = p.data<Field::buffer>();
  const std::vector<Inlet>& inlets = scene.domain.openings.inlets;
  for (std::size_t i = 0; i < p.owned(); ++i) {
    if (buffer[i] == 0 || buffer[i] > inlets.size()) continue;
    const Inlet& inlet = inlets[buffer[i] - 1];
    const Group& g = scene.groups[p.data<Field::group>()[i]];
    if (double* t = p.data<Field::temperature>(); t != nullptr && inlet.temperature)
      t[i] = *inlet.temperature;
    if (!inlet.gas_content) continue;
    double &m = p.data<Field::gas_content>()[i], &rho = p.data<Field::density>()[i];
    if (m == *inlet.gas_content) continue;  // of a file, which must stay as it is
    rho = bubbly_eos(g, *inlet.gas_content).density(bubbly_eos(g, m).pressure(rho));
    m = *inlet.gas_content;
    p.data<Field::mass>()[i] = rho * particle_volume(scene);
  }
}

}  // namespace

Openings::Openings(std::size_t set, const SphConstants& constants, const Materials& materials)
    : Model(set), constants_(&constants), materials_(&materials), boxes_(constants, materials) {}

void Openings::add_to(Builder& b) {
  if (!b.scene().domain.openings.lead()) return;
  const FieldSet near{Field::position, Field::velocity, Field::density,
                      Field::pressure, Field::group,    Field::buffer};
  b.add_loop({{{"boxes of openings", decomp::Region::update, near,
                Materials::writes | FieldSet{Field::density, Field::mass, Field::velocity},
                [this](StepState& s, Side side) { boxes_.pass_pressures(s, side); }}},
              nullptr,
              {}});
}

void Openings::add_end_to(Builder& b) {
  const Scene& s = b.scene();
  if (s.domain.openings.lead()) {
    b.add_fields({Field::buffer});
    if (s.has_heat()) b.add_fields({Field::heat_inflow});
    if (has_eos(s, EosKind::bubbly)) b.add_fields({Field::gas_inflow});
  }
  b.add_kick("openings", EndStep{this});
}

void Openings::reserve(Reduction& r) {
  in_.events = r.add_sums(1);
  in_.flows = r.add_sums(boxes_.sums().size());
}

double Openings::start(const decomp::Comm& comm, Particles& particles, GlobalState& global) {
  const Scene& scene = *constants_->scene;
  global.throughput.passages.assign(boxes_.all().size() + 1, {});
  const std::uint64_t* id = particles.data<Field::id>();
  std::int64_t largest = 0;
  for (std::size_t i = 0; i < particles.owned(); ++i)
    largest = std::max(largest, static_cast<std::int64_t>(id[i]));
  global.throughput.id_stride = static_cast<std::uint64_t>(comm.max(largest)) + 1;
  if (boxes_.inlets() > 0 && global.throughput.id_stride > largest_first_id)
    throw InputError(
        fmt::format("{}: start: the largest id is {}; beside an [[inlet]] ids must be below 2^48", scene.file,
                    global.throughput.id_stride - 1));
  if (!scene.domain.openings.lead()) return any_step;
  boxes_.mark(comm, particles, global);
  fill(scene, particles);
  return any_step;
}

void Openings::end_step(const Rows& p, const Step& step) {
  gone_.clear();
  come_.clear();
  const auto d = static_cast<std::size_t>(p.dim());
  const std::uint32_t* buffer = p.get<Field::buffer>();
  const double* v = p.get<Field::velocity>();
  double speed2 = 0;
  for_movers(step.ranges, [&](std::size_t i) {
    if (buffer != nullptr && buffer[i] != 0) {
      lead(p, i, step);
      double v2 = 0;
      for (std::size_t a = 0; a < d; ++a) v2 += v[i * d + a] * v[i * d + a];
      speed2 = larger(v2, speed2);
    }
    judge(p, i, step);
  });
  step.maxima.speed = larger(std::sqrt(speed2), step.maxima.speed);
}

// What leaves an outlet goes on as it came.
void Openings::lead(const Rows& p, std::size_t i, const Step& step) const {
  const std::size_t number = p.get<Field::buffer>()[i] - 1;
  if (!boxes_.is_inlet(number)) return;
  renew(p, i, constants_->scene->domain.openings.inlets[number], step);
  const auto d = static_cast<std::size_t>(p.dim());
  double* v = p.get<Field::velocity>() + i * d;
  std::fill_n(v, d, 0.0);
  const OpeningBox& box = boxes_.all()[number];
  v[box.axis] =
      box.sign * boxes_.speed(number, boxes_.place(p, i), step.global.time + step.global.dt, step.global);
}

// What flows or is conducted into the box from what is free is lost to that.
void Openings::renew(const Rows& p, std::size_t i, const Inlet& inlet, const Step& step) const {
  p.get<Field::group>()[i] = static_cast<std::uint32_t>(inlet.group);
  const Group& g = constants_->scene->groups[static_cast<std::size_t>(inlet.group)];
  double *h = p.get<Field::enthalpy>(), *content = p.get<Field::gas_content>();
  const bool gas = content != nullptr && g.eos.law->kind == EosKind::bubbly;
  if (h == nullptr && !gas) return;
  double& mass = p.get<Field::mass>()[i];
  double* liquid = p.get<Field::liquid_mass>();
  const double m = gas ? inlet.gas_content.value_or(g.bubbly.gas_content) : 0.0;
  const double before = gas && liquid != nullptr ? liquid[i] * (1 + m) : mass;
  if (gas && liquid != nullptr) p.get<Field::gas_inflow>()[i] -= liquid[i] * (content[i] - m);
  if (h != nullptr && (inlet.temperature || g.heat.temperature)) {
    const double wanted =
        enthalpy(g.heat.material, inlet.temperature ? *inlet.temperature : *g.heat.temperature);
    p.get<Field::heat_inflow>()[i] -= mass * h[i] - before * wanted;
    h[i] = wanted;
    p.get<Field::temperature>()[i] = temperature(g.heat.material, wanted);
  }
  if (!gas) return;
  content[i] = m;
  if (double* w = p.get<Field::dissolved_gas>())
    w[i] = dissolved_gas(g, m, p.get<Field::pressure>()[i] + materials_->outer(p, i, g));
  p.get<Field::density>()[i] = materials_->density_of(p, i, g, m, step);
  mass = p.get<Field::density>()[i] * particle_volume(*constants_->scene);
  if (liquid != nullptr) liquid[i] = mass / (1 + m);
  materials_->derive(p, i, i + 1);  // as after a restart
}

void Openings::judge(const Rows& p, std::size_t i, const Step& step) {
  const Group& g = constants_->scene->groups[p.get<Field::group>()[i]];
  if (is_body(g)) return;
  std::uint32_t* buffer = p.get<Field::buffer>();
  if (buffer != nullptr && buffer[i] != 0) return judge_led(p, i, step);
  const std::span<const OpeningBox> boxes = boxes_.all();
  const auto d = static_cast<std::size_t>(p.dim());
  if (is_deleted(*constants_->scene, constants_->scale, g, p.get<Field::position>() + i * d)) {
    gone_.push_back({i, boxes.size()});
    return;
  }
  for (std::size_t k = boxes_.inlets(); k < boxes.size(); ++k) {
    if (!boxes[k].contains(boxes_.place(p, i), d)) continue;
    if (boxes[k].pressure->empty() || g.kind != GroupKind::fluid)
      gone_.push_back({i, k});
    else
      buffer[i] = static_cast<std::uint32_t>(k + 1);
    return;
  }
}

void Openings::judge_led(const Rows& p, std::size_t i, const Step& step) {
  const std::size_t number = p.get<Field::buffer>()[i] - 1;
  const OpeningBox& box = boxes_.all()[number];
  const std::int64_t* x = p.get<Field::position>() + i * static_cast<std::size_t>(p.dim());
  const Group& g = constants_->scene->groups[p.get<Field::group>()[i]];
  if (!boxes_.is_inlet(number)) {
    if (box.is_past(x[box.axis]))
      gone_.push_back({i, number});
    else if (is_deleted(*constants_->scene, constants_->scale, g, x))
      gone_.push_back({i, boxes_.all().size()});
    return;
  }
  if (!box.is_past(x[box.axis])) return;
  come_.push_back({i, number});
  const std::uint64_t id = p.get<Field::id>()[i];
  if (id > largest_id - step.global.throughput.id_stride)
    find_fault(*constants_, p, i, step, "has the last id that there is: nothing can follow it");
}

bool Openings::report(const StepState&, Reduction& r) {
  r[in_.events][0] = static_cast<std::int64_t>(gone_.size() + come_.size());
  std::ranges::copy(boxes_.sums(), r[in_.flows].begin());
  return true;
}

void Openings::act(const Reduction& r, GlobalState& global) { boxes_.remember(r[in_.flows], global); }

std::optional<double> Openings::turn_over(const Distribution& distribution, const Reduction& reduction,
                                          ParticleSet& set, GlobalState& global) {
  if (reduction[in_.events][0] == 0) return std::nullopt;
  const decomp::Comm& comm = distribution.comm();
  std::vector<Passage>& passages = global.throughput.passages;
  Particles& p = set.particles;
  const std::uint64_t* id = p.data<Field::id>();
  std::vector<std::int64_t> numbers(passages.size(), 0);
  std::vector<decomp::ExactSum> sums(counted * passages.size());
  std::array<std::uint64_t, 1> changed{0};
  const auto add = [&](const Event& event, bool comes) {
    ++numbers[event.passage];
    add_amounts(p, event.row, comes, std::span(sums).subspan(counted * event.passage, counted));
    changed[0] ^= id[event.row] + (comes ? global.throughput.id_stride : 0);
  };
  for (const Event& event : gone_) add(event, false);
  for (const Event& event : come_) add(event, true);
  comm.sum(std::span<std::int64_t>(numbers));
  comm.bit_xor(changed);
  decomp::ExactSum::all_reduce(comm, sums);
  for (std::size_t k = 0; k < passages.size(); ++k) {
    count(passages[k], numbers[k], std::span(sums).subspan(counted * k, counted));
    set.census.count += boxes_.is_inlet(k) ? numbers[k] : -numbers[k];
  }
  set.census.xor_of_ids ^= changed[0];
  replace_rows(p, global);
  std::int64_t longest = 0;
  for (const OpeningBox& box : boxes_.all().first(boxes_.inlets())) longest = std::max(longest, box.length);
  return constants_->scale.metres(longest);
}

// Rows keep their order; new ones are last.
void Openings::replace_rows(Particles& p, const GlobalState& global) const {
  const std::size_t before = p.owned(), d = static_cast<std::size_t>(p.dim());
  p.table().resize(before + come_.size(), 0);
  for (std::size_t k = 0; k < come_.size(); ++k) {
    const std::size_t parent = come_[k].row, child = before + k;
    for (int c = 0; c < p.table().columns(); ++c) {
      decomp::Column& column = p.table().column(c);
      std::memcpy(column.data() + child * column.width(), column.data() + parent * column.width(),
                  column.width());
    }
    const OpeningBox& box = boxes_.all()[come_[k].passage];
    p.data<Field::buffer>()[parent] = 0;
    p.data<Field::id>()[child] += global.throughput.id_stride;
    p.data<Field::position>()[child * d + box.axis] -= box.sign > 0 ? box.length : -box.length;
    for (double* counter :
         {p.data<Field::heat_inflow>(), p.data<Field::gas_inflow>(), p.data<Field::mass_inflow>(),
          p.data<Field::released_energy>(), p.data<Field::waiting_time>()})
      if (counter != nullptr) counter[child] = 0;
    for (std::uint32_t* latch : {p.data<Field::waiting_for>(), p.data<Field::connected>()})
      if (latch != nullptr) latch[child] = 0;
  }
  if (gone_.empty()) return;
  std::vector<bool> stays(p.owned(), true);
  for (const Event& event : gone_) stays[event.row] = false;
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < stays.size(); ++i)
    if (stays[i]) order.push_back(i);
  p.table().reorder(order);
}

}  // namespace sph

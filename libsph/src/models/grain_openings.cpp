#include "sph/models/grain_openings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <functional>
#include <limits>

#include "sph/core/error.hpp"
#include "sph/models/energies.hpp"
#include "start/initial_fields.hpp"

namespace sph {
namespace {

constexpr std::uint64_t largest_first_id = std::uint64_t{1} << 48;
constexpr std::size_t counted = 5;  // mass, momentum, kinetic energy

/// The first quantum that is not below a place.
std::int64_t quantum_from(double metres, const PositionScale& scale) {
  constexpr double far = 0x1p62;  // beyond every domain
  return static_cast<std::int64_t>(std::ceil(std::clamp(metres / scale.quantum, -far, far)));
}

}  // namespace

bool GrainOpenings::Box::contains(const std::array<std::int64_t, 3>& x) const {
  for (std::size_t a = 0; a < 3; ++a)
    if (x[a] < lower[a] || x[a] >= upper[a]) return false;
  return true;
}

GrainOpenings::GrainOpenings(std::size_t set, const Scene& scene, const PositionScale& scale,
                             const GrainWalls& walls, GrainPairs& pairs)
    : Model(set),
      scene_(&scene),
      scale_(scale),
      wrap_(wrap_of(scene, scale)),
      walls_(&walls),
      pairs_(&pairs),
      insertions_(scene, scale),
      due_(insertions_.count(), 0) {
  for (const Outlet& outlet : scene.domain.openings.outlets) {
    Box box;
    for (std::size_t a = 0; a < 3; ++a) {
      box.lower[a] = quantum_from(outlet.lower[a], scale);
      box.upper[a] = quantum_from(outlet.upper[a], scale);
    }
    outlets_.push_back(box);
  }
  for (std::size_t a = 0; a < 3; ++a) {
    const bool ends = !scene.domain.periodic[a];
    domain_.lower[a] = ends ? scale.origin[a] : std::numeric_limits<std::int64_t>::min();
    domain_.upper[a] = ends ? scale.quanta(scene.domain.upper[a]) : std::numeric_limits<std::int64_t>::max();
  }
}

double GrainOpenings::start(const decomp::Comm& comm, Particles& particles, GlobalState& global) {
  global.throughput.passages.assign(faces() + 1 + insertions_.count(), {});
  std::int64_t largest = 0;
  for (std::size_t i = 0; i < particles.owned(); ++i)
    largest = std::max(largest, static_cast<std::int64_t>(particles.data<Field::id>()[i]));
  global.throughput.id_stride = static_cast<std::uint64_t>(comm.max(largest)) + 1;
  if (insertions_.count() > 0 && global.throughput.id_stride > largest_first_id)
    throw InputError(
        fmt::format("{}: start: the largest id is {}; beside an [[insertion]] ids must be below 2^48",
                    scene_->file, global.throughput.id_stride - 1));
  return any_step;
}

bool GrainOpenings::report(const StepState& s, Reduction& r) {
  open_outlets(s.global);
  find_leavers(s.particles);
  auto events = static_cast<std::int64_t>(leavers_.size());
  for (std::size_t k = 0; k < due_.size(); ++k) {
    due_[k] = insertions_.due(k, s.global);
    if (due_[k] > 0) ++events;
  }
  r[in_.events][0] = events;
  return true;
}

void GrainOpenings::open_outlets(const GlobalState& before) {
  for (std::size_t k = 0; k < outlets_.size(); ++k) {
    const double every = scene_->domain.openings.outlets[k].every;
    outlets_[k].open =
        every == 0 || std::floor((before.time + before.dt) / every) > std::floor(before.time / every);
  }
}

void GrainOpenings::find_leavers(const Particles& p) {
  leavers_.clear();
  const bool opens = std::ranges::any_of(outlets_, &Box::open);
  if (!opens && std::ranges::none_of(scene_->domain.openings.deletes, std::identity{})) return;
  const std::uint32_t* group = p.data<Field::group>();
  const RowPlaces places = p.places();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    std::array<std::int64_t, 3> x;
    for (std::size_t a = 0; a < 3; ++a) x[a] = wrap_(static_cast<int>(a), places(i, a));
    const bool inside = domain_.contains(x);
    if (inside && !opens) continue;
    const Group& g = scene_->groups[group[i]];
    if (g.grain.fixed) continue;
    const auto outlet =
        std::ranges::find_if(outlets_, [&](const Box& box) { return box.open && box.contains(x); });
    if (outlet != outlets_.end())
      leavers_.push_back({i, static_cast<std::size_t>(outlet - outlets_.begin())});
    else if (!inside && is_deleted(*scene_, scale_, g, x.data()))
      leavers_.push_back({i, faces()});
  }
}

void GrainOpenings::find_leavers(const decomp::Comm& comm, const Particles& p,
                                 std::span<const std::uint64_t> ids) {
  leavers_.clear();
  std::vector<std::int64_t> found(ids.size(), 0);
  for (std::size_t i = 0; i < p.owned(); ++i) {
    const auto at = std::ranges::lower_bound(ids, p.data<Field::id>()[i]);
    if (at == ids.end() || *at != p.data<Field::id>()[i]) continue;
    const bool fixed = scene_->groups[p.data<Field::group>()[i]].grain.fixed;
    found[static_cast<std::size_t>(at - ids.begin())] = fixed ? 2 : 1;
    leavers_.push_back({i, faces()});
  }
  comm.sum(std::span<std::int64_t>(found));
  for (std::size_t k = 0; k < ids.size(); ++k)
    if (found[k] != 1)
      throw InputError(
          fmt::format("remove: grain {} {}", ids[k], found[k] == 0 ? "is not there" : "is fixed"));
}

std::optional<double> GrainOpenings::turn_over(const Distribution& distribution, const Reduction& reduction,
                                               ParticleSet& set, GlobalState& global) {
  if (reduction[in_.events][0] == 0) return std::nullopt;
  const std::vector<bool> stays = staying(set.particles);
  const std::vector<std::uint64_t> gone = count_leavers(distribution.comm(), set, global);
  replace_rows(set.particles, stays, gone, put_in(distribution, stays, set, global));
  return 0.0;
}

// What a caller puts in has a passage after those of the insertions, once there is any.
void GrainOpenings::exchange(const Distribution& distribution, std::span<const std::uint64_t> gone,
                             std::span<const GivenGrain> come, ParticleSet& set, GlobalState& global) {
  const std::size_t given = faces() + 1 + insertions_.count();
  std::vector<Passage>& passages = global.throughput.passages;
  if (!come.empty() && global.throughput.id_stride > largest_first_id)
    throw InputError(fmt::format("add: the largest id of the start is {}; it must be below 2^48",
                                 global.throughput.id_stride - 1));
  find_leavers(distribution.comm(), set.particles, gone);
  const std::vector<bool> stays = staying(set.particles);
  const std::vector<InsertedGrain> grains = insertions_.take(distribution.comm(), come, set.particles, stays,
                                                             walls_->now(global), next_id(global), global.dt);
  if (passages.size() == given && !grains.empty()) passages.emplace_back();
  (void)count_leavers(distribution.comm(), set, global);
  replace_rows(set.particles, stays, gone, let_in(grains, given, distribution, set, global));
}

std::vector<bool> GrainOpenings::staying(const Particles& p) const {
  std::vector<bool> stays(p.owned(), true);
  for (const Leaver& leaver : leavers_) stays[leaver.row] = false;
  return stays;
}

void GrainOpenings::replace_rows(Particles& p, const std::vector<bool>& stays,
                                 std::span<const std::uint64_t> gone,
                                 std::span<const NewParticle> come) const {
  std::vector<std::uint32_t> order;
  for (std::uint32_t i = 0; i < stays.size(); ++i)
    if (stays[i]) order.push_back(i);
  pairs_->turn_over(p, gone, order, come.size());
  p.table().reorder(order);
  for (const NewParticle& grain : come) {
    decomp::Int3 at{};
    for (std::size_t a = 0; a < 3; ++a) at[a] = scale_.quanta(grain.position[a]);
    append(*scene_, grain, at, p);
  }
}

std::vector<std::uint64_t> GrainOpenings::count_leavers(const decomp::Comm& comm, ParticleSet& set,
                                                        GlobalState& global) const {
  const Particles& p = set.particles;
  std::vector<std::uint64_t> ids;
  std::vector<std::int64_t> numbers(faces() + 1, 0);
  std::vector<decomp::ExactSum> sums(counted * numbers.size());
  for (const Leaver& leaver : leavers_) {
    ids.push_back(p.data<Field::id>()[leaver.row]);
    ++numbers[leaver.passage];
    decomp::ExactSum* to = sums.data() + counted * leaver.passage;
    const double mass = p.data<Field::mass>()[leaver.row];
    to[0].add(mass);
    for (std::size_t a = 0; a < 3; ++a) to[1 + a].add(mass * p.data<Field::velocity>()[leaver.row * 3 + a]);
    to[4].add(kinetic_energy(p, leaver.row));
  }
  const std::vector<std::byte> all =
      decomp::gather_everywhere(comm, std::as_bytes(std::span<const std::uint64_t>(ids)));
  std::vector<std::uint64_t> gone(all.size() / sizeof(std::uint64_t));
  if (gone.empty()) return gone;
  std::memcpy(gone.data(), all.data(), all.size());
  std::ranges::sort(gone);
  comm.sum(std::span<std::int64_t>(numbers));
  decomp::ExactSum::all_reduce(comm, sums);
  for (std::size_t k = 0; k < numbers.size(); ++k) {
    Passage& passage = global.throughput.passages[k];
    passage.count += numbers[k];
    passage.amounts[0] += sums[counted * k].value();
    for (std::size_t a = 0; a < 3; ++a) passage.momentum[a] += sums[counted * k + 1 + a].value();
    passage.kinetic_energy += sums[counted * k + 4].value();
    set.census.count -= numbers[k];
  }
  for (const std::uint64_t id : gone) set.census.xor_of_ids ^= id;
  return gone;
}

std::vector<NewParticle> GrainOpenings::put_in(const Distribution& distribution,
                                               const std::vector<bool>& stays, ParticleSet& set,
                                               GlobalState& global) const {
  std::vector<NewParticle> mine;
  std::vector<Passage>& passages = global.throughput.passages;
  const WallsNow walls = walls_->now(global);
  std::vector<InsertedGrain> earlier;
  for (std::size_t k = 0; k < due_.size(); ++k) {
    if (!(due_[k] > 0)) continue;
    Passage& passage = passages[faces() + 1 + k];
    double due = passage.beside + due_[k];
    const std::vector<InsertedGrain> come = insertions_.choose(
        distribution.comm(), k, set.particles, stays, earlier, walls, next_id(global), global.step, due);
    passage.beside = due;
    const std::vector<NewParticle> own = let_in(come, faces() + 1 + k, distribution, set, global);
    mine.insert(mine.end(), own.begin(), own.end());
    earlier.insert(earlier.end(), come.begin(), come.end());
  }
  return mine;
}

// Of the start's, and of those that have come.
std::uint64_t GrainOpenings::next_id(const GlobalState& global) const {
  std::uint64_t id = global.throughput.id_stride;
  for (const Passage& of : std::span(global.throughput.passages).subspan(faces() + 1))
    id += static_cast<std::uint64_t>(of.count);
  return id;
}

std::vector<NewParticle> GrainOpenings::let_in(std::span<const InsertedGrain> grains, std::size_t number,
                                               const Distribution& distribution, ParticleSet& set,
                                               GlobalState& global) const {
  std::vector<NewParticle> mine;
  for (const InsertedGrain& grain : grains) {
    Passage& passage = global.throughput.passages[number];
    const double speed = speed_of(grain.velocity);
    NewParticle p{grain.id, {}, grain.velocity, grain.group, 0, grain.mass};
    p.radius = grain.radius;
    for (std::size_t a = 0; a < 3; ++a) {
      p.position[a] = scale_.metres(grain.position[a]);
      passage.momentum[a] += grain.mass * grain.velocity[a];
    }
    passage.amounts[0] += grain.mass;
    passage.kinetic_energy += 0.5 * grain.mass * (speed * speed);
    ++passage.count;
    ++set.census.count;
    set.census.xor_of_ids ^= grain.id;
    if (distribution.owns(grain.position)) mine.push_back(p);
    global.max_speed = std::max(global.max_speed, speed);
  }
  return mine;
}

}  // namespace sph

// Set-up of a simulation: from the scene's start or from a checkpoint.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <vector>

#include "sph/fusions.hpp"
#include "sph/models/models.hpp"
#include "sph/placement.hpp"
#include "sph/simulation.hpp"
#include "sph/united.hpp"

namespace sph {
namespace {

// Passes over movers write nothing to walls, whose partners read all the same: nothing is what they read.
void forget_sums(Particles& particles) {
  for (const Field f : particles.fields().list())
    if (!info(f).state)
      std::memset(particles.table().column(particles.column(f)).data(), 0,
                  particles.owned() * width(f, particles.dim()));
}

}  // namespace

Simulation::Simulation(const decomp::Comm& comm, const Scene& scene)
    : comm_(comm),
      scene_(scene),
      scale_(position_scale(scene_)),
      wrap_(wrap_of(scene_, scale_)),
      parts_(scene_, scale_),
      distribution_(comm_, scene_, scale_) {
  add_sets();
  for (ParticleSet& set : sets_) place_particles(scene_, scale_, distribution_, set.particles);
  double dt = std::numeric_limits<double>::infinity();
  for (Model* m : parts_.models) dt = std::min(dt, m->start(comm_, sets_[m->set()].particles, global_));
  global_.dt = dt;
  try {
    for (std::size_t set = 0; set < sets_.size(); ++set)
      guard_motion(longest_move(parts_.plan.drift, set, global_));
  } catch (const GuardError& error) {
    throw InputError(scene_.file + ": start: " + error.what());
  }
  begin();
  for (const Model* m : parts_.models) m->check_start(comm_, state_of(m->set(), global_));
  settle();
}

Simulation::Simulation(const decomp::Comm& comm, const Scene& scene, const CheckpointHandle& checkpoint)
    : comm_(comm),
      scene_(scene),
      scale_(checkpoint.record.scale),
      wrap_(wrap_of(scene_, scale_)),
      parts_(scene_, scale_),
      distribution_(comm_, scene_, scale_) {
  add_sets();
  if (sets_.size() == 1) {
    read_checkpoint(comm_, checkpoint, sets_.front().particles, has_history() ? &arrived_ : nullptr);
  } else {
    Particles all(scene_.dim, fields_of(sets_));
    read_checkpoint(comm_, checkpoint, all, has_history() ? &arrived_ : nullptr);
    divide(all, scene_, sets_, arrived_, parts_.grains ? parts_.grains->set() : sets_.size());
  }
  global_ = checkpoint.record.global;
  begin();
}

void Simulation::add_sets() {
  for (const Parts::Set& set : parts_.sets)
    sets_.push_back(
        {Particles(scene_.dim, set.fields), set.stays, {}, {}, HaloExchange(scene_.decomposition.overlap)});
  moved_.assign(sets_.size(), 0);
  add_dawdling();
}

void Simulation::begin() {
  census_ = census();
  if (particle_count() == 0) throw InputError(scene_.file + ": start: no particle lies in any region");
  distribution_.cut_by_counts(sets_);
  scatter();
  for (ParticleSet& set : sets_) forget_sums(set.particles);
  for (const Model* m : parts_.models) m->derive(sets_[m->set()].particles);
  // Sorts the rows: what drifts needs to know which of them move.
  rebuild();
  Findings outside;
  for (const ParticleSet& set : sets_) outside.add(distribution_.outside(set.particles));
  if (const std::string text = outside.agree(comm_); !text.empty())
    throw InputError(scene_.file + ": start: " + text);
  run(parts_.plan.start, global_);
  findings_.stop(comm_);
  stale_ = drifts_first();
}

// May the next step leave the skin before it looks at lists?
bool Simulation::drifts_first() const {
  return std::ranges::any_of(parts_.plan.drift, [](const Entry& e) {
    return std::ranges::any_of(e.stages, [](const Stage& s) { return bool{s.moves}; });
  });
}

// Every row, with what its pairs carry, to the rank that owns it.
void Simulation::scatter() {
  for (std::size_t k = 0; k < sets_.size(); ++k) {
    const bool carries =
        std::ranges::any_of(parts_.pairs, [&](const SetPair* p) { return p->set() == k && p->carries(); });
    if (carries && arrived_.rows() == 0) arrived_.offset.assign(particles(k).owned() + 1, 0);
    distribution_.scatter(sets_[k].particles, carries ? &arrived_ : nullptr);
  }
}

std::int64_t Simulation::particle_count() const {
  std::int64_t count = 0;
  for (const decomp::Census& c : census_) count += c.count;
  return count;
}

const Particles& Simulation::particles() const {
  if (sets_.size() == 1) return sets_.front().particles;
  if (!united_) united_.emplace(unite(sets_));
  return *united_;
}

decomp::Payload Simulation::contacts() const {
  if (grains() == nullptr) return {};
  const std::size_t set = parts_.grains->set();
  return unite(grains()->lists().pack(particles(set)), sets_, set);
}

std::int64_t Simulation::refreshes() const {
  std::int64_t n = 0;
  for (const ParticleSet& set : sets_) n += set.exchange.refreshes();
  return n;
}

void Simulation::derive_for_output() {
  const std::vector<Entry>& stages = parts_.plan.output;
  if (stages.empty()) return;
  ParticleSet& set = sets_[stages.front().stages.front().set];
  Particles& particles = set.particles;
  const auto copy = [&](const double* values, std::size_t components) {
    return values == nullptr ? std::vector<double>()
                             : std::vector<double>(values, values + components * particles.owned());
  };
  double* velocity = particles.data<Field::velocity>();
  double* mirror = particles.data<Field::wall_mirror>();
  const std::vector<double> velocities = copy(velocity, static_cast<std::size_t>(scene_.dim)),
                            mirrors = copy(mirror, 1);
  run(stages, global_);
  std::copy(velocities.begin(), velocities.end(), velocity);
  std::copy(mirrors.begin(), mirrors.end(), mirror);
  for (const Entry& entry : stages)
    for (const Stage& stage : entry.stages) set.changed(stage.writes);
}

// What a start cannot say of a particle alone.
void Simulation::settle() {
  if (parts_.plan.settle.empty()) return;
  if (scene_.has_eos(EosKind::ideal_gas)) {
    widen_kernels();
    return;
  }
  run(parts_.plan.settle, global_);
  if (const std::string text = findings_.agree(comm_); !text.empty())
    throw InputError(scene_.file + ": start: " + text);
  for (const Model* m : parts_.models) m->derive(sets_[m->set()].particles);
  run(parts_.plan.start, global_);
}

// At the start neither density nor kernels of a gas are known: steps towards them until none changes any more
// but by rounding. How many that takes follows from the scene alone: the largest change is that of all ranks.
void Simulation::widen_kernels() {
  ParticleSet& set = sets_[parts_.physics->set()];
  Particles& particles = set.particles;
  constexpr int most = 100;
  constexpr double rounding = 1e-13;
  const auto* group = particles.data<Field::group>();
  for (int k = 0; k < most; ++k) {
    double* density = particles.data<Field::density>();
    double* h = particles.data<Field::smoothing_length>();
    for (std::size_t i = 0; i < particles.owned(); ++i)
      if (!parts_.physics->is_wall(group[i])) density[i] = 0;  // not summed yet: no work is done
    set.changed({Field::density});
    const std::vector<double> before(h, h + particles.owned());
    run(parts_.plan.settle, global_);
    std::array<double, 1> change{0};
    for (std::size_t i = 0; i < before.size(); ++i)
      change[0] = std::max(change[0], std::abs(h[i] / before[i] - 1));
    comm_.max(change);
    refresh_halo({Field::smoothing_length}, parts_.physics->set());
    parts_.sph_pairs->rebuild(particles, list_setting(*parts_.sph_pairs), {}, {});
    if (change[0] < rounding) break;
  }
}

std::string Simulation::fingerprint() const {
  if (!has_history()) return sph::fingerprint(comm_, particles(), global_, scale_, wrap());
  const decomp::Payload entries = contacts();
  return sph::fingerprint(comm_, particles(), global_, scale_, wrap(),
                          {&entries, grains()->lists().entry_bytes()});
}

}  // namespace sph

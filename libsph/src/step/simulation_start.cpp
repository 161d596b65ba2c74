// Set-up of a simulation: from the scene's start or from a checkpoint.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <string>
#include <utility>
#include <vector>

#include "sph/plan/united.hpp"
#include "sph/scene/positions.hpp"
#include "sph/start/placement.hpp"
#include "sph/step/simulation.hpp"
#include "step/guards.hpp"

namespace sph {
namespace {

// Passes over movers write nothing to walls, whose partners read all the same: nothing is what they read.
void forget_sums(Particles& particles) {
  for (const Field f : particles.fields().list())
    if (!info(f).state)
      std::memset(particles.table().column(particles.column(f)).data(), 0,
                  particles.owned() * width(f, particles.dim()));
}

/// Fields of the owned rows, to be as they were.
class Kept {
 public:
  Kept(Particles& particles, FieldSet fields) : particles_(&particles) {
    for (const Field f : (fields & particles.fields()).list()) {
      const std::byte* data = column(f);
      columns_.emplace_back(f, std::vector<std::byte>(data, data + particles.owned() * bytes_of(f)));
    }
  }
  /// In rows of these groups.
  template <class Which>
  void put_back(Which&& which) {
    const auto* group = particles_->data<Field::group>();
    for (const auto& [field, bytes] : columns_)
      for (std::size_t i = 0; i < particles_->owned(); ++i)
        if (which(group[i]))
          std::memcpy(column(field) + i * bytes_of(field), bytes.data() + i * bytes_of(field),
                      bytes_of(field));
  }

 private:
  [[nodiscard]] std::size_t bytes_of(Field f) const { return width(f, particles_->dim()); }
  std::byte* column(Field f) { return particles_->table().column(particles_->column(f)).data(); }

  Particles* particles_;
  std::vector<std::pair<Field, std::vector<std::byte>>> columns_;
};

FieldSet state_fields() {
  FieldSet out;
  for (const FieldInfo& i : field_table)
    if (i.state) out |= FieldSet{i.field};
  return out;
}

/// Of a start: it is the scene that is wrong.
void refuse_faults(const decomp::Comm& comm, const Scene& scene, const Findings& findings) {
  if (const std::string text = findings.agree(comm); !text.empty())
    throw InputError(scene.file + ": start: " + text);
}

// For tests of the balance: a rank's cores are slower by `of.slowness`. All ranks have the stage, or they would count what
// guards find in different stages.
void add_dawdling(Plan& plan, const Decomposition& of, int rank, decomp::Timers& timers) {
  if (of.slowness <= 1) return;
  const double slowness = of.slow_rank == rank ? of.slowness : 0.0;
  append(
      plan.kick,
      {"dawdle", decomp::Region::update, {}, {}, [&timers, slowness, before = 0.0](StepState&, Side) mutable {
         const double until = before + slowness * (timers.cost() - before);
         while (timers.cost() < until) {
         }
         before = timers.cost();
       }});
}

}  // namespace

Simulation::Simulation(const decomp::Comm& comm, const Scene& scene)
    : State(comm, scene, position_scale(scene)) {
  for (ParticleSet& set : sets_) place_particles(scene_, scale_, distribution_, set.particles);
  double dt = std::numeric_limits<double>::infinity();
  for (Model* m : parts_.models) dt = std::min(dt, m->start(comm_, sets_[m->set()].particles, global_));
  global_.dt = dt;
  try {
    for (std::size_t set = 0; set < sets_.size(); ++set)
      guard_motion(*this, std::fmax(longest_move(parts_.plan.drift, set, global_), age_.look_back()));
  } catch (const GuardError& error) {
    throw InputError(scene_.file + ": start: " + error.what());
  }
  begin(nullptr, false);
  refuse_faults(comm_, scene_, runner_.findings());
  for (const Model* m : parts_.models) m->check_start(comm_, runner_.state_of(m->set(), global_));
  settle();
}

Simulation::Simulation(const decomp::Comm& comm, const Scene& scene, const CheckpointHandle& checkpoint)
    : State(comm, scene, checkpoint.record.scale) {
  FieldSet shown;
  if (sets_.size() == 1) {
    shown = read_checkpoint(comm_, checkpoint, sets_.front().particles, has_history() ? &arrived_ : nullptr);
  } else {
    Particles all(scene_.dim, fields_of(sets_));
    shown = read_checkpoint(comm_, checkpoint, all, has_history() ? &arrived_ : nullptr);
    divide(all, scene_, sets_, arrived_, parts_.grains ? parts_.grains->set() : sets_.size());
  }
  global_ = checkpoint.record.global;
  begin(&shown, checkpoint.other_laws);
  runner_.findings().stop(comm_);
}

void Simulation::begin(const FieldSet* again, bool other_laws) {
  add_dawdling(parts_.plan, scene_.decomposition, comm_.rank(), timers_);
  for (ParticleSet& set : sets_) set.census = set.count(comm_);
  if (particle_count() == 0 && global_.step == 0 &&  // later all may have left
      scene_.domain.openings.insertions.empty())
    throw InputError(scene_.file + ": start: no particle lies in any region");
  distribution_.cut_by_counts(movable(sets_));
  scatter();
  if (!again) derive();
  // Sorts the rows: what drifts needs to know which of them move.
  rebuild();
  std::vector<Kept> of_last_step;
  for (ParticleSet& set : sets_)
    if (again) of_last_step.emplace_back(set.particles, *again);
  if (again) derive();
  Findings outside;
  for (const ParticleSet& set : sets_) outside.add(distribution_.outside(set.particles));
  refuse_faults(comm_, scene_, outside);
  // A state stays as it is: what has failed at the end of its step bears less now than its stress still says.
  FieldSet changed;
  for (const Entry& entry : parts_.plan.start)
    for (const Stage& stage : entry.stages) changed |= stage.writes & state_fields();
  std::vector<Kept> kept;
  for (ParticleSet& set : sets_)
    if (again) kept.emplace_back(set.particles, changed);
  runner_.run(parts_.plan.start, global_);
  // Nothing says of walls what other laws would make of them.
  const auto as_it_was = [&](std::size_t group) {
    return !other_laws || scene_.groups[group].kind == GroupKind::wall;
  };
  for (Kept& of : kept) of.put_back([](std::size_t) { return true; });
  for (Kept& of : of_last_step) of.put_back(as_it_was);
  for (ParticleSet& set : sets_)
    if (again) set.changed(*again & set.particles.fields());
  stale_ = may_drift(parts_.plan);
}

void Simulation::derive() {
  for (ParticleSet& set : sets_) forget_sums(set.particles);
  for (const Model* m : parts_.models) m->derive(sets_[m->set()].particles);
}

// Every row, with what its pairs carry, to the rank that owns it.
void Simulation::scatter() {
  for (std::size_t k = 0; k < sets_.size(); ++k) {
    const bool carries =
        std::ranges::any_of(parts_.pairs, [&](const SetPair* p) { return p->set() == k && p->carries(); });
    if (carries && arrived_.rows() == 0) arrived_.offset.assign(particles(k).owned() + 1, 0);
    if (const OwnersOf& owners = sets_[k].owners)
      decomp::redistribute(comm_, owners(sets_[k].particles), sets_[k].particles.table(), nullptr);
    else
      distribution_.scatter(sets_[k].particles, carries ? &arrived_ : nullptr);
  }
}

// What a start cannot say of a particle alone.
void Simulation::settle() {
  const Plan& plan = parts_.plan;
  if (plan.settle.empty()) return;
  if (plan.settling) {
    approach(*plan.settling, plan.settle.front().stages.front().set);
    return;
  }
  runner_.run(plan.settle, global_);
  refuse_faults(comm_, scene_, runner_.findings());
  for (const Model* m : parts_.models) m->derive(sets_[m->set()].particles);
  runner_.run(plan.start, global_);
}

// How many repetitions it takes follows from the scene alone: the largest change is that of all ranks.
void Simulation::approach(Settling& settling, std::size_t set) {
  constexpr int most = 100;
  constexpr double rounding = 1e-13;
  decomp::Payload nothing;
  for (int k = 0; k < most; ++k) {
    settling.prepare(sets_[set].particles);
    sets_[set].changed(settling.prepares);
    runner_.run(parts_.plan.settle, global_);
    std::array<double, 1> change{settling.change(particles(set))};
    comm_.max(change);
    refresh_halo(settling.settles, set);
    for (SetPair* pair : parts_.pairs)
      if (pair->set() == set) pair->rebuild(particles(set), list_setting(*pair), nothing, {});
    if (change[0] < rounding) break;
  }
}

}  // namespace sph

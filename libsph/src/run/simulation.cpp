#include "sph/simulation.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "decomp/poison.hpp"
#include "pairs/poison_rows.hpp"
#include "physics/viscosity_solver.hpp"

namespace sph {

std::int64_t Simulation::step(std::int64_t request) {
  if (grains_)
    step_in_a_sweep();
  else
    step_in_passes();
  if (scene_.decomposition.slowness > 1 && scene_.decomposition.slow_rank == comm_.rank()) dawdle();
  return finish_step(request);
}

// For tests of the balance: this rank's cores are slower by scene.decomposition.slowness.
void Simulation::dawdle() {
  const auto timing = timers_.time(decomp::Region::update);
  const double until = slow_until_ + scene_.decomposition.slowness * (timers_.cost() - slow_until_);
  while (timers_.cost() < until) {
  }
  slow_until_ = timers_.cost();
}

// SPH: positions advance, passes with their updates, kick.
void Simulation::step_in_passes() {
  if (global_.step == 0 && scene_.has_eos(EosKind::ideal_gas)) kick_half_a_step();
  {
    const auto timing = timers_.time(decomp::Region::update);
    physics_.advance(particles_, distribution_.ranges(), global_.dt);
    moved_ += physics_.longest_advance(global_);
    changed({Field::position, Field::displacement});
  }
  if (stale_) rebuild();

  for (const Pass& pass : physics_.passes()) compute(pass);

  const auto timing = timers_.time(decomp::Region::update);
  maxima_ = physics_.integrate(particles_, distribution_.ranges(), global_);
  changed(physics_.integrated());
}

// Velocities are those of half a step later. A gas may start with a jump of its pressure, and accelerations
// are never larger than then: the error of a first step that takes them as they are would stay in its energy.
void Simulation::kick_half_a_step() {
  for (const Pass& pass : physics_.passes()) compute(pass);
  GlobalState part = global_;
  const auto kick = [&](double share) {
    part.dt = share * global_.dt;
    maxima_ = physics_.integrate(particles_, distribution_.ranges(), part);
    std::array<double, 5> all{maxima_.speed, maxima_.acceleration, maxima_.sound, maxima_.viscosity,
                              physics_.growth(particles_, reaches_)};
    comm_.max(all);
    growth_ = all[4];
    global_.max_speed = all[0];
    global_.max_acceleration = all[1];
    return physics_.time_step({all[0], all[1], 0, all[2], all[3]});
  };
  global_.dt = kick(0);  // how large a step may be follows from the accelerations
  (void)kick(0.5);
  physics_.findings().stop(comm_);
  changed(physics_.integrated());
  find_stale(physics_.longest_advance(global_));
}

void Simulation::compute(const Pass& pass) {
  const PassContext context = physics_.context(particles_, lists_, rows_, global_.dt);
  auto pack = pass.fusion->pack;
  do {
    refresh_begin(pass.reads);
    run(pass, context, Side::interior, pack);
    refresh_end();
    run(pass, context, Side::boundary, pack);
    changed(pass.fusion->writes);
    pack = pass.fusion->repack;
  } while (pass.solver && improve(pass));
  if (!pass.update) return;
  const auto timing = timers_.time(decomp::Region::update);
  pass.update(particles_, distribution_.ranges(), global_);
  changed(pass.changes);
}

// An iteration of a solver: is the pass to be run once more?
bool Simulation::improve(const Pass& pass) {
  const auto products = [&] {
    const auto timing = timers_.time(decomp::Region::update);
    return pass.solver->products(particles_, distribution_.ranges(), global_.dt);
  }();
  {
    const auto timing = timers_.time(decomp::Region::reduce);
    decomp::ExactSum::all_reduce(comm_, products);
  }
  const auto timing = timers_.time(decomp::Region::update);
  const bool again = pass.solver->improve(particles_, distribution_.ranges(), global_);
  changed(pass.changes);
  if (again && !products.empty()) ++counters_.iterations;
  if (!again) ++counters_.solved;
  return again;
}

// Grains: contacts and walls of a block of rows, then at once the kick and drift of its grains.
void Simulation::step_in_a_sweep() {
  grains_->set_stage(global_);
  if (stale_) rebuild();
  grains_->begin_step(particles_, global_);
  const auto sweep = [&](std::span<const ContactBlock> blocks) {
    const auto timing = timers_.time(decomp::Region::contacts);
    grains_->sweep(particles_, blocks, distribution_.ranges(), global_.dt);
  };
  refresh_begin(grains_->reads());
  sweep(grains_->lists().interior());
  refresh_end();
  sweep(grains_->lists().boundary());
  changed(grains_->reads());
  maxima_ = {std::sqrt(grains_->swept().speed2), std::sqrt(grains_->swept().acceleration2)};
}

// Measured cost -> new cuts -> migrate -> sort by (Hilbert key of cell, id) -> halo plan -> neighbour lists.
void Simulation::rebuild() {
  decomp::Payload contacts = std::exchange(arrived_, {});
  ContactCensus sent;
  if (grains_) {
    const auto timing = timers_.time(decomp::Region::lists);
    grains_->release();
    if (contacts.rows() == 0) contacts = this->contacts();
    sent = ContactLists::census(particles_, contacts, grains_->lists().history());
  }
  std::vector<std::uint32_t> order;
  {
    const auto timing = timers_.time(decomp::Region::migrate);
    try {
      order = distribution_.rebuild(
          particles_, timers_.take_cost(), [&] { return pairs_of_rows(); }, is_wall_group_, moved_,
          grains_ ? 0.0 : 2 * std::max(physics_.longest_look_back(global_), physics_.longest_shift(global_)),
          grains_ ? &contacts : nullptr);
    } catch (const GuardError& error) {
      throw GuardError(step_text(global_.step) + error.what());
    }
    if (decomp::census(comm_, particles_.table(), particles_.column(Field::id)) != census_)
      throw GuardError("step " + std::to_string(global_.step) +
                       ": a particle was lost or duplicated in migration; reduce time.dt");
  }
  fresh_ = {};
  refresh_begin(grains_ ? Grains::constants()
                        : FieldSet{Field::id, Field::position, Field::smoothing_length, Field::group});
  refresh_end();
  if (grains_)
    rebuild_contacts(contacts, order, sent);
  else
    build_lists();
  moved_ = 0;
  ++counters_.rebuilds;
}

void Simulation::build_lists() {
  reaches_ = physics_.reaches(particles_);
  if (reaches_.empty()) {
    lists_.build(particles_, distribution_.grid(), distribution_.own_cells(), distribution_.list_radius(),
                 distribution_.ranges(), timers_);
    if (particles_.fields().has(Field::wall_share)) lists_.mark_walls(particles_, is_wall_group_);
    return;
  }
  std::vector<double> quanta(reaches_.size());
  for (std::size_t i = 0; i < quanta.size(); ++i)
    quanta[i] = (reaches_[i] + distribution_.skin()) / scale_.quantum + 1;
  lists_.build(particles_, quanta, distribution_.ranges(), timers_);
}

// What the passes look at for each row, as far as the blocks of the lists tell.
std::vector<std::uint32_t> Simulation::pairs_of_rows() const {
  std::vector<std::uint32_t> pairs(particles_.owned(), 0);
  const auto share = [&](std::size_t first, std::size_t last, std::size_t entries) {
    for (std::size_t i = first; i < std::min(last, pairs.size()); ++i)
      pairs[i] = static_cast<std::uint32_t>(entries / (last - first));
  };
  if (counters_.rebuilds == 0) return pairs;
  if (grains_) {
    const ContactLists& lists = grains_->lists();
    for (const auto blocks : {lists.interior(), lists.boundary()})
      for (const ContactBlock& b : blocks)
        share(b.first, b.last, (b.pairs_end - b.pairs) * ContactGroups::lanes);
    return pairs;
  }
  const auto lanes = static_cast<std::size_t>(lists_.lanes());
  for (const RowRange& range : distribution_.ranges())
    for (std::size_t first = range.first, b = range.first_block; first < range.last; first += lanes, ++b)
      share(first, std::min<std::size_t>(first + lanes, range.last), lists_.block(b).size());
  return pairs;
}

// No contact may be lost or doubled on its way: count and keys are those of the entries that set out.
void Simulation::rebuild_contacts(const decomp::Payload& contacts, std::span<const std::uint32_t> order,
                                  const ContactCensus& sent) {
  const auto timing = timers_.time(decomp::Region::lists);
  const ContactCensus found = grains_->rebuild(particles_, distribution_.grid(), distribution_.own_cells(),
                                               distribution_.list_radius(), distribution_.skin(),
                                               distribution_.ranges(), global_, contacts, order);
  Findings lost;
  grains_->find_lost(particles_, global_, distribution_.skin(), lost);
  std::array<std::uint64_t, 6> all{sent.count, sent.keys,       found.count,
                                   found.keys, found.one_sided, lost.any() ? 1U : 0U};
  comm_.sum(std::span<std::uint64_t>(all));
  if (all[5] != 0) lost.stop(comm_, step_text(global_.step));
  if (all[0] != all[2] || all[1] != all[3] || all[4] != 0)
    throw GuardError("step " + std::to_string(global_.step) + ": of " + std::to_string(all[0]) +
                     " entries of contacts " + std::to_string(all[2]) +
                     " were found again after the lists were rebuilt; reduce time.dt");
}

void Simulation::run(const Pass& pass, const PassContext& context, Side side, Pack pack) {
  const auto timing = timers_.time(decomp::Region::pairs);
  const bool interior = side == Side::interior;
  // Interior particles have no partner in the halo, so rows of the halo are packed only afterwards.
  pack(context, interior ? 0 : particles_.owned(), interior ? particles_.owned() : particles_.rows());
  if (interior && pack == pass.fusion->pack)
    poison_rows(context, pass.fusion->row_bytes, particles_.owned(), particles_.rows());
  const auto range = [&](RowClass c) -> const RowRange& {
    return distribution_.ranges()[static_cast<std::size_t>(c)];
  };
  if (pass.movers)
    pass.fusion->run(context, range(interior ? RowClass::interior_movers : RowClass::boundary_movers));
  if (pass.walls)
    pass.fusion->run(context, range(interior ? RowClass::interior_walls : RowClass::boundary_walls));
}

// Halo copies of these fields are out of date.
void Simulation::changed(FieldSet fields) {
  fresh_ = fresh_.without(fields);
  if (!decomp::poisons()) return;
  std::vector<int> columns;
  for (Field f : (fields & particles_.fields()).list()) columns.push_back(particles_.column(f));
  decomp::poison_halo(particles_.table(), columns);
}

void Simulation::refresh_begin(FieldSet wanted) {
  const auto timing = timers_.time(decomp::Region::pack);
  const FieldSet send = (wanted & particles_.fields()).without(fresh_);
  std::vector<int> columns;
  for (Field f : send.list()) columns.push_back(particles_.column(f));
  refreshing_ = !columns.empty();
  if (!refreshing_) return;
  distribution_.halo().begin(particles_.table(), columns);
  fresh_ |= send;
  ++counters_.refreshes;
  if (!scene_.decomposition.overlap) refresh_end();
}

void Simulation::refresh_end() {
  if (!refreshing_) return;
  refreshing_ = false;
  {
    const auto timing = timers_.time(decomp::Region::halo_wait);
    distribution_.halo().wait();
  }
  const auto timing = timers_.time(decomp::Region::pack);
  distribution_.halo().end();
}

void Simulation::refresh_halo(FieldSet fields) {
  refresh_begin(fields);
  refresh_end();
}

void Simulation::refresh_contacts() {
  if (stale_) rebuild();
  stale_ = false;
  refresh_halo(grains_->reads());
}

// The one reduction of a step. What it brings acts in the next step.
std::int64_t Simulation::finish_step(std::int64_t request) {
  const bool finite = std::isfinite(maxima_.speed) && std::isfinite(maxima_.acceleration) &&
                      std::isfinite(maxima_.sound) && !physics_.findings().any();
  const Findings left = find_leavers();
  std::array<double, 9> all{finite ? maxima_.speed : 0, finite ? maxima_.acceleration : 0, finite ? 0.0 : 1.0,
                            static_cast<double>(request)};
  all[6] = left.any() ? 1 : 0;
  std::vector<std::int64_t> sums;
  if (!grains_ && finite) all[4] = maxima_.sound, all[5] = maxima_.viscosity;
  if (!grains_) all[7] = physics_.growth(particles_, reaches_);
  if (grains_) {
    all[4] = grains_->swept().strong.any() ? 1.0 : 0.0;
    all[5] = grains_->swept().deep.any() ? 1.0 : 0.0;
    sums = grains_->wall_force();
  } else if (scene_.terms.shifting) {
    all[8] = maxima_.motion.largest;
    sums.assign(maxima_.motion.sums.begin(), maxima_.motion.sums.end());
    sums.push_back(maxima_.volume);
  }
  {
    const auto timing = timers_.time(decomp::Region::reduce);
    if (sums.empty())
      comm_.max(all);
    else
      comm_.max_and_sum(all, sums);
  }
  if (grains_) guard_sweep(all);
  if (all[2] > 0) stop_at_bad_particle();
  if (all[6] > 0) left.stop(comm_, step_text(global_.step));
  if (grains_) {
    // Walls drift before servos change their speeds.
    moved_ += 1.0001 * std::max(all[0], grains_->fastest_wall(global_)) * global_.dt;
    grains_->move_walls(global_, wall_forces(sums));
  } else {
    growth_ = all[7];
    moved_ += physics_.longest_shift(global_);
    if (scene_.terms.shifting) take_motion(sums, all[8]);
  }
  ++global_.step;
  global_.time += global_.dt;
  global_.max_speed = all[0];
  global_.max_acceleration = all[1];
  if (!grains_) global_.dt = physics_.time_step({all[0], all[1], 0, all[4], all[5]});
  if (!grains_ && scene_.time.dt &&
      all[4] * *scene_.time.dt > courant_limit(scene_) * scene_.smoothing_length)
    throw GuardError("step " + std::to_string(global_.step) + ": (c + u) dt/h is beyond the limit of " +
                     std::to_string(courant_limit(scene_)) + ", or the kernels of a gas that expands grow " +
                     "too fast for it; reduce time.dt");
  find_stale(grains_ ? 0.0 : physics_.longest_advance(global_) + physics_.longest_shift(global_));
  return static_cast<std::int64_t>(all[3]);
}

void Simulation::take_motion(std::span<const std::int64_t> sums, double largest) {
  MotionSums motion{{}, largest};
  std::copy_n(sums.begin(), motion.sums.size(), motion.sums.begin());
  global_.motion = physics_.common_motion(motion, global_);
  if (!scene_.open) global_.fluid_volume.now = sums.back();
}

// A particle that leaves the domain does so in this step, wherever a rebuild would next look at it. Few ranks
// have to look: how far particles were from the faces is known from the last rebuild, and so is a bound on
// their way since.
Findings Simulation::find_leavers() const {
  const double step = grains_ ? 1.0001 * maxima_.speed * global_.dt : physics_.longest_shift(global_);
  return moved_ + step < distribution_.to_face() ? Findings() : distribution_.outside(particles_);
}

// Lists must hold every pair that a pass of the next step takes, wherever it takes its particles to be: after
// they have moved by `next`, or half a step before that. moved_ bounds every particle's path since the
// rebuild by the largest speed of each step: no positions to remember, and never late. A rebuild in that step
// finds lists that are wide enough for it, however small the scene's skin (rebuild()). Grains are looked at
// again when the bound runs out: one that flies through the sparse part of a scene must not cost rebuilds of
// the rest.
void Simulation::find_stale(double next) {
  guard_motion(next);
  const int every = scene_.decomposition.rebuild_every;
  const double furthest = grains_ ? moved_ : std::max(moved_ + next, physics_.longest_look_back(global_));
  stale_ = furthest > 0.5 * distribution_.skin() || growth_ > 1 || (every > 0 && global_.step % every == 0);
  if (!grains_ || !stale_ || (every > 0 && global_.step % every == 0)) return;
  const auto timing = timers_.time(decomp::Region::reduce);
  std::array<double, 1> way{grains_->longest_way(particles_, global_)};
  comm_.max(way);
  moved_ = way[0];
  // Another step of the fastest grain must fit, or this look was for nothing.
  stale_ = moved_ + 2 * global_.max_speed * global_.dt > 0.5 * distribution_.skin();
}

}  // namespace sph

// Set-up of a simulation: from the scene's start or from a checkpoint.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include "sph/fusions.hpp"
#include "sph/models/models.hpp"
#include "sph/placement.hpp"
#include "sph/simulation.hpp"
#include "start/start_densities.hpp"
#include "start/start_overlaps.hpp"

namespace sph {

Simulation::Simulation(const decomp::Comm& comm, const Scene& scene)
    : comm_(comm),
      scene_(scene),
      scale_(position_scale(scene_)),
      physics_(scene_, scale_),
      distribution_(comm_, scene_, scale_),
      particles_(scene_.dim, physics_.fields()),
      sph_pairs_(physics_),
      exchange_(scene_.decomposition.overlap) {
  place_particles(scene_, scale_, distribution_, particles_);
  add_models();
  if (grains_) {
    global_.dt = grains_->time_step();
    global_.walls = grains_->first_walls();
    check_start_speeds(comm_, scene_, particles_);
    begin();
    refuse_overlaps(comm_, scene_, scale_, particles_, grains_->lists(), grains_->planes(global_));
    return;
  }
  check_start_densities(comm_, scene_, particles_);
  const StepMaxima own = physics_.maxima_at_start(particles_);
  std::array<double, 3> largest{own.speed, own.sound, own.viscosity};
  comm_.max(largest);
  global_.max_speed = largest[0];
  global_.dt = physics_.time_step({largest[0], 0, 0, largest[1], largest[2]});
  if (physics_.shifting()) find_common_motion(*physics_.shifting());
  try {
    guard_motion(longest_drift(global_));
  } catch (const GuardError& error) {
    throw InputError(scene_.file + ": start: " + error.what());
  }
  begin();
  if (scene_.has_eos(EosKind::ideal_gas)) widen_kernels();
}

Simulation::Simulation(const decomp::Comm& comm, const Scene& scene, const CheckpointHandle& checkpoint)
    : comm_(comm),
      scene_(scene),
      scale_(checkpoint.record.scale),
      physics_(scene_, scale_),
      distribution_(comm_, scene_, scale_),
      particles_(scene_.dim, physics_.fields()),
      sph_pairs_(physics_),
      exchange_(scene_.decomposition.overlap) {
  add_models();
  read_checkpoint(comm_, checkpoint, particles_, has_history() ? &arrived_ : nullptr);
  global_ = checkpoint.record.global;
  begin();
}

void Simulation::find_common_motion(const Shifting& shifting) {
  const Shifting::Motion moving(particles_);
  global_.fluid_volume.start = global_.fluid_volume.now = comm_.sum(shifting.fluid_volume(moving));
  // The mean first, then the largest difference from it, then all.
  global_.motion.largest = global_.max_speed;
  for (int k = 0; k < 3; ++k) {
    MotionSums motion = shifting.motion_sums(moving, global_);
    comm_.sum(std::span<std::int64_t>(motion.sums));
    std::array<double, 1> most{motion.largest};
    comm_.max(most);
    motion.largest = most[0];
    global_.motion = shifting.common_motion(motion, global_);
  }
}

void Simulation::add_models() {
  if (scene_.of_grains()) grains_.emplace(scene_, scale_);
  pairs_ = grains_ ? static_cast<SetPair*>(&*grains_) : &sph_pairs_;
  models_ = {grains_ ? static_cast<Model*>(&*grains_) : &physics_};
  plan_ = grains_ ? grains_->plan() : physics_.plan();
  for (Model* m : models_) m->reserve(reduction_);
  add_dawdling();
}

void Simulation::begin() {
  for (const Group& g : scene_.groups) is_wall_group_.push_back(g.kind == GroupKind::wall || g.grain.fixed);
  census_ = decomp::census(comm_, particles_.table(), particles_.column(Field::id));
  count_ = census_.count;
  if (count_ == 0) throw InputError(scene_.file + ": start: no particle lies in any region");
  distribution_.cut_by_counts(particles_);
  const bool carries = pairs_->carries();
  if (carries && arrived_.rows() == 0) arrived_.offset.assign(particles_.owned() + 1, 0);
  distribution_.scatter(particles_, carries ? &arrived_ : nullptr);
  // Passes over movers write nothing to walls, whose partners read all the same: nothing is what they read.
  for (const Field f : particles_.fields().list())
    if (!info(f).state)
      std::memset(particles_.table().column(particles_.column(f)).data(), 0,
                  particles_.owned() * width(f, particles_.dim()));
  if (!grains_) physics_.derive(particles_, 0, particles_.owned());
  // Sorts the rows: advance() needs to know which of them move.
  rebuild();
  if (const std::string text = distribution_.outside(particles_).agree(comm_); !text.empty())
    throw InputError(scene_.file + ": start: " + text);
  if (scene_.total_lagrangian()) run(plan_.start);
  findings_.stop(comm_);
  stale_ = !grains_;  // the first advance may leave the skin
}

void Simulation::derive_for_output() {
  if (plan_.output.empty()) return;
  const auto copy = [&](const double* values, std::size_t components) {
    return values == nullptr ? std::vector<double>()
                             : std::vector<double>(values, values + components * particles_.owned());
  };
  double* velocity = particles_.data<Field::velocity>();
  double* mirror = particles_.data<Field::wall_mirror>();
  const std::vector<double> velocities = copy(velocity, static_cast<std::size_t>(scene_.dim)),
                            mirrors = copy(mirror, 1);
  run(plan_.output);
  std::copy(velocities.begin(), velocities.end(), velocity);
  std::copy(mirrors.begin(), mirrors.end(), mirror);
  for (const Entry& entry : plan_.output)
    for (const Stage& stage : entry.stages) changed(stage.writes);
}

// At the start neither density nor kernels of a gas are known: steps towards them until none changes any more
// but by rounding. How many that takes follows from the scene alone: the largest change is that of all ranks.
void Simulation::widen_kernels() {
  constexpr int most = 100;
  constexpr double rounding = 1e-13;
  const auto* group = particles_.data<Field::group>();
  for (int k = 0; k < most; ++k) {
    double* density = particles_.data<Field::density>();
    double* h = particles_.data<Field::smoothing_length>();
    for (std::size_t i = 0; i < particles_.owned(); ++i)
      if (!physics_.is_wall(group[i])) density[i] = 0;  // not summed yet: no work is done
    changed({Field::density});
    const std::vector<double> before(h, h + particles_.owned());
    run(plan_.start);
    std::array<double, 1> change{0};
    for (std::size_t i = 0; i < before.size(); ++i)
      change[0] = std::max(change[0], std::abs(h[i] / before[i] - 1));
    comm_.max(change);
    refresh_halo({Field::smoothing_length});
    sph_pairs_.rebuild(particles_, list_setting(), {}, {});
    if (change[0] < rounding) break;
  }
}

std::string Simulation::fingerprint() const {
  if (!has_history()) return sph::fingerprint(comm_, particles_, global_, scale_, wrap());
  const decomp::Payload entries = contacts();
  return sph::fingerprint(comm_, particles_, global_, scale_, wrap(),
                          {&entries, grains_->lists().entry_bytes()});
}

}  // namespace sph

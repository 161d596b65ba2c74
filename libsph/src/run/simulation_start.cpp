// Set-up of a simulation: from the scene's start or from a checkpoint.
#include <array>
#include <string>

#include "sph/placement.hpp"
#include "sph/simulation.hpp"

namespace sph {

Simulation::Simulation(const decomp::Comm& comm, const Scene& scene)
    : comm_(comm),
      scene_(scene),
      scale_(position_scale(scene_)),
      physics_(scene_, scale_),
      distribution_(comm_, scene_, scale_),
      particles_(scene_.dim, physics_.fields()),
      lists_(lanes_of(scene_.precision)) {
  place_particles(scene_, scale_, distribution_, particles_);
  if (scene_.of_grains()) {
    grains_.emplace(scene_, scale_);
    global_.dt = grains_->time_step();
    global_.walls = grains_->first_walls();
    begin();
    return;
  }
  const StepMaxima own = physics_.maxima_at_start(particles_);
  std::array<double, 3> largest{own.speed, own.sound, own.viscosity};
  comm_.max(largest);
  global_.max_speed = largest[0];
  global_.dt = physics_.time_step({largest[0], 0, 0, largest[1], largest[2]});
  global_.fluid_volume.start = global_.fluid_volume.now = comm_.sum(physics_.fluid_volume(particles_));
  begin();
}

Simulation::Simulation(const decomp::Comm& comm, const Scene& scene, const CheckpointHandle& checkpoint)
    : comm_(comm),
      scene_(scene),
      scale_(checkpoint.record.scale),
      physics_(scene_, scale_),
      distribution_(comm_, scene_, scale_),
      particles_(scene_.dim, physics_.fields()),
      lists_(lanes_of(scene_.precision)) {
  if (scene_.of_grains()) grains_.emplace(scene_, scale_);
  read_checkpoint(comm_, checkpoint, particles_, has_history() ? &arrived_ : nullptr);
  global_ = checkpoint.record.global;
  begin();
}

void Simulation::begin() {
  for (const Group& g : scene_.groups) is_wall_group_.push_back(g.kind == GroupKind::wall || g.grain.fixed);
  census_ = decomp::census(comm_, particles_.table(), particles_.column(Field::id));
  count_ = census_.count;
  if (count_ == 0) throw InputError(scene_.file + ": start: no particle lies in any region");
  distribution_.cut_by_counts(particles_);
  if (grains_ && arrived_.rows() == 0) arrived_.offset.assign(particles_.owned() + 1, 0);
  distribution_.scatter(particles_, grains_ ? &arrived_ : nullptr);
  if (!grains_) physics_.derive(particles_, 0, particles_.owned());
  // Sorts the rows: advance() needs to know which of them move.
  rebuild();
  // What bonds there are is known only from the start, and output wants the stress, and the density of gases.
  if (scene_.total_lagrangian() || scene_.has_eos(EosKind::ideal_gas)) compute(physics_.passes().front());
  stale_ = !grains_;  // the first advance may leave the skin
}

Wrap Simulation::wrap() const {
  Wrap wrap;
  for (std::size_t a = 0; a < 3; ++a) {
    wrap.origin[a] = distribution_.grid().origin()[a];
    if (scene_.periodic[a]) wrap.period[a] = distribution_.grid().length()[a];
  }
  return wrap;
}

std::string Simulation::fingerprint() const {
  if (!has_history()) return sph::fingerprint(comm_, particles_, global_, scale_, wrap());
  const decomp::Payload entries = contacts();
  return sph::fingerprint(comm_, particles_, global_, scale_, wrap(),
                          {&entries, grains_->lists().entry_bytes()});
}

}  // namespace sph

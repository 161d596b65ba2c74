#include "sph/simulation.hpp"

#include <cmath>
#include <string>

#include "sph/placement.hpp"

namespace sph {

// ---- the step -------------------------------------------------------------------------------------------

std::int64_t Simulation::step(std::int64_t request) {
  {
    const auto timing = timers_.time(decomp::Region::update);
    physics_.advance(particles_, distribution_.ranges(), global_.dt);
    moved_ += physics_.longest_advance(global_);
    changed({Field::position});
  }
  if (stale_) rebuild();

  for (const Pass& pass : physics_.passes()) {
    const PassContext context = physics_.context(particles_, lists_, rows_);
    refresh_begin(pass.reads);
    run(pass, context, Side::interior);
    refresh_end();
    run(pass, context, Side::boundary);
    if (pass.update) {
      const auto timing = timers_.time(decomp::Region::update);
      pass.update(particles_, distribution_.ranges(), global_.dt);
      changed(pass.changes);
    }
  }

  StepMaxima maxima;
  {
    const auto timing = timers_.time(decomp::Region::update);
    maxima = physics_.integrate(particles_, distribution_.ranges(), global_);
    changed(physics_.integrated());
  }
  return finish_step(maxima, request);
}

// Measured cost -> new cuts -> migrate -> sort by (Hilbert key of cell, id) -> halo plan -> neighbour lists.
void Simulation::rebuild() {
  {
    const auto timing = timers_.time(decomp::Region::migrate);
    distribution_.rebuild(particles_, timers_.take_cost(), is_wall_group_, moved_);
    if (decomp::census(comm_, particles_.table(), particles_.column(Field::id)) != census_)
      throw GuardError("step " + std::to_string(global_.step) +
                       ": a particle was lost or duplicated in migration; reduce time.dt");
  }
  fresh_ = {};
  refresh_begin({Field::id, Field::position});
  refresh_end();
  lists_.build(particles_, distribution_.grid(), distribution_.own_cells(), distribution_.list_radius(),
               distribution_.ranges(), timers_);
  moved_ = 0;
  ++counters_.rebuilds;
}

void Simulation::run(const Pass& pass, const PassContext& context, Side side) {
  const auto timing = timers_.time(decomp::Region::pairs);
  const bool interior = side == Side::interior;
  // Interior particles have no partner in the halo, so rows of the halo are packed only afterwards.
  pass.fusion->pack(context, interior ? 0 : particles_.owned(),
                    interior ? particles_.owned() : particles_.rows());
  const auto range = [&](RowClass c) -> const RowRange& {
    return distribution_.ranges()[static_cast<std::size_t>(c)];
  };
  if (pass.movers)
    pass.fusion->run(context, range(interior ? RowClass::interior_movers : RowClass::boundary_movers));
  if (pass.walls)
    pass.fusion->run(context, range(interior ? RowClass::interior_walls : RowClass::boundary_walls));
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

// The one reduction of a step. What it brings acts in the next step.
std::int64_t Simulation::finish_step(const StepMaxima& maxima, std::int64_t request) {
  const bool finite = std::isfinite(maxima.speed) && std::isfinite(maxima.acceleration);
  std::array<double, 4> all{maxima.speed, maxima.acceleration, finite ? 0.0 : 1.0,
                            static_cast<double>(request)};
  {
    const auto timing = timers_.time(decomp::Region::reduce);
    if (!finite) all[0] = all[1] = 0;
    comm_.max(all);
  }
  if (all[2] > 0) stop_at_bad_particle();
  moved_ += physics_.longest_shift(global_);
  ++global_.step;
  global_.time += global_.dt;
  global_.max_speed = all[0];
  global_.max_acceleration = all[1];
  global_.dt = physics_.time_step({all[0], all[1]});
  const int every = scene_.decomposition.rebuild_every;
  // The list must still hold at the end of the next step. moved_ bounds every particle's path since the
  // rebuild by the largest speed of each step: no positions to remember, and never late.
  const double next = physics_.longest_advance(global_) + physics_.longest_shift(global_);
  if (next > 0.5 * scene_.support())
    throw GuardError("step " + std::to_string(global_.step) + ": the fastest particle would move " +
                     std::to_string(next) +
                     " m in one step, more than half the kernel's radius; reduce time.dt or time.cfl");
  stale_ = moved_ + next > 0.5 * distribution_.skin() || (every > 0 && global_.step % every == 0);
  return static_cast<std::int64_t>(all[3]);
}

// ---- set-up ---------------------------------------------------------------------------------------------

Simulation::Simulation(const decomp::Comm& comm, const Scene& scene)
    : comm_(comm),
      scene_(scene),
      scale_(position_scale(scene_)),
      physics_(scene_, scale_),
      distribution_(comm_, scene_, scale_),
      particles_(scene_.dim, physics_.fields()),
      lists_(lanes_of(scene_.precision)) {
  place_particles(scene_, scale_, distribution_, particles_);
  std::array<double, 1> fastest{physics_.largest_speed(particles_)};
  comm_.max(fastest);
  global_.max_speed = fastest[0];
  global_.dt = physics_.time_step({global_.max_speed, 0});
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
  read_checkpoint(comm_, checkpoint, particles_, nullptr);
  global_ = checkpoint.record.global;
  begin();
}

void Simulation::begin() {
  for (const Group& g : scene_.groups) is_wall_group_.push_back(g.kind == GroupKind::wall);
  census_ = decomp::census(comm_, particles_.table(), particles_.column(Field::id));
  count_ = census_.count;
  if (count_ == 0) throw InputError(scene_.file + ": start: no particle lies in any region");
  distribution_.cut_by_counts(particles_);
  distribution_.scatter(particles_);
  physics_.derive(particles_, 0, particles_.owned());
  // Sorts the rows: advance() needs to know which of them move.
  rebuild();
  stale_ = true;  // the first advance may leave the skin
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
  return sph::fingerprint(comm_, particles_, global_, scale_, wrap());
}

void Simulation::stop_at_bad_particle() const {
  const std::size_t d = static_cast<std::size_t>(particles_.dim());
  std::string what;
  const double* v = particles_.data<Field::velocity>();
  for (std::size_t i = 0; i < particles_.owned() && what.empty(); ++i)
    for (std::size_t a = 0; a < d; ++a)
      if (!std::isfinite(v[i * d + a])) {
        what =
            "particle " + std::to_string(particles_.data<Field::id>()[i]) + ": velocity is not finite at (";
        for (std::size_t b = 0; b < d; ++b)
          what += (b > 0 ? ", " : "") +
                  std::to_string(scale_.metres(particles_.data<Field::position>()[i * d + b]));
        what += ") m";
        break;
      }
  throw GuardError("step " + std::to_string(global_.step) + ": " +
                   (what.empty() ? "a particle on another rank is not finite" : what) +
                   "; reduce time.dt or time.cfl");
}

}  // namespace sph

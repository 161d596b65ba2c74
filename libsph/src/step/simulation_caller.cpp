// What a program does to a scene that it steps: accelerations of its own, grains that it puts in and takes out.
#include "sph/core/error.hpp"
#include "sph/step/simulation.hpp"

namespace sph {

void refuse_stillness(const Scene& scene) {
  if (scene.has_melt())
    throw InputError(scene.file + ": force: nothing in slow flow has inertia, which it could accelerate");
  if (!scene.terms.exchange.motion)
    throw InputError(scene.file + ": force: terms.motion is false, nothing in this scene moves");
}

void Simulation::exchange_grains(std::span<const std::uint64_t> gone, std::span<const GivenGrain> come) {
  if (!parts_.grain_openings)
    throw InputError(
        scene_.file +
        ": add, remove: this is no scene of grains alone that is open; give it an [[outlet]], an "
        "[[insertion]] or domain.leaves = \"delete\"");
  const std::size_t set = parts_.grain_openings->set();
  parts_.grain_openings->exchange(distribution_, gone, come, sets_[set], global_);
  rows_changed_ = true;
  rebuild();
  stale_ = age_.look(parts_.reduction, sets_, timers_);
}

}  // namespace sph

// The drag laws that are compiled in.
#include "sph/drag/di_felice.hpp"
#include "sph/drag/gidaspow.hpp"
#include "sph/drag/registry.hpp"
#include "sph/drag/stokes.hpp"
#include "sph/registry.hpp"
#include "sph/scene.hpp"

namespace sph {
namespace {

constexpr DragLaw none{"none", nullptr};

Registry<DragLaw>& registry() {
  static Registry<DragLaw> laws(
      {&none, &drag_entry_of<StokesDrag>(), &drag_entry_of<DiFeliceDrag>(), &drag_entry_of<GidaspowDrag>()});
  return laws;
}

}  // namespace

std::span<const DragLaw* const> drag_laws() { return registry().look(); }

void register_drag_law(const DragLaw& law) { registry().add(law); }

const DragLaw* no_drag() { return &none; }

}  // namespace sph

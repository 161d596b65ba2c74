// The drag laws that are compiled in.
#include "laws/registries.hpp"
#include "sph/laws/drag/beetstra.hpp"
#include "sph/laws/drag/di_felice.hpp"
#include "sph/laws/drag/gidaspow.hpp"
#include "sph/laws/drag/registry.hpp"
#include "sph/laws/drag/richardson_zaki.hpp"
#include "sph/laws/drag/stokes.hpp"
#include "sph/scene/scene.hpp"

namespace sph {
namespace {

constexpr DragLaw none{"none", nullptr};

}  // namespace

Registry<DragLaw>& drag_law_registry() {
  static Registry<DragLaw> laws({&none, &drag_entry_of<StokesDrag>(), &drag_entry_of<DiFeliceDrag>(),
                                 &drag_entry_of<GidaspowDrag>(), &drag_entry_of<RichardsonZakiDrag>(),
                                 &drag_entry_of<BeetstraDrag>()});
  return laws;
}

std::span<const DragLaw* const> drag_laws() { return drag_law_registry().look(); }

const DragLaw* no_drag() { return &none; }

}  // namespace sph

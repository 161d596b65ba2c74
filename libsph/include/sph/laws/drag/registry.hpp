// From a drag law's struct (laws/drag/law.hpp) to its entry in the list that drag.law is looked up in. A program adds
// laws of its own before it reads its first scene: sph::register_drag_law<MyDrag>().
#pragma once

#include "sph/laws/drag/law.hpp"

namespace sph {

template <class Law>
const DragLaw& drag_entry_of() {
  static constexpr DragLaw entry{Law::word, Law::resistance};
  return entry;
}

template <class Law>
void register_drag_law() {
  register_drag_law(drag_entry_of<Law>());
}

}  // namespace sph

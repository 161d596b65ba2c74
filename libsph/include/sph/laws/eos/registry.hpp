// From a law's struct (laws/eos/law.hpp) to its entry in the list that eos is looked up in. A program adds laws of
// its own before it reads its first scene: sph::register_equation_of_state<MyEos>().
#pragma once

#include "sph/laws/eos/law.hpp"

namespace sph {

template <class Law>
struct EosEntry {
  /// Of barotropic laws.
  static void derive(const Group& g, const EosRows& rows, std::size_t first, std::size_t last) {
    for (std::size_t i = first; i < last; ++i)
      rows.pressure[i] = Law::pressure(g, rows.density[i]) - rows.surface_pressure;
    if (rows.sound_speed != nullptr)
      for (std::size_t i = first; i < last; ++i) rows.sound_speed[i] = Law::sound_speed(g, rows.density[i]);
    if (rows.void_fraction != nullptr)
      for (std::size_t i = first; i < last; ++i) rows.void_fraction[i] = 0;
  }
  static EosStart start(const Group& g, double above_surface, double surface_pressure) {
    return {Law::density(g, above_surface + surface_pressure)};
  }
};

template <class Law>
const EquationOfState& eos_entry_of() {
  static_assert(Law::keys.size() <= most_law_keys);
  static const EquationOfState entry = [] {
    EquationOfState e{Law::word,  Law::keys, Law::kind, Law::constant_sound, Law::needs_pressure, Law::remedy,
                      Law::check, nullptr,   nullptr,   Law::density,        Law::energy,         nullptr};
    if constexpr (requires { &Law::derive; }) {
      e.derive = Law::derive;
      e.start = Law::start;
    } else {
      e.derive = EosEntry<Law>::derive;
      e.start = EosEntry<Law>::start;
    }
    if constexpr (requires { &Law::pressure_below; }) e.pressure_below = Law::pressure_below;
    return e;
  }();
  return entry;
}

template <class Law>
void register_equation_of_state() {
  register_equation_of_state(eos_entry_of<Law>());
}

}  // namespace sph

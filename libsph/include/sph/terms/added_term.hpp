// Pair terms that a scene of fluids and updated-Lagrangian solids switches on by a number of its own in
// [terms], each in a pass of its own. Such a term is a struct like any other (terms/), which writes
// Field::added, and says besides:
//
//   static constexpr std::string_view word = "my_term";   // of [terms]: its strength, 0 where it is not given
//   static constexpr std::string_view sentence = "What it does.";   // of the reference of keys
//   static constexpr double most = 1;                      // no strength is larger
//   static constexpr Effect effect = Effect::acceleration;
//
// Key, pass and what becomes of the sum follow. A program adds terms of its own before it reads its first
// scene: sph::register_term<MyTerm>(). Including this header compiles the passes of the terms named to it.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sph/pairs/fuse.hpp"

namespace sph {

/// A term as code knows it that is not compiled for it.
struct AddedTerm {
  std::string_view word, sentence;
  double most;
  Effect effect;
  Term term;
  std::vector<Fusion> fusions;
};

template <class T>
const AddedTerm& added_term() {
  static_assert(T::writes == Field::added);
  static const AddedTerm entry{T::word, T::sentence, T::most, T::effect, term<T>, fusions_of<T>()};
  return entry;
}

/// All of them; from the first look on none can be added.
[[nodiscard]] std::span<const AddedTerm* const> added_terms();
/// Throws std::logic_error where the word is taken, or terms have been looked at.
void register_term(const AddedTerm& term);
template <class T>
void register_term() {
  register_term(added_term<T>());
}

}  // namespace sph

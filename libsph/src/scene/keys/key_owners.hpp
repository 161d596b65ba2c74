// Who has which key of [[group]] and [terms] when a program adds a law or a term of its own: a name means one thing.
// Laws of one sort may share a key of the same unit, bounds and default, as the two laws of springs do; a key of
// [[group]] that its table leaves to those who read it (poisson_ratio) may be a law's too.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sph/law_key.hpp"

namespace sph::keys {

struct KeyOwner {
  std::string_view sort, word;  ///< "contact law" "hertz"
  std::span<const LawKey> keys;
};

/// All laws that have keys of [[group]], as far as they are registered.
[[nodiscard]] std::vector<KeyOwner> contact_law_keys();
[[nodiscard]] std::vector<KeyOwner> equation_of_state_keys();

/// Throws std::logic_error, naming the key and both owners, where a key of `law` has another meaning already.
void refuse_taken_keys(const KeyOwner& law);
/// The same for a term whose word is a key of [terms].
void refuse_taken_term(std::string_view word);

}  // namespace sph::keys

// What a program adds before it reads its first scene (register_contact_law() and the like) joins the table of keys. A
// name means one thing there: laws of one sort may share a key of the same unit, bounds and default, as the two laws of
// springs do; a key of [[group]] that its table leaves to those who read it (poisson_ratio) may be a law's too.
#pragma once

#include <span>
#include <string_view>
#include <vector>

#include "sph/scene/law_key.hpp"

namespace sph::keys {

struct KeyOwner {
  std::string_view sort, word;  ///< "contact law" "hertz"
  std::span<const LawKey> keys;
};

/// All laws that have keys of [[group]], as far as they are registered.
[[nodiscard]] std::vector<KeyOwner> key_owners();

/// Throws std::logic_error, naming the key and both owners, where a key of `law` has another meaning already.
void refuse_taken_keys(const KeyOwner& law);

}  // namespace sph::keys

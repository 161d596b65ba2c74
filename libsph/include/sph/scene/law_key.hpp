// A constant that a contact law or an equation of state takes of every group that it acts in: a key of
// [[group]], declared in the law's header. Reader, writer and messages follow from it.
#pragma once

#include <array>
#include <limits>
#include <string_view>

#include "sph/core/dimension.hpp"

namespace sph {

/// No law has more.
inline constexpr std::size_t most_law_keys = 6;
/// Values of a law's keys, in the order in which it lists them [SI].
using LawConstants = std::array<double, most_law_keys>;

struct LawKey {
  std::string_view name;
  Dimension dimension{};
  double above = 0;  ///< the value must be larger than that ...
  double most = std::numeric_limits<double>::infinity();
  /// The default, of the values of the keys before; without it the key is required.
  double (*otherwise)(const LawConstants& before) = nullptr;
  std::string_view sentence{}, default_text{};  ///< of the reference (peperite keys)
};

}  // namespace sph

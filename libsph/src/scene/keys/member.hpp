// Where the value of a key is kept: the path of members from a struct of the scene to it. Reader and writer see
// it as one of few types, so that neither has a line for each key.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>

#include "sph/scene.hpp"

namespace sph::keys {

/// An enumeration, as the number of its enumerator.
struct Enumerator {
  void* at;
  int (*get)(const void*);
  void (*set)(void*, int);
};

using Value = std::variant<double*, std::optional<double>*, Double3*, std::optional<Double3>*, bool*,
                           std::optional<bool>*, std::array<bool, 3>*, int*, std::int64_t*,
                           std::optional<std::int64_t>*, std::uint64_t*, std::optional<std::uint64_t>*,
                           std::string*, Enumerator>;

/// Its address stands for a type.
template <class T>
inline constexpr char type_mark = 0;

struct Member {
  Value (*in)(void* owner) = nullptr;  ///< nullptr: code of its own reads and writes the key
  Value (*standard)() = nullptr;       ///< what it is where no scene says anything
  const void* owner = nullptr;         ///< type_mark of the struct
};

template <class T>
Value value_of(T& at) {
  if constexpr (std::is_enum_v<T>)
    return Enumerator{&at, [](const void* p) { return static_cast<int>(*static_cast<const T*>(p)); },
                      [](void* p, int n) { *static_cast<T*>(p) = static_cast<T>(n); }};
  else
    return &at;
}

template <class Class, class T>
Class class_of(T Class::*);

template <auto first, auto... rest>
Value value_in(void* owner) {
  using Owner = decltype(class_of(first));
  return value_of(((static_cast<Owner*>(owner)->*first).*....*rest));
}

template <auto first, auto... rest>
Value standard_value() {
  static decltype(class_of(first)) owner;
  return value_in<first, rest...>(&owner);
}

/// The member `first` of a struct, or a member of that.
template <auto first, auto... rest>
inline constexpr Member at{value_in<first, rest...>, standard_value<first, rest...>,
                           &type_mark<decltype(class_of(first))>};

}  // namespace sph::keys

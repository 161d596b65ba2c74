// Where the value of a key is kept: the path of members from a struct of the scene to it. Reader and writer see
// it as one of few types, so that neither has a line for each key.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <type_traits>
#include <variant>

#include "sph/scene/scene.hpp"

namespace sph::keys {

/// Its address stands for a type.
template <class T>
inline constexpr char type_mark = 0;

/// An enumeration, as the number of its enumerator.
struct Enumerator {
  void* at;
  const void* of;  ///< type_mark of the enumeration
  int (*get)(const void*);
  void (*set)(void*, int);
};

/// The laws of one sort, as a scene names them (sph/core/registry.hpp).
template <class Law>
std::span<const Law* const> laws_of();

/// The index of a group or a wall that a scene names.
struct Named {
  int* index;
};

using Value = std::variant<double*, std::optional<double>*, Double3*, std::optional<Double3>*, bool*,
                           std::optional<bool>*, std::array<bool, 3>*, std::array<std::int64_t, 3>*,
                           std::array<int, 2>*, int*, std::int64_t*, std::optional<std::int64_t>*,
                           std::uint64_t*, std::optional<std::uint64_t>*, std::string*, Enumerator, Named>;

struct Member {
  Value (*in)(void* owner) = nullptr;  ///< nullptr: code of its own reads and writes the key
  Value (*standard)() = nullptr;       ///< what it is where no scene says anything
  const void* owner = nullptr;         ///< type_mark of the struct
};

/// A law as its place in the registry, -1 if there is none.
template <class Law>
Enumerator law_in(const Law*& law) {
  return {&law, &type_mark<Law>,
          [](const void* p) {
            const auto all = laws_of<Law>();
            const auto found = std::ranges::find(all, *static_cast<const Law* const*>(p));
            return found == all.end() ? -1 : static_cast<int>(found - all.begin());
          },
          [](void* p, int n) { *static_cast<const Law**>(p) = laws_of<Law>()[static_cast<std::size_t>(n)]; }};
}

template <class T>
Value value_of(T& at) {
  if constexpr (std::is_pointer_v<T>)
    return law_in(at);
  else if constexpr (std::is_enum_v<T>)
    return Enumerator{&at, &type_mark<T>,
                      [](const void* p) { return static_cast<int>(*static_cast<const T*>(p)); },
                      [](void* p, int n) { *static_cast<T*>(p) = static_cast<T>(n); }};
  else
    return &at;
}

template <class Class, class T>
Class class_of(T Class::*);
template <auto first>
using OwnerOf = decltype(class_of(first));

template <auto first, auto... rest>
auto& inside(auto& object) {
  if constexpr (sizeof...(rest) == 0)
    return object.*first;
  else
    return inside<rest...>(object.*first);
}

template <auto first, auto... rest>
Value value_in(void* owner) {
  return value_of(inside<first, rest...>(*static_cast<OwnerOf<first>*>(owner)));
}

template <auto first, auto... rest>
Value index_in(void* owner) {
  return Named{&inside<first, rest...>(*static_cast<OwnerOf<first>*>(owner))};
}

template <class Owner, Value (*in)(void*)>
Value standard_value() {
  static Owner owner;
  return in(&owner);
}

template <class Owner, Value (*in)(void*)>
inline constexpr Member member{in, standard_value<Owner, in>, &type_mark<Owner>};

/// A member of a struct, or a member of that.
template <auto first, auto... rest>
inline constexpr Member at = member<OwnerOf<first>, value_in<first, rest...>>;
/// The same where it is the index of what the key names.
template <auto first, auto... rest>
inline constexpr Member index_at = member<OwnerOf<first>, index_in<first, rest...>>;

}  // namespace sph::keys

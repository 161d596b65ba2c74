// What a term sees of as many pairs as there are lanes, and what it adds to.
#pragma once

#include <array>
#include <cstddef>

#include "sph/core/fields.hpp"
#include "sph/core/simd.hpp"
#include "sph/pairs/row_layout.hpp"

namespace sph {

/// Of a pair whose terms read Value::width: f as Pair has it, of the kernels of i, of j, and of i beside a
/// wall, which is then not less than h wide.
template <class V>
struct PairWidths {
  V inverse;  ///< of the width of i
  V inverse_at_wall;
  V f_i, f_j, f_at_wall;
};

/// Of a pair whose terms read Value::reference.
template <class V, int D>
struct PairBond {
  V reference[D];     ///< X = (X_j - X_i) / h, h that of the kernel of bonds
  V displacement[D];  ///< u = x_j - x_i over the same h, less X; exact before it is rounded once
  V near;             ///< 1 where X is known: of what was never too far apart for its bits, else 0
  V intact;  ///< 1 for two particles of one body within each other's support in the reference state, unless
             ///< lost
  V weight;  ///< -w'(|X|) / |X| of a bond, else 0; grad_i W = weight X
  V weight_of_any;  ///< the same of all that were so near, of whatever body
};

template <class T, int D, ValueSet S>
struct Pair {
  using Scalar = T;
  using V = Simd<T>;
  static constexpr int dim = D;
  using Layout = RowLayout<D, S>;
  const V* own;
  const V* other;
  V e[D];  ///< (x_j - x_i) / h
  V r2;    ///< |e|^2
  V r;     ///< |e|
  V f;     ///< w'(r) / r, unnormalised; grad_i W = -f e (times the pass's factor); where kernels are of
           ///< different widths the mean of both
  PairWidths<V> width;
  PairBond<V, D> bond;
  template <Value v>
  [[nodiscard]] V i(int k = 0) const {
    return value<v>(own, k);
  }
  template <Value v>
  [[nodiscard]] V j(int k = 0) const {
    return value<v>(other, k);
  }

 private:
  template <Value v>
  static V value(const V* row, int k) {
    static_assert(S.has(v), "the term did not declare this value in `reads`");
    constexpr bool in_sign = Layout::volume_tells_mover;
    if constexpr (in_sign && v == Value::mover)
      return where_less(V::zero(), row[Layout::offset(Value::volume)], V(1));
    else if constexpr (in_sign && v == Value::volume)
      return abs(row[Layout::offset(Value::volume)]);
    else
      return row[Layout::offset(v) + k];
  }
};

/// The sums of one block of particles: one vector per component of each written field.
template <class T, int D, FieldSet Writes>
struct Sums {
  /// A table, so that no offset is counted in the loop over pairs.
  static constexpr auto offsets = [] {
    std::array<int, field_count + 1> at{};
    for (std::size_t k = 0; k < field_count; ++k) {
      const auto field = static_cast<Field>(k);
      at[k + 1] = at[k] + (Writes.has(field) ? components(info(field).shape, D) : 0);
    }
    return at;
  }();
  [[nodiscard]] static constexpr int offset(Field field) { return offsets[static_cast<std::size_t>(field)]; }
  static constexpr int size = offset(Field::count_);
  Simd<T> v[size];
  template <Field F>
  void add(int k, Simd<T> x) {
    v[offset(F) + k] += x;
  }
};

}  // namespace sph

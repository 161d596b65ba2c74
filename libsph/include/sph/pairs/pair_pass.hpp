// The only loop over pairs of SPH particles. One SIMD lane per particle i; its partners j are visited in
// ascending global id with strictly sequential adds, so a sum depends on ids and on the current state only.
// Entries beyond the support, and the padding of a list (the particle itself), add exactly +-0 because the
// kernel's slope is clamped to 0 there. Terms are fused at compile time.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

#include "sph/core/fields.hpp"
#include "sph/core/simd_rows.hpp"
#include "sph/pairs/neighbour_lists.hpp"
#include "sph/pairs/pair.hpp"
#include "sph/pairs/pair_rows.hpp"
#include "sph/pairs/pass_context.hpp"

namespace sph {

template <class Term>
inline constexpr bool goes_half_a_step_back = requires {
  Term::half_step_back;
};

/// To its sums, of what moves, walls alone add other than 0.
template <class Term>
inline constexpr bool is_over_walls = requires {
  Term::over_walls;
};

/// Of a block of particles that all have 0 for that value the sums are not needed: they are 0.
template <class Term>
inline constexpr bool is_idle_without_a_value = requires {
  Term::nothing_without;
};

/// Sums of a pass of such terms are 0 in blocks without a fluid, as row or partner, and without cracks.
template <class Term>
inline constexpr bool looks_only_beside_fluid = requires {
  Term::only_beside_fluid;
};

/// A pass with such a term is of fluids alone: the sums of other rows are 0, whatever block they are in.
template <class Term>
inline constexpr bool is_of_fluids = requires {
  Term::of_fluids;
};

/// Sums of a pass of such terms are over bonds, or over what is of two bodies.
template <class Term>
inline constexpr bool is_of_bonds = requires {
  Term::of_bonds;
};

/// ... but beside cracks.
template <class Term>
inline constexpr bool looks_across_cracks = requires {
  Term::across_cracks;
};

/// To its sums walls add 0.
template <class Term>
inline constexpr bool is_over_movers = requires {
  Term::over_movers;
};

/// In double precision whatever that of the scene, whose lists may then have blocks of several of its own.
template <class Term>
inline constexpr bool is_always_double = requires {
  Term::always_double;
};

template <class T, int D, class Kernel, class... Terms>
struct PairPass {
  static constexpr ValueSet values = (Terms::reads | ...);
  static constexpr FieldSet writes = (FieldSet{Terms::writes} | ...);
  using Layout = RowLayout<D, values>;
  using V = Simd<T>;
  // Velocities are those of half a step ago. With them a density would grow thinner in every rotation, by
  // (omega dt)^2 a step, were the pairs not taken where they were then.
  static constexpr bool half_step_back = (goes_half_a_step_back<Terms> || ...);
  static constexpr bool over_walls = (is_over_walls<Terms> && ...);
  static constexpr bool can_be_idle = (is_idle_without_a_value<Terms> && ...);
  static constexpr bool only_beside_fluid = (looks_only_beside_fluid<Terms> && ...);
  static constexpr bool of_fluids = (is_of_fluids<Terms> || ...);
  static constexpr bool asks_for_fluid = only_beside_fluid || of_fluids;
  static constexpr bool of_bonds = (is_of_bonds<Terms> && ...);
  static constexpr bool across_cracks = (looks_across_cracks<Terms> || ...);
  static constexpr bool over_movers = (is_over_movers<Terms> && ...);
  static constexpr bool finer = (is_always_double<Terms> && ...);
  // Displacements of bonds are those of now, exact differences of the same positions.
  static constexpr bool rows_are_half_a_step_back = half_step_back && !values.has(Value::reference);
  static constexpr int velocity = half_step_back ? Layout::offset(Value::velocity) : 0;

  static void pack(const PassContext& c, std::size_t first, std::size_t last) {
    pack_rows<T, D, values, rows_are_half_a_step_back>(*c.particles, *c.groups, c.scale, first, last,
                                                       rows_of(c));
  }

  /// What a solver changes from one run of the pass to the next.
  static void repack(const PassContext& c, std::size_t first, std::size_t last) {
    if constexpr (values.has(Value::direction))
      repack<Value::direction>(c, c.particles->template data<Field::direction>(), first, last);
    if constexpr (values.has(Value::trial))
      repack<Value::trial>(c, c.particles->template data<Field::trial>(), first, last);
  }

  static void run(const PassContext& c, const RowRange& range) {
    const std::size_t lanes = finer ? static_cast<std::size_t>(c.lists->lanes()) : V::lanes;
    for (std::size_t part = 0; part < lanes; part += V::lanes) run(c, range, part, lanes);
  }

 private:
  template <Value v>
  static void repack(const PassContext& c, const double* numbers, std::size_t first, std::size_t last) {
    constexpr std::size_t n = components(v, D);
    T* const rows = rows_of(c);
    for (std::size_t i = first; i < last; ++i)
      for (std::size_t k = 0; k < n; ++k)
        rows[i * Layout::stride + Layout::offset(v) + k] = static_cast<T>(numbers[i * n + k]);
  }

  /// Of each block of `lanes` rows those from `part` on.
  [[gnu::always_inline]] static void run(const PassContext& c, const RowRange& range, std::size_t part,
                                         std::size_t lanes) {
    const T* const rows = rows_of(c);
    const TermConstants<T> constants = narrow(c.constants);
    const V unit(static_cast<T>(c.scale.position_unit));
    const V tiny(static_cast<T>(1e-30));
    for (std::size_t first = range.first + part, block = range.first_block; first < range.last;
         first += lanes, ++block) {
      Sums<T, D, writes> sums;
      for (V& s : sums.v) s = V::zero();
      std::uint32_t own_rows[V::lanes];
      for (std::size_t l = 0; l < V::lanes; ++l)
        own_rows[l] = static_cast<std::uint32_t>(std::min(first + l, range.last - 1));
      V own[Layout::stride], other[Layout::stride];
      load_rows<Layout::stride>(rows, own_rows, own);
      if (is_idle(c, block, own)) {
        store(c, first, std::min(range.last - first, static_cast<std::size_t>(V::lanes)), sums);
        continue;
      }
      const std::span<const std::uint32_t> entries = lists_of(c, own).block(block);
      for (std::size_t k = part; k < entries.size(); k += lanes) {
        load_rows<Layout::stride>(rows, entries.data() + k, other);
        Pair<T, D, values> pair;
        pair.own = own;
        pair.other = other;
        pair.r2 = V::zero();
        for (int a = 0; a < D; ++a) {
          pair.e[a] = coordinate_difference(own[a], other[a]) * unit;
          if constexpr (half_step_back && !rows_are_half_a_step_back)
            pair.e[a] -= (other[velocity + a] - own[velocity + a]) * V(constants.half_step);
          pair.r2 += pair.e[a] * pair.e[a];
        }
        pair.r = sqrt(pair.r2);
        pair.f = Kernel::template slope<D>(pair.r) / max(pair.r, tiny);
        if constexpr (values.has(Value::width)) look_at_widths(own, other, pair);
        if constexpr (values.has(Value::reference)) look_at_bond(own, other, constants.bonds, pair);
        (Terms::template add<Kernel>(pair, constants, sums), ...);
      }
      if constexpr (of_fluids) keep_those_of_fluids(c, own_rows, sums);
      store(c, first, std::min(range.last - first, static_cast<std::size_t>(V::lanes)), sums);
    }
  }

  /// No row of the block wants these sums, or they are 0.
  [[gnu::always_inline]] static bool is_idle(const PassContext& c, std::size_t block, const V* own) {
    if constexpr (can_be_idle)
      if ((all_zero(own[Layout::offset(Terms::nothing_without)]) && ...)) return true;
    if constexpr (of_fluids)
      if (c.fluid != nullptr && !c.fluid->is_in(block)) return true;
    if constexpr (only_beside_fluid)
      if (c.fluid != nullptr && !c.fluid->is_beside(block) && !is_cracked(own)) return true;
    return false;
  }

  static void keep_those_of_fluids(const PassContext& c, const std::uint32_t* rows,
                                   Sums<T, D, writes>& sums) {
    if (c.fluid == nullptr) return;
    for (int l = 0; l < static_cast<int>(V::lanes); ++l)
      if (!c.fluid->is_fluid(rows[l]))
        for (V& s : sums.v) s.set(l, 0);
  }

  static const NeighbourLists& lists_of(const PassContext& c, const V* own) {
    if constexpr (over_walls)
      if (c.walls != nullptr) return *c.walls;
    if constexpr (of_bonds)
      if (c.bonds != nullptr && !(across_cracks && is_cracked(own))) return *c.bonds;
    return *c.lists;
  }

  static bool is_cracked(const V* own) {
    if constexpr (values.has(Value::crack))
      for (int a = 0; a < D; ++a)
        if (!all_zero(own[Layout::offset(Value::crack) + a])) return true;
    return false;
  }

  static bool all_zero(const V& value) {
    for (int l = 0; l < static_cast<int>(V::lanes); ++l)
      if (value[l] != 0) return false;
    return true;
  }

  // W(r, h) = alpha / h^D w(r / h): f of a kernel that is s times as wide is w'(r / s) / (r s^(D+1)).
  static void look_at_widths(const V* own, const V* other, Pair<T, D, values>& pair) {
    constexpr int width = Layout::offset(Value::width);
    const V one(static_cast<T>(1)), inverse_r = one / max(pair.r, V(static_cast<T>(1e-30)));
    const auto slope = [&](V inverse_width) {
      const V square = inverse_width * inverse_width;
      const V factor = D == 2 ? square * inverse_width : square * square;
      return Kernel::template slope<D>(pair.r * inverse_width) * (factor * inverse_r);
    };
    pair.width.inverse = one / own[width];
    pair.width.inverse_at_wall = min(pair.width.inverse, one);
    pair.width.f_i = slope(pair.width.inverse);
    pair.width.f_j = slope(one / other[width]);
    pair.width.f_at_wall = slope(pair.width.inverse_at_wall);
    pair.f = V(static_cast<T>(0.5)) * (pair.width.f_i + pair.width.f_j);
  }

  static void look_at_bond(const V* own, const V* other, const BondConstants<T>& bonds,
                           Pair<T, D, values>& pair) {
    const V unit(bonds.position_unit);
    constexpr int reference = Layout::offset(Value::reference), body = Layout::offset(Value::body);
    V square = V::zero();
    for (int a = 0; a < D; ++a) {
      const V xi = own[reference + a], xj = other[reference + a];
      pair.bond.reference[a] = coordinate_difference(xi, xj) * unit;
      pair.bond.displacement[a] =
          coordinate_difference(stored_difference(xi, own[a]), stored_difference(xj, other[a])) * unit;
      if constexpr (values.has(Value::clamp_shift)) {
        constexpr int shift = Layout::offset(Value::clamp_shift);
        pair.bond.displacement[a] += (other[shift + a] - own[shift + a]) * V(bonds.ratio);
      }
      square += pair.bond.reference[a] * pair.bond.reference[a];
    }
    // Differences in rows of single precision are modulo 2^32 units, four to eight times 2^29: particles from
    // far apart that meet now must not pass for neighbours then.
    const V near = all_near(own, other);
    pair.bond.near = near;
    const V distance = sqrt(square), tiny(static_cast<T>(1e-30));
    // A bond longer than the range is lost even where a list, with its skin, still holds it: how wide lists
    // are must not decide when a run ends.
    const V found = where_less(pair.r, V(bonds.range), V(static_cast<T>(1)));
    const V inside = where_less(distance, V(static_cast<T>(Kernel::radius)), found * near);
    pair.bond.intact = where_equal(own[body], other[body], where_less(V::zero(), square, inside));
    pair.bond.weight_of_any = -(found * near * Kernel::template slope<D>(distance) / max(distance, tiny));
    pair.bond.weight = where_equal(own[body], other[body], pair.bond.weight_of_any);
  }

  /// 1 where the reference positions are less than three cells of 2^29 units apart along each axis, else 0.
  static V all_near(const V* own, const V* other) {
    constexpr int cell = Layout::offset(Value::reference_cell);
    V near(static_cast<T>(1));
    for (int a = 0; a < D; ++a) {
      const V apart = other[cell + a] - own[cell + a];
      near = where_less(apart * apart, V(static_cast<T>(9)), near);
    }
    return near;
  }

  static T* rows_of(const PassContext& c) {
    return reinterpret_cast<T*>(
        aligned_scratch(*c.rows, (c.particles->rows() + V::lanes) * Layout::stride * sizeof(T)));
  }

  static TermConstants<T> narrow(const TermConstants<double>& d) {
    TermConstants<T> c;
    for (int a = 0; a < 3; ++a) c.gravity[a] = static_cast<T>(d.gravity[a]);
    c.density = static_cast<T>(d.density);
    c.inverse_sound_speed = static_cast<T>(d.inverse_sound_speed);
    c.artificial_viscosity = static_cast<T>(d.artificial_viscosity);
    c.inverse_w_spacing = static_cast<T>(d.inverse_w_spacing);
    c.half_step = static_cast<T>(d.half_step);
    c.viscous = {static_cast<T>(d.viscous.uniform), static_cast<T>(d.viscous.laplacian),
                 static_cast<T>(d.viscous.symmetric)};
    c.shock = {static_cast<T>(d.shock.quadratic_viscosity), static_cast<T>(d.shock.conduction)};
    c.jump = {static_cast<T>(d.jump.damping), static_cast<T>(d.jump.background_pressure)};
    c.bonds = {static_cast<T>(d.bonds.range), static_cast<T>(d.bonds.position_unit),
               static_cast<T>(d.bonds.ratio), static_cast<T>(d.bonds.force),
               static_cast<T>(d.bonds.viscosity)};
    c.contact = {static_cast<T>(d.contact.range), static_cast<T>(d.contact.force),
                 static_cast<T>(d.contact.energy)};
    return c;
  }

  template <SumScale S>
  static double factor(const PassContext& c) {
    static_assert(S != SumScale::none, "a term writes a field whose sum has no scale in the table of fields");
    if constexpr (S == SumScale::force) return c.force_factor;
    if constexpr (S == SumScale::gradient) return c.gradient_factor;
    if constexpr (S == SumScale::diffusion) return c.diffusion_factor;
    return 1.0;
  }

  template <Field F>
  static void store_field(const PassContext& c, std::size_t first, std::size_t count,
                          const Sums<T, D, writes>& sums) {
    if constexpr (writes.has(F)) {
      constexpr int n = components(info(F).shape, D);
      const double scale = factor<info(F).sum>(c);
      double* out = c.particles->template data<F>() + first * n;
      for (std::size_t l = 0; l < count; ++l)
        for (int k = 0; k < n; ++k)
          out[l * n + k] = static_cast<double>(sums.v[sums.offset(F) + k][static_cast<int>(l)]) * scale;
    }
  }

  static void store(const PassContext& c, std::size_t first, std::size_t count,
                    const Sums<T, D, writes>& sums) {
    [&]<std::size_t... F>(std::index_sequence<F...>) {
      (store_field<static_cast<Field>(F)>(c, first, count, sums), ...);
    }
    (std::make_index_sequence<field_count>());
  }
};

}  // namespace sph

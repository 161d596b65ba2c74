// The only loop over contacts, one SIMD lane each, eight at a time: where a register has four of them their two chains of
// square roots and divisions overlap, which is worth more than what is spilled. Forces and torques are rounded to quanta and
// added as integers, so their sums depend on no order; the pair's two sides get exact opposites.
// Once the pairs and walls of a block of rows are summed its grains are kicked and drift at once, while they
// are still in the cache: nothing that comes later in the sweep reads them.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <limits>
#include <span>

#include "sph/core/fixed_point.hpp"
#include "sph/core/particles.hpp"
#include "sph/core/simd_rows.hpp"
#include "sph/pairs/contact.hpp"
#include "sph/pairs/contact_context.hpp"
#include "sph/pairs/contact_prefetch.hpp"
#include "sph/pairs/friction.hpp"
#include "sph/pairs/grain_motion.hpp"
#include "sph/pairs/rolling.hpp"
#include "sph/pairs/wall_side.hpp"

namespace sph {

template <class NormalLaw, class FrictionLaw, class RollingLaw, bool one_material, class Sums = QuantumSums>
struct ContactPass {
  static constexpr int springs = FrictionLaw::history + RollingLaw::history;  // components of history
  static constexpr bool spins = springs > 0;
  static constexpr int memories = static_cast<int>(NormalLaw::history.size());
  static constexpr int history = springs + memories;
  static constexpr std::array<Parity, static_cast<std::size_t>(history)> parities = [] {
    std::array<Parity, static_cast<std::size_t>(history)> all{};
    std::fill_n(all.begin(), springs, Parity::odd);
    std::copy(NormalLaw::history.begin(), NormalLaw::history.end(), all.begin() + springs);
    return all;
  }();
  static constexpr int stride = spins ? 8 : 4;
  using V = Simd<double>;
  static constexpr std::size_t lanes = ContactGroups::lanes;
  static_assert(V::lanes == lanes);
  using Sum = typename Sums::Sum;

  static void run(const ContactContext& c, std::span<const ContactBlock> blocks, const RowRanges& ranges,
                  ContactSweep& sweep) {
    const Rows rows(c);
    const Prefetch<Rows> prefetch(c, rows);
    for (const ContactBlock& block : blocks) {
      if (&block != &blocks.back()) prefetch.block(*(&block + 1));
      for (std::size_t g = block.candidates.first; g < block.candidates.last; ++g)
        if (!sleeps(c, g)) prefetch.partners(g);
      for (std::size_t g = block.pairs.first; g < block.pairs.last; ++g) {
        prefetch.coming(g);
        add_pairs(c, rows, g, sweep);
      }
      add_candidates(c, rows, block.candidates, sweep);
      if (c.walls.facets->any()) {
        c.walls.facets->look(c.lists->walls(), c.lists->walls().facets, block, GrainPlaces(rows.motion));
        c.walls.facets->hand_over(c.lists->walls(), history);
      }
      for (std::size_t g = block.walls.first; g < block.walls.last; ++g) add_walls(c, rows, g, sweep);
      const auto moves = [&](RowClass k) {
        const RowRange& r = ranges[static_cast<std::size_t>(k)];
        return block.first >= r.first && block.last <= r.last;
      };
      if (moves(RowClass::interior_movers) || moves(RowClass::boundary_movers))
        c.gliding.mobility != nullptr ? Motion::glide(c, rows, block.first, block.last, sweep)
        : c.drifts                    ? Motion::template move<true>(c, rows, block.first, block.last, sweep)
                                      : Motion::template move<false>(c, rows, block.first, block.last, sweep);
      else
        std::fill(rows.sums + std::size_t{block.first} * stride, rows.sums + std::size_t{block.last} * stride,
                  Sum{});
    }
  }

 private:
  using Rows = ContactRows<Sum>;
  using Motion = GrainMotion<spins, stride, Sums>;
  template <class Of>
  using Prefetch = ContactPrefetch<Of, stride, history, spins || !one_material>;

  /// Forces and torques of eight contacts. Torque on j: roll - r_j couple, on i: -roll - r_i couple.
  struct Answer {
    V force[3], couple[3], roll[3];
  };

  [[gnu::always_inline]] static ContactConstants<V> constants_of(const ContactContext& c,
                                                                 const std::uint32_t* pair) {
    V k[8];
    if constexpr (one_material)
      for (int n = 0; n < 8; ++n) k[n] = V(c.materials.constants[n]);
    else
      load_rows<8>(c.materials.constants, pair, k);
    return ContactConstants<V>::of_row(k, V(c.materials.least_force));
  }

  /// The laws, with the histories before and after. Lanes that do not touch answer zero and lose theirs.
  [[gnu::always_inline]] static Answer respond(Contact<V>& contact, const ContactConstants<V>& k,
                                               ContactGroups& list, std::size_t g, ContactSweep& sweep) {
    const V gone = V::zero();
    const auto touching = [&](V x) { return where_less(gone, contact.overlap, x); };
    Answer out;
    double* stored = list.remember(g, history);
    V memory[memories > 0 ? memories : 1];
    for (int m = 0; m < memories; ++m) memory[m] = V::load(stored + (springs + m) * lanes);
    const NormalForce<V> normal = normal_force<NormalLaw>(contact, k, memory);
    for (int m = 0; m < memories; ++m) {
      touching(memory[m]).store(stored + (springs + m) * lanes);
    }
    const V push = touching(normal.force);
    V t[3] = {gone, gone, gone};
    if constexpr (FrictionLaw::history > 0) {
      V spring[3];
      for (int a = 0; a < 3; ++a) spring[a] = V::load(stored + a * lanes);
      FrictionLaw::force(contact, k, normal, spring, t);
      for (int a = 0; a < 3; ++a) {
        touching(spring[a]).store(stored + a * lanes);
        t[a] = touching(t[a]);
      }
    }
    for (int a = 0; a < 3; ++a) out.force[a] = touching(push * contact.normal[a]) + t[a];
    if constexpr (spins) {
      cross(contact.normal, t, out.couple);
      for (int a = 0; a < 3; ++a) {
        out.couple[a] = touching(out.couple[a]);
        out.roll[a] = gone;
      }
    }
    if constexpr (RollingLaw::history > 0) {
      double* rolled = stored + FrictionLaw::history * lanes;
      V spring[3];
      for (int a = 0; a < 3; ++a) spring[a] = V::load(rolled + a * lanes);
      const V change = NormalLaw::rolling_change(contact, k, normal, memory);
      RollingLaw::torque(contact, k, normal, change, spring, out.roll);
      for (int a = 0; a < 3; ++a) {
        touching(spring[a]).store(rolled + a * lanes);
        out.roll[a] = touching(out.roll[a]);
      }
    }
    std::uint8_t& touched = list.touching[g];
    const unsigned now = positive_lanes(contact.overlap), before = touched;
    if (now != before) {
      if constexpr (history > 0) {  // without history nobody remembers at a rebuild who touched
        sweep.created += std::popcount(now & ~before);
        sweep.ended += std::popcount(before & ~now);
      }
      touched = static_cast<std::uint8_t>(now);
    }
    return out;
  }

  /// A force term must stay below it: 4096 of them then fit a sum.
  static constexpr double largest_force = 0x1p50;

  [[gnu::cold, gnu::noinline]] static void note(const ContactContext& c, std::uint32_t i,
                                                std::uint64_t partner, double value, double limit,
                                                ContactFault& fault) {
    fault.add({c.particles->data<Field::id>()[i], partner, value, limit, position_in(Rows(c).x(i))});
  }
  /// Of pairs, those lanes where `excess` is above 0.
  [[gnu::cold, gnu::noinline]] static void note_pairs(const ContactContext& c, const std::uint32_t* i,
                                                      const std::uint32_t* j, V excess, V value,
                                                      ContactFault& fault) {
    const std::uint64_t* id = c.particles->data<Field::id>();
    for (int l = 0; l < V::lanes; ++l) {
      if (!(excess[l] > 0)) continue;
      const bool ordered = id[i[l]] < id[j[l]];
      note(c, ordered ? i[l] : j[l], id[ordered ? j[l] : i[l]], value[l], value[l] - excess[l], fault);
    }
  }

  /// Two rows in each lane, their radii and groups.
  struct Partners {
    const std::uint32_t *i, *j;
    V ri, rj, group_i, group_j;
    Partners(const ContactGroups& list, std::size_t first)
        : i(list.i.data() + first), j(list.j.data() + first) {}
  };

  [[gnu::flatten]] static void add_pairs(const ContactContext& c, const Rows& rows, std::size_t g,
                                         ContactSweep& sweep) {
    ContactGroups& list = c.lists->pairs();
    const bool may_sleep = list.touching[g] == 0 && c.path < std::numeric_limits<double>::infinity();
    double gap = std::numeric_limits<double>::infinity();
    // One turn: g++ 12 keeps more in registers with it.
    for (std::size_t at = 0; at < lanes; at += lanes) {
      Partners two(list, g * lanes + at);
      Contact<V> contact;
      V d[3];
      const V distance2 = look_at_places(c, rows, two, d), distance = sqrt(distance2);
      // Unused lanes hold a row twice: distance 0 does not touch.
      contact.overlap = where_less(V::zero(), distance2, two.ri + two.rj - distance);
      if (positive_lanes(contact.overlap) == 0 && list.touching[g] == 0) {
        if (may_sleep) gap = std::min(gap, gap_of(contact.overlap, distance2, two));
        continue;
      }
      const V inverse = V(1.0) / distance;
      for (int a = 0; a < 3; ++a) contact.normal[a] = d[a] * inverse;
      look_at_motion(rows, two, contact);
      contact.radius = two.ri * two.rj / (two.ri + two.rj);
      contact.dt = V(c.dt);
      std::uint32_t pair[lanes];
      if constexpr (!one_material)
        for (std::size_t l = 0; l < lanes; ++l)
          pair[l] = static_cast<std::uint32_t>(two.group_i[static_cast<int>(l)]) * c.materials.groups +
                    static_cast<std::uint32_t>(two.group_j[static_cast<int>(l)]);
      const Answer answer = respond(contact, constants_of(c, pair), list, g, sweep);
      const V excess = contact.overlap - V(c.largest_overlap) * min(two.ri, two.rj);
      if (positive_lanes(excess) != 0) note_pairs(c, two.i, two.j, excess, contact.overlap, sweep.deep);
      add_answer(c, rows, two, answer, sweep);
    }
    // Of its two grains neither has to go further than half of it before they touch.
    if (may_sleep && list.touching[g] == 0) list.asleep[g] = c.path + 0.499 * gap;
  }

  /// Difference x_j - x_i [m] and its square.
  [[gnu::always_inline]] static V look_at_places(const ContactContext& c, const Rows& rows, Partners& two,
                                                 V (&d)[3]) {
    const V unit(c.quantum.length);
    V xi[4], xj[4], distance2 = V::zero();
    load_vectors<Rows::motion_width>(rows.motion, two.i, xi);
    load_vectors<Rows::motion_width>(rows.motion, two.j, xj);
    for (int a = 0; a < 3; ++a) {
      d[a] = coordinate_difference(xi[a], xj[a]) * unit;
      distance2 += d[a] * d[a];
    }
    two.ri = xi[3];
    two.rj = xj[3];
    return distance2;
  }

  /// The least of pairs that do not touch.
  [[gnu::noinline]] static double gap_of(V overlap, V distance2, const Partners& two) {
    double gap = std::numeric_limits<double>::infinity();
    for (int l = 0; l < V::lanes; ++l)
      if (distance2[l] > 0)
        gap = std::min(gap, -overlap[l] - 1e-9 * (two.ri[l] + two.rj[l]));  // for rounding
    return gap;
  }

  [[gnu::always_inline]] static bool sleeps(const ContactContext& c, std::size_t g) {
    return c.path < c.lists->pairs().asleep[g];
  }
  /// Those that are not asleep. Sums are in whole quanta: whoever has nothing to add need not be asked.
  [[gnu::always_inline]] static void add_candidates(const ContactContext& c, const Rows& rows,
                                                    ContactBlock::Groups groups, ContactSweep& sweep) {
    for (std::size_t g = groups.first; g < groups.last; ++g)
      if (!sleeps(c, g)) add_pairs(c, rows, g, sweep);
  }

  /// Velocities of two grains, as their contact sees them, and what stands beside them in their lines.
  [[gnu::always_inline]] static void look_at_motion(const Rows& rows, Partners& two, Contact<V>& contact) {
    V vi[4], vj[4], rel[3], surface[3] = {V::zero(), V::zero(), V::zero()};
    load_vectors<Rows::motion_width>(rows.motion + 4, two.i, vi);
    load_vectors<Rows::motion_width>(rows.motion + 4, two.j, vj);
    if constexpr (spins || !one_material) {
      V wi[4], wj[4];
      load_vectors<Rows::spin_width>(rows.spin, two.i, wi);
      load_vectors<Rows::spin_width>(rows.spin, two.j, wj);
      two.group_i = wi[3];
      two.group_j = wj[3];
      if constexpr (spins)
        for (int a = 0; a < 3; ++a) {
          surface[a] = two.ri * wi[a] + two.rj * wj[a];
          contact.roll[a] = wj[a] - wi[a];
        }
    }
    contact.mass = vi[3] * vj[3] / (vi[3] + vj[3]);
    for (int a = 0; a < 3; ++a) rel[a] = vj[a] - vi[a];
    set_motion<spins>(contact, rel, surface);
  }

  /// Whole quanta of force and torque to the sums of both grains.
  [[gnu::always_inline]] static void add_answer(const ContactContext& c, const Rows& rows,
                                                const Partners& two, const Answer& answer,
                                                ContactSweep& sweep) {
    const V force_scale(c.quantum.per_force);
    decltype(Sums::lanes(V())) on_i[stride] = {}, on_j[stride] = {};
    V worst = V::zero();
    for (int a = 0; a < 3; ++a) {
      const V f = answer.force[a] * force_scale;
      worst = max(worst, max(f, -f));
      on_j[a] = Sums::lanes(f);
      on_i[a] = -on_j[a];
    }
    if constexpr (spins) {
      const V torque_scale(c.quantum.per_torque);
      for (int a = 0; a < 3; ++a) {
        on_i[4 + a] = Sums::lanes((-answer.roll[a] - two.ri * answer.couple[a]) * torque_scale);
        on_j[4 + a] = Sums::lanes((answer.roll[a] - two.rj * answer.couple[a]) * torque_scale);
      }
    }
    const V beyond = worst - V(largest_force);
    if (positive_lanes(beyond) != 0) note_pairs(c, two.i, two.j, beyond, worst, sweep.strong);
    add_to_rows<stride>(rows.sums, two.i, on_i);
    add_to_rows<stride>(rows.sums, two.j, on_j);
  }

  [[gnu::flatten]] static void add_walls(const ContactContext& c, const Rows& rows, std::size_t g,
                                         ContactSweep& sweep) {
    ContactGroups& list = c.lists->walls();
    const std::uint32_t* walls = list.j.data() + g * lanes;
    // Of fine meshes most facets that are listed touch nothing.
    if (list.touching[g] == 0 && c.walls.facets->any() && !c.walls.facets->any_in(g) &&
        *std::min_element(walls, walls + lanes) >= c.walls.planes.size())
      return;
    Contact<V> contact;
    V rel[3], surface[3], lightness;
    std::uint32_t pair[lanes];
    std::size_t number[lanes];
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::size_t entry = g * lanes + l, r = list.i[entry];
      const int k = static_cast<int>(l);
      const WallSide side = wall_side(c, list.j[entry], entry, rows.x(r));
      for (std::size_t a = 0; a < 3; ++a) {
        contact.normal[a].set(k, -side.away[a]);
        rel[a].set(k, side.velocity[a] - rows.v(r)[a]);
        if constexpr (spins) {
          surface[a].set(k, rows.radius(r) * rows.w(r)[a]);
          contact.roll[a].set(k, -rows.w(r)[a]);
        }
      }
      contact.overlap.set(k, side.touchable ? rows.radius(r) - side.distance : 0.0);
      contact.radius.set(k, rows.radius(r));
      contact.mass.set(k, rows.mass(r));
      lightness.set(k, side.lightness);
      pair[l] = rows.group(r) * c.materials.groups + side.group;
      number[l] = side.number;
    }
    if (positive_lanes(contact.overlap) == 0 && list.touching[g] == 0) return;
    contact.mass = contact.mass / (V(1.0) + contact.mass * lightness);
    set_motion<spins>(contact, rel, surface);
    contact.dt = V(c.dt);
    const Answer answer = respond(contact, constants_of(c, pair), list, g, sweep);
    for (std::size_t l = 0; l < lanes; ++l)
      if (contact.overlap[static_cast<int>(l)] > 0)
        add_wall_answer(c, rows, g * lanes + l, number[l], contact, answer, static_cast<int>(l), sweep);
  }

  /// That of lane k.
  static void add_wall_answer(const ContactContext& c, const Rows& rows, std::size_t entry,
                              std::size_t number, const Contact<V>& contact, const Answer& answer, int k,
                              ContactSweep& sweep) {
    const ContactGroups& list = c.lists->walls();
    const std::size_t i = list.i[entry];
    const auto of_wall = [&] { return c.lists->numbers().key(list.j[entry]); };
    const double deepest = c.largest_overlap * rows.radius(i);
    if (contact.overlap[k] > deepest)
      note(c, list.i[entry], of_wall(), contact.overlap[k], deepest, sweep.deep);
    for (int a = 0; a < 3; ++a) {
      const double f = answer.force[a][k] * c.quantum.per_force;
      if (std::fabs(f) > largest_force)
        note(c, list.i[entry], of_wall(), std::fabs(f), largest_force, sweep.strong);
      const Sum sum = Sums::scalar(f);
      rows.sums[i * stride + static_cast<std::size_t>(a)] -= sum;
      // A wall has any number of contacts: two halves have room for 2^31 of them.
      const std::size_t at = number * 3 + static_cast<std::size_t>(a);
      const auto on_wall = static_cast<std::int64_t>(sum);
      c.walls.force[at] += on_wall & 0xffffffff;
      c.walls.force[3 * c.walls.count + at] += on_wall >> 32;
      if constexpr (spins) {
        const double torque = -answer.roll[a][k] - contact.radius[k] * answer.couple[a][k];
        rows.sums[i * stride + 4 + static_cast<std::size_t>(a)] +=
            Sums::scalar(torque * c.quantum.per_torque);
      }
    }
  }
};

}  // namespace sph

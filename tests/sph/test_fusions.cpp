// Every compiled sum over pairs against brute force, and what all of them promise: forces that are opposite
// to the last bit, no look at what is not declared, nothing from beyond the support.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "pair_oracle.hpp"

namespace sph {
namespace {

using test::isolated_pairs;
using test::jittered_lattice;
using test::PairCase;
using test::PairOptions;
using test::PairOracle;
using test::title_of;

void sum(PairCase& c) {
  c.pack();
  c.run();
}

double component(const PairCase& c, Field f, std::size_t row, int k) {
  const auto n = static_cast<std::size_t>(components(info(f).shape, c.fusion().dim));
  return c.particles().table().as<double>(c.particles().column(f))[row * n + static_cast<std::size_t>(k)];
}

/// Particles for which all the fusion's terms mean something.
std::vector<bool> where_defined(const PairCase& c, std::size_t count) {
  const PairOracle oracle(c);
  std::vector<bool> out(count);
  for (std::size_t number = 0; number < count; ++number)
    out[number] =
        std::ranges::all_of(c.fusion().terms, [&](Term t) { return oracle.defined(t, c.row_of(number)); });
  return out;
}

/// Of a part of a sum: a hundred operations and additions, each rounded by 2^-53 or 2^-24, and before them
/// differences of numbers ten times as large (powers in the quintic near its centre, pressures of
/// neighbours).
double rounding(Precision precision) { return 1000 * (precision == Precision::mixed ? 0x1p-24 : 0x1p-53); }

struct Difference {
  double largest = 0;  ///< over the size of the parts
  std::size_t compared = 0;
  std::string where;
};

Difference compare(const PairCase& c) {
  const Fusion& fusion = c.fusion();
  const PairOracle oracle(c);
  Difference found;
  for (std::size_t row = 0; row < c.particles().owned(); ++row) {
    const auto wanted = oracle.sums(row);
    if (!std::ranges::all_of(fusion.terms, [&](Term t) { return oracle.defined(t, row); })) continue;
    for (const Field f : fusion.writes.list()) {
      const auto n = static_cast<std::size_t>(components(info(f).shape, fusion.dim));
      for (std::size_t k = 0; k < n; ++k) {
        const auto& [value, size] = wanted.of[static_cast<std::size_t>(f)][k];
        const double value_there = component(c, f, row, static_cast<int>(k));
        const double off = size > 0 ? std::abs(value_there - value) / size : std::abs(value_there);
        ++found.compared;
        if (off <= found.largest) continue;
        found.largest = off;
        found.where = std::string(info(f).name) + "[" + std::to_string(k) + "] of row " +
                      std::to_string(row) + ": " + std::to_string(value_there) + ", not " +
                      std::to_string(value);
        if (std::isnan(off)) return found;
      }
    }
  }
  return found;
}

TEST(Fusions, are_what_brute_force_finds) {
  for (const Fusion& fusion : all_fusions())
    for (const bool local_sound : {true, false}) {
      if (!local_sound && !fusion.values.has(Value::sound_speed)) continue;
      PairCase c(fusion, jittered_lattice(fusion.dim), {.local_sound = local_sound});
      sum(c);
      const Difference d = compare(c);
      EXPECT_LT(d.largest, rounding(fusion.precision)) << title_of(fusion) << '\n' << d.where;
      EXPECT_GT(d.compared, 10u) << title_of(fusion);
    }
}

/// Does i feel the opposite of what j feels? Not where a wall takes the place of what is beside it: its
/// density and pressure, the width of its kernel or the profile of the velocity are then those that i sees.
/// Nor across an interface whose tension is a jump of the pressure, which pushes both the same way. Ida's
/// literal sum has the stress of j alone.
bool is_opposite(Term term, std::uint32_t i, std::uint32_t j) {
  const bool wall = i >= test::wall || j >= test::wall;
  const bool across = i <= test::heavy && j <= test::heavy && i != j;
  switch (test::key(term.name)) {
    case test::key("WeightedPressure"):
    case test::key("GasPressure"):
    case test::key("ViscousOperator"):
    case test::key("SymmetricViscousOperator"):
      return !wall;
    case test::key("TensionJump"):
    case test::key("WeightedTensionJump"):
      return !across;
    case test::key("IdaStress"):
      return false;
    default:
      return true;
  }
}

struct Opposites {
  Field field;
  int first;  ///< of the components of a force
  int even;   ///< component that both have alike, -1: none
};
std::vector<Opposites> opposites_of(const Fusion& fusion) {
  std::vector<Opposites> all;
  if (fusion.writes.has(Field::force)) all.push_back({Field::force, 0, -1});
  if (fusion.writes.has(Field::heating)) all.push_back({Field::heating, 1, -1});
  if (fusion.writes.has(Field::viscous_sums)) all.push_back({Field::viscous_sums, 0, fusion.dim});
  if (fusion.writes.has(Field::heat_gain)) all.push_back({Field::heat_gain, 0, -1});
  if (fusion.writes.has(Field::gas_gain)) all.push_back({Field::gas_gain, 0, 1});
  if (fusion.writes.has(Field::exchange_sums)) all.push_back({Field::exchange_sums, 0, 1});
  if (fusion.writes.has(Field::contact_energy)) all.push_back({Field::contact_energy, fusion.dim, 0});
  return all;
}

// Momentum, heat and gas are then conserved to the last bit of every pair.
TEST(Fusions, have_forces_that_are_exactly_opposite) {
  std::set<Term> exempt, unlike;
  for (const Fusion& fusion : all_fusions()) {
    const auto fields = opposites_of(fusion);
    if (fields.empty()) continue;
    const auto placed = isolated_pairs(fusion.dim);
    PairCase c(fusion, placed, {.halo = false});
    sum(c);
    std::size_t forces = 0;
    for (std::size_t k = 0; k < placed.size(); k += 2) {
      const std::size_t i = c.row_of(k), j = c.row_of(k + 1);
      bool opposite = true;
      for (const auto& [field, first, even] : fields) {
        const bool exchange =
            field == Field::heat_gain || field == Field::gas_gain || field == Field::exchange_sums;
        const int last = field == Field::contact_energy ? first : first + (exchange ? 1 : fusion.dim);
        for (int a = first; a < last; ++a) {
          opposite = opposite && component(c, field, i, a) == -component(c, field, j, a);
          forces += component(c, field, i, a) != 0 ? 1 : 0;
        }
        if (even < 0) continue;
        opposite = opposite && component(c, field, i, even) == component(c, field, j, even);
        forces += component(c, field, i, even) != 0 ? 1 : 0;
      }
      bool promised = true;
      for (const Term t : fusion.terms)
        if (!is_opposite(t, placed[k].group, placed[k + 1].group)) {
          promised = false;
          exempt.insert(t);
          if (!opposite) unlike.insert(t);
        }
      EXPECT_TRUE(opposite || !promised)
          << title_of(fusion) << ", groups " << placed[k].group << " and " << placed[k + 1].group;
    }
    EXPECT_GT(forces, 20u) << title_of(fusion);
  }
  EXPECT_EQ(exempt, unlike);  // no exemption without need
}

TEST(Fusions, look_at_nothing_that_they_do_not_declare) {
  for (const Fusion& fusion : all_fusions()) {
    const auto placed = jittered_lattice(fusion.dim);
    PairCase plain(fusion, placed, {}), poisoned(fusion, placed, {.poisoned = true});
    const std::vector<bool> wanted = where_defined(plain, placed.size());
    sum(plain);
    sum(poisoned);
    EXPECT_EQ(plain.bits(wanted), poisoned.bits(wanted)) << title_of(fusion);
  }
}

// Wider lists hold more that adds exactly nothing, and other padding.
TEST(Fusions, add_nothing_from_beyond_the_support) {
  for (const Fusion& fusion : all_fusions()) {
    const auto placed = jittered_lattice(fusion.dim);
    PairCase c(fusion, placed, {});
    const std::vector<bool> wanted = where_defined(c, placed.size());
    sum(c);
    const auto bits = c.bits(wanted);
    const std::size_t pairs = c.pairs();
    for (const double widened : {1.07, 1.6}) {
      c.build_lists(widened);
      sum(c);
      EXPECT_GT(c.pairs(), pairs) << title_of(fusion);
      EXPECT_EQ(c.bits(wanted), bits) << title_of(fusion) << ", lists " << widened << " times as wide";
    }
  }
}

/// As jittered_lattice, and far from it a solid without fluid, of which a half is without cracks.
std::vector<test::Placed> with_dry_solid(int dim, std::size_t& dry) {
  std::vector<test::Placed> all = jittered_lattice(dim);
  dry = all.size();
  for (std::size_t k = 0; k < dry; ++k) {
    test::Placed p = all[k];
    p.x[1] += 40;
    if (p.group == test::light || p.group == test::heavy) p.group = test::solid;
    all.push_back(p);
  }
  return all;
}

/// Sums that are not 0 of rows that a pass of fluids is not for: others must not see which blocks they are in.
int sums_of_others(const PairCase& c) {
  int found = 0;
  const bool of_fluids = std::ranges::count(c.fusion().terms, Term{"FlowFromSolids"}) > 0;
  for (std::size_t row = 0; of_fluids && row < c.particles().owned(); ++row) {
    if (c.particles().data<Field::group>()[row] <= test::heavy) continue;
    for (const Field f : c.fusion().writes.list())
      for (int k = 0; k < components(info(f).shape, c.fusion().dim); ++k)
        found += component(c, f, row, k) != 0 ? 1 : 0;
  }
  return found;
}

// Scenes have shorter lists for bonds and for walls, and no sums where no fluid is near.
TEST(Fusions, add_nothing_but_from_bonds_and_walls_and_beside_fluids) {
  int shorter = 0, idle = 0;
  for (const Fusion& fusion : all_fusions()) {
    if (!fusion.asks_for_fluid && !fusion.over_walls && !fusion.values.has(Value::reference)) continue;
    std::size_t dry = 0;
    const auto placed = with_dry_solid(fusion.dim, dry);
    PairCase c(fusion, placed, {});
    if (double* crack = c.particles().data<Field::crack>())
      for (std::size_t number = dry; number < dry + dry / 2; ++number)
        std::fill_n(crack + c.row_of(number) * static_cast<std::size_t>(fusion.dim), fusion.dim, 0.0);
    const std::vector<bool> wanted = where_defined(c, placed.size());
    for (const double widened : {1.0, 1.6}) {
      c.build_lists(widened);
      sum(c);
      const auto bits = c.bits(wanted);
      c.leave_out();
      sum(c);
      EXPECT_EQ(c.bits(wanted), bits) << title_of(fusion);
      EXPECT_EQ(sums_of_others(c), 0) << title_of(fusion);
    }
    const PassContext context = c.context();
    if (context.bonds != nullptr && context.bonds->pairs() < context.lists->pairs()) ++shorter;
    EXPECT_LT(context.walls->pairs(), context.lists->pairs()) << title_of(fusion);
    for (std::size_t block = 0; block < context.lists->blocks(); ++block)
      if (!context.fluid->is_beside(block)) ++idle;
  }
  EXPECT_GT(shorter, 0);
  EXPECT_GT(idle, 0);
}

// Rows of walls then need not list walls.
TEST(Fusions, over_movers_add_nothing_from_walls) {
  int shorter = 0;
  for (const Fusion& fusion : all_fusions()) {
    if (!fusion.over_movers) continue;
    const auto placed = jittered_lattice(fusion.dim);
    PairCase c(fusion, placed, {});
    const std::vector<bool> wanted = where_defined(c, placed.size());
    sum(c);
    const auto bits = c.bits(wanted);
    const std::size_t pairs = c.pairs();
    c.build_lists(1, false);
    sum(c);
    EXPECT_LT(c.pairs(), pairs) << title_of(fusion);
    EXPECT_EQ(c.bits(wanted), bits) << title_of(fusion);
    ++shorter;
  }
  EXPECT_GT(shorter, 0);
}

TEST(Fusions, do_not_care_where_rows_are_in_memory) {
  for (const Fusion& fusion : all_fusions()) {
    const auto placed = jittered_lattice(fusion.dim);
    PairCase one(fusion, placed, {}), other(fusion, placed, {.shuffle = 2});
    const std::vector<bool> wanted = where_defined(one, placed.size());
    EXPECT_EQ(where_defined(other, placed.size()), wanted);
    sum(one);
    sum(other);
    EXPECT_EQ(one.bits(wanted), other.bits(wanted)) << title_of(fusion);
  }
}

/// Two particles of one body, r spacings apart, of which the second has come `displaced` quanta along x.
struct Bond {
  double r;
  std::int64_t displaced;
};
/// Of each bond: how many the particle has, and the largest of all its other sums.
std::vector<std::array<double, 2>> count_bonds(PairCase& c, const std::vector<Bond>& bonds) {
  const auto d = static_cast<std::size_t>(c.fusion().dim);
  std::int64_t* displacement = c.particles().data<Field::displacement>();
  std::fill_n(displacement, c.particles().rows() * d, 0);
  if (double* crack = c.particles().data<Field::crack>()) std::fill_n(crack, c.particles().rows() * d, 0);
  for (std::size_t k = 0; k < bonds.size(); ++k) displacement[c.row_of(2 * k + 1) * d] = bonds[k].displaced;
  sum(c);
  std::vector<std::array<double, 2>> out(bonds.size());
  for (std::size_t k = 0; k < bonds.size(); ++k)
    for (const Field f : c.fusion().writes.list())
      for (int n = 0; n < components(info(f).shape, c.fusion().dim); ++n) {
        const double part = component(c, f, c.row_of(2 * k), n);
        double& to = out[k][f == Field::deformation && n == 0 ? 0 : 1];
        if (!(std::abs(part) <= to)) to = std::abs(part);  // no number is not lost
      }
  return out;
}

/// `other`: what the second is of, the solid or its clamp.
void place(const std::vector<Bond>& bonds, std::vector<test::Placed>& placed,
           std::uint32_t other = test::solid) {
  for (const Bond& bond : bonds) {
    const double y = 12 * static_cast<double>(placed.size());
    placed.push_back({{20, y, 0}, test::solid});
    placed.push_back({{20 + bond.r, y, 0}, other});
  }
}

// Or how wide lists are would decide when a run ends.
TEST(Fusions, lose_a_bond_that_is_longer_than_its_range_though_lists_hold_it) {
  int looked = 0;
  for (const Fusion& fusion : all_fusions()) {
    if (!fusion.writes.has(Field::deformation)) continue;
    ++looked;
    // Spacings: 1.2 times the support; of short bonds, the support alone.
    const bool cracked = fusion.values.has(Value::crack);
    const double range = cracked ? 3.6 : 4.32, then = cracked ? 1.8 : 3.5;
    std::vector<Bond> bonds{{range - 0.01, 0}, {range + 0.01, 0}};
    std::vector<test::Placed> placed;
    place(bonds, placed);
    PairCase c(fusion, placed, {.halo = false});
    for (Bond& bond : bonds)  // they were so far apart: less than bonds reach
      bond.displaced = std::llround((bond.r - then) * c.scene().start.spacing / c.quantum());
    for (const double widened : {1.0, 1.6}) {
      c.build_lists(widened);
      const auto found = count_bonds(c, bonds);
      EXPECT_EQ(found[0][0], 1) << title_of(fusion);
      EXPECT_EQ(found[1][0], 0) << title_of(fusion);
    }
  }
  EXPECT_GT(looked, 0);
}

// Rows of single precision hold reference positions modulo 2^32 units.
TEST(Fusions, do_not_bond_particles_that_were_far_apart) {
  int looked = 0;
  for (const Fusion& fusion : all_fusions()) {
    const bool of_faces = fusion.values.has(Value::wet_pressure) || fusion.writes.has(Field::flux_sums);
    if (!fusion.values.has(Value::reference) || of_faces) continue;
    ++looked;
    std::vector<Bond> bonds(5, {1.1, 0});
    std::vector<test::Placed> placed;
    place(bonds, placed, fusion.values.has(Value::clamp_reaction) ? test::clamp : test::solid);
    PairCase c(fusion, placed, {.halo = false});
    const int shift = c.context().scale.position_shift;
    for (std::size_t k = 0; k < bonds.size(); ++k)
      bonds[k].displaced = (static_cast<std::int64_t>(k) - 2) * (std::int64_t{1} << (32 + shift));
    const auto found = count_bonds(c, bonds);
    for (const std::size_t k : {0, 1, 3, 4}) {
      EXPECT_EQ(found[k][0], 0) << title_of(fusion);
      EXPECT_EQ(found[k][1], 0) << title_of(fusion);
    }
    EXPECT_NE(found[2][0] + found[2][1], 0) << title_of(fusion);
  }
  EXPECT_GT(looked, 0);
}

// A solver changes what it solves for from one run to the next, and nothing else.
TEST(Fusions, pack_what_is_solved_for_anew_as_they_pack_it_at_first) {
  std::set<Field> solved;
  for (const Fusion& fusion : all_fusions()) {
    if (!fusion.writes.has(Field::viscous_sums) && !fusion.writes.has(Field::exchange_sums)) continue;
    const Field field = fusion.values.has(Value::direction) ? Field::direction : Field::trial;
    solved.insert(field);
    const auto placed = jittered_lattice(fusion.dim);
    PairCase c(fusion, placed, {});
    const std::vector<bool> wanted = where_defined(c, placed.size());
    sum(c);
    const auto before = c.bits(wanted);
    double* numbers = field == Field::direction ? c.particles().data<Field::direction>()
                                                : c.particles().data<Field::trial>();
    const auto width = static_cast<std::size_t>(components(info(field).shape, fusion.dim));
    for (std::size_t k = 0; k < c.particles().rows() * width; ++k) numbers[k] = 0.3 - 1.7 * numbers[k];
    c.repack();
    c.run();
    const auto after = c.bits(wanted);
    sum(c);
    EXPECT_EQ(after, c.bits(wanted)) << title_of(fusion);
    EXPECT_NE(after, before) << title_of(fusion);
  }
  EXPECT_EQ(solved.size(), 2u);
}

}  // namespace
}  // namespace sph

// Particles for one compiled sum over pairs: values at random, positions in disorder, and in every field that
// the fusion does not declare, or that it must not look at, no number.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "decomp/grid.hpp"
#include "decomp/timer.hpp"
#include "sph/models/sph_constants.hpp"
#include "sph/pairs/fusions.hpp"
#include "sph/pairs/sph_lists.hpp"

namespace sph::test {

/// Groups of the scene, by index: two fluids with tension between them, a solid, a wall, and one that holds
/// the solid.
enum PairGroup : std::uint32_t { light, heavy, solid, wall, clamp };

struct Placed {
  Double3 x{};  ///< [spacings]
  std::uint32_t group = light;
};
/// Walls on one side, all else mixed: some 110 particles that are 18 spacings across in two dimensions.
[[nodiscard]] std::vector<Placed> jittered_lattice(int dim);
/// Pairs of any two groups, each beyond the reach of all others: 2k and 2k + 1 belong together.
[[nodiscard]] std::vector<Placed> isolated_pairs(int dim);

struct PairOptions {
  bool local_sound = true;    ///< as a field; else the groups' own
  bool halo = true;           ///< some rows are copies: they have no sums of their own
  bool poisoned = false;      ///< all other fields exist too, and they and the rows' padding are no numbers
  std::uint64_t shuffle = 1;  ///< which order the rows of a class have in memory
};

class PairCase {
 public:
  PairCase(const Fusion& fusion, const std::vector<Placed>& placed, const PairOptions& options);
  PairCase(const PairCase&) = delete;
  PairCase& operator=(const PairCase&) = delete;

  /// Lists that reach `widened` times as far as they must.
  void build_lists(double widened, bool walls_list_walls = true);
  /// From now on without what lists of bonds and of walls and blocks far from fluids leave out, as scenes do.
  void leave_out();
  void pack();
  void repack();
  void run();
  [[nodiscard]] PassContext context();

  [[nodiscard]] const Fusion& fusion() const { return fusion_; }
  [[nodiscard]] const Scene& scene() const { return scene_; }
  [[nodiscard]] Particles& particles() { return particles_; }
  [[nodiscard]] const Particles& particles() const { return particles_; }
  [[nodiscard]] std::size_t row_of(std::size_t number) const { return row_of_[number]; }  ///< of Placed
  [[nodiscard]] std::size_t pairs() const { return lists_.all.pairs(); }
  [[nodiscard]] double quantum() const { return constants_.scale.quantum; }
  [[nodiscard]] double dt() const { return 4e-3; }
  /// All that the fusion writes, by particle as they were placed, of owned rows among the `wanted` ones.
  [[nodiscard]] std::vector<std::uint64_t> bits(const std::vector<bool>& wanted) const;

 private:
  void fill(std::size_t row, std::uint64_t number, const Placed& at);
  void set(Field field, std::size_t row, double value);  ///< all components
  [[nodiscard]] bool is_wall(std::uint32_t group) const { return group == wall || group == clamp; }

  const Fusion& fusion_;
  Scene scene_;
  SphConstants constants_;
  Particles particles_;
  FieldSet read_;  ///< fields that the fusion may look at
  RowRanges ranges_{};
  SphLists lists_;
  bool leaves_out_ = false;
  decomp::Timers timers_;
  decomp::LargeVector<std::byte> rows_;
  std::vector<std::size_t> row_of_;
};

/// "3D mixed Quintic: Pressure, Viscosity"
[[nodiscard]] std::string title_of(const Fusion& fusion);

/// A signalling NaN with a payload.
inline constexpr std::uint64_t poison_bits = 0x7ff4'dead'beef'0001u;

}  // namespace sph::test

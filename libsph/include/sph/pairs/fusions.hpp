// The compiled passes. Terms that run in one pass are fused at compile time; a scene picks its fusions at
// run time from this list. One that is absent is refused by `check` with the line to add to fusion_list.hpp.
#pragma once

#include <string>
#include <vector>

#include "sph/pairs/pass_context.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

struct Fusion {
  int dim;
  Precision precision;
  KernelShape kernel;
  std::vector<Term> terms;
  ValueSet values;  ///< read of both particles of a pair
  FieldSet writes;  ///< sums
  int row_bytes;
  bool asks_for_fluid;  ///< in which blocks it is (fluid_blocks.hpp)
  bool over_movers;     ///< walls add 0
  bool over_walls;      ///< ... or all else does, to what moves
  void (*pack)(const PassContext&, std::size_t first, std::size_t last);
  void (*repack)(const PassContext&, std::size_t first, std::size_t last);  ///< what is solved for alone
  void (*run)(const PassContext&, const RowRange&);
};

[[nodiscard]] const std::vector<Fusion>& all_fusions();

/// Throws InputError with the line to add if there is none. The order of `terms` does not matter.
[[nodiscard]] const Fusion& find_fusion(int dim, Precision precision, KernelShape kernel,
                                        const std::vector<Term>& terms);

/// Lanes of a SIMD block: 16 float pairs or 8 double pairs at once.
[[nodiscard]] constexpr int lanes_of(Precision p) { return p == Precision::mixed ? 16 : 8; }

}  // namespace sph

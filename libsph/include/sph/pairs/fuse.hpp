// A compiled pass of some terms: what a fusion is made of.
#pragma once

#include "sph/core/kernels.hpp"
#include "sph/pairs/fusions.hpp"
#include "sph/pairs/pair_pass.hpp"

namespace sph {

template <class Kernel>
inline constexpr KernelShape shape_of = KernelShape::quintic;
template <>
inline constexpr KernelShape shape_of<WendlandC2> = KernelShape::wendland_c2;
template <>
inline constexpr KernelShape shape_of<WendlandC4> = KernelShape::wendland_c4;

template <class T, int D, class Kernel, class... Terms>
Fusion fusion_of() {
  using Pass = PairPass<T, D, Kernel, Terms...>;
  return {D,
          sizeof(T) == 4 ? Precision::mixed : Precision::double_,
          shape_of<Kernel>,
          {term<Terms>...},
          Pass::values,
          Pass::writes,
          static_cast<int>(Pass::Layout::stride * sizeof(T)),
          Pass::asks_for_fluid,
          Pass::over_movers,
          Pass::over_walls,
          Pass::pack,
          Pass::repack,
          Pass::run};
}

/// In every dimension and precision, with every kernel.
template <class... Terms>
std::vector<Fusion> fusions_of() {
  const auto with = []<class Kernel>(Kernel) {
    return std::vector<Fusion>{
        fusion_of<float, 2, Kernel, Terms...>(), fusion_of<double, 2, Kernel, Terms...>(),
        fusion_of<float, 3, Kernel, Terms...>(), fusion_of<double, 3, Kernel, Terms...>()};
  };
  std::vector<Fusion> all;
  for (const auto& part : {with(Quintic{}), with(WendlandC2{}), with(WendlandC4{})})
    all.insert(all.end(), part.begin(), part.end());
  return all;
}

}  // namespace sph

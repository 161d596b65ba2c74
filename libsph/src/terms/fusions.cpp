#include "sph/pairs/fusions.hpp"

#include <algorithm>

#include "sph/terms/added_term.hpp"

namespace sph {

std::vector<Fusion> fusions_2d_float();
std::vector<Fusion> fusions_2d_double();
std::vector<Fusion> fusions_3d_float();
std::vector<Fusion> fusions_3d_double();
std::vector<Fusion> exchange_fusions();

const std::vector<Fusion>& all_fusions() {
  static const std::vector<Fusion> all = [] {
    std::vector<Fusion> list;
    for (const auto& part : {fusions_2d_float(), fusions_2d_double(), fusions_3d_float(), fusions_3d_double(),
                             exchange_fusions()})
      list.insert(list.end(), part.begin(), part.end());
    for (const AddedTerm* t : added_terms()) list.insert(list.end(), t->fusions.begin(), t->fusions.end());
    return list;
  }();
  return all;
}

const Fusion& find_fusion(int dim, Precision precision, KernelShape kernel, const std::vector<Term>& terms) {
  const auto sorted = [](std::vector<Term> t) {
    std::sort(t.begin(), t.end());
    return t;
  };
  const auto find = [&](KernelShape shape) {
    return std::ranges::find_if(all_fusions(), [&](const Fusion& f) {
      return f.dim == dim && f.precision == precision && f.kernel == shape &&
             sorted(f.terms) == sorted(terms);
    });
  };
  if (const auto found = find(kernel); found != all_fusions().end()) return *found;
  if (find(KernelShape::quintic) != all_fusions().end())
    throw InputError("kernel.shape: is not \"quintic\", which alone comes with these terms: remove it");
  std::string line = kernel == KernelShape::quintic       ? "fuse<Quintic"
                     : kernel == KernelShape::wendland_c2 ? "fuse<WendlandC2"
                                                          : "fuse<WendlandC4";
  for (Term t : terms) line += ", " + std::string(t.name);
  throw InputError("this combination of terms is not compiled; add the line \"" + line +
                   ">(),\" to libsph/src/terms/fusion_list.hpp and rebuild");
}

std::byte* aligned_scratch(decomp::LargeVector<std::byte>& scratch, std::size_t bytes) {
  constexpr std::size_t alignment = 64;
  if (scratch.size() < bytes + alignment) scratch.resize(bytes + bytes / 8 + alignment);
  const auto address = reinterpret_cast<std::uintptr_t>(scratch.data());
  return scratch.data() + (alignment - address % alignment) % alignment;
}

}  // namespace sph

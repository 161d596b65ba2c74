#include "halo_select.hpp"

#include <algorithm>
#include <array>
#include <string>

namespace decomp {
namespace {

/// Half-open box as start and width in arithmetic modulo 2^64: one comparison an axis, and no overflow at
/// the outer faces (+-2^62) of a non-periodic axis.
struct Window {
  std::array<std::uint64_t, max_axes> lo{}, width{};

  Window(const Box& box, std::int64_t grow, const Int3& shift) {
    for (int a = 0; a < max_axes; ++a) {
      const std::int64_t low = box.lo[a] - grow - shift[a], high = box.hi[a] + grow - shift[a];
      lo[a] = static_cast<std::uint64_t>(low);
      width[a] = high > low ? static_cast<std::uint64_t>(high) - lo[a] : 0;
    }
  }

  template <int dim>
  [[nodiscard]] bool contains(const std::int64_t* x) const {
    bool in = true;
    for (int a = 0; a < dim; ++a) in &= static_cast<std::uint64_t>(x[a]) - lo[a] < width[a];
    return in;
  }
};

/// Calls work with the dimension as a constant, so that the loop over axes unrolls.
template <class Work>
void with_dim(int dim, Work&& work) {
  switch (dim) {
    case 1:
      return work(std::integral_constant<int, 1>{});
    case 2:
      return work(std::integral_constant<int, 2>{});
    default:
      return work(std::integral_constant<int, 3>{});
  }
}

}  // namespace

RowSelector::RowSelector(const std::int64_t* x, std::size_t rows, int dim, const Box& own, std::int64_t reach)
    : x_(x), dim_(dim), reach_(reach) {
  const Window inner(own, -reach, {}), whole(own, 0, {});
  with_dim(dim, [&](auto d) {
    for (std::size_t r = 0; r < rows; ++r) {
      const std::int64_t* p = x_ + r * d;
      if (inner.contains<d>(p)) continue;
      if (!whole.contains<d>(p)) {
        std::string where;
        for (int a = 0; a < dim_; ++a) where += (a > 0 ? ", " : "") + std::to_string(p[a]);
        throw GuardError("row " + std::to_string(r) + " at (" + where + ") quanta is outside its rank's box");
      }
      near_face_.push_back(static_cast<std::uint32_t>(r));
    }
  });
}

void RowSelector::select(const Box& box, const Int3& shift, std::vector<std::uint32_t>& rows) const {
  const Window window(box, reach_, shift);
  with_dim(dim_, [&](auto d) {
    for (const std::uint32_t r : near_face_)
      if (window.contains<d>(x_ + r * std::size_t{d})) rows.push_back(r);
  });
}

}  // namespace decomp

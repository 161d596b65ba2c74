// Conjugate gradients for a symmetric positive definite operator on numbers of the particles that move, preconditioned by
// its diagonal, with the two dot products of an iteration in one reduction (Chronopoulos & Gear 1989). Dot products are
// exact sums of one term a particle, so the iterations are the same on any number of ranks. They start from no change.
#pragma once

#include <array>
#include <span>
#include <vector>

#include "decomp/exact_sum.hpp"
#include "pairs/for_rows.hpp"

namespace sph {

class ConjugateGradients {
 public:
  /// Sums of the caller's that travel with the first two products.
  static constexpr std::size_t most_beside = 2;

  /// All is 0: the caller gives residual and diagonal of what moves.
  void clear(std::size_t rows, std::size_t components) {
    components_ = components;
    for (std::vector<double>* v : {&change_, &residual_, &search_, &image_, &search_image_})
      v->assign(rows * components, 0.0);
    diagonal_.assign(rows, 1.0);
    for (decomp::ExactSum& s : sums_) s = {};
    first_ = true;
  }
  [[nodiscard]] double& residual(std::size_t k) { return residual_[k]; }
  [[nodiscard]] double& diagonal(std::size_t row) { return diagonal_[row]; }
  [[nodiscard]] double change(std::size_t k) const { return change_[k]; }
  [[nodiscard]] decomp::ExactSum& beside(std::size_t which) { return sums_[2 + which]; }

  /// What the operator is to be applied to first.
  void begin(const RowRanges& ranges, double* direction) const {
    for_movers(ranges, [&](std::size_t i) {
      for (std::size_t k = i * components_; k < (i + 1) * components_; ++k)
        direction[k] = residual_[k] / diagonal_[i];
    });
  }

  /// `image(i, k)`: what the operator makes of `direction`, component k, which is of row i. Returns what is to be summed.
  template <class Image>
  [[nodiscard]] std::span<decomp::ExactSum> multiply(const RowRanges& ranges, const double* direction,
                                                     Image image) {
    sums_[0] = sums_[1] = {};
    for_movers(ranges, [&](std::size_t i) {
      double product = 0, curvature = 0;
      for (std::size_t k = i * components_; k < (i + 1) * components_; ++k) {
        image_[k] = image(i, k);
        product += residual_[k] * direction[k];
        curvature += image_[k] * direction[k];
      }
      sums_[0].add(product);
      sums_[1].add(curvature);
    });
    return std::span(sums_).first(first_ ? 2 + most_beside : 2);
  }

  /// Of the residual, over the diagonal, once the products are summed.
  [[nodiscard]] double square() const { return sums_[0].value(); }
  /// Of the first iteration, so far.
  [[nodiscard]] bool is_first() const { return first_; }

  /// The next change, residual and direction; false where the operator is not positive.
  [[nodiscard]] bool advance(const RowRanges& ranges, double* direction) {
    const double product = sums_[0].value(), curvature = sums_[1].value();
    const double old = first_ ? 0 : product / product_;
    const double along = first_ ? curvature : curvature - old * product / length_;
    if (!(along > 0)) return false;
    length_ = product / along;
    product_ = product;
    first_ = false;
    for_movers(ranges, [&](std::size_t i) {
      for (std::size_t k = i * components_; k < (i + 1) * components_; ++k) {
        search_[k] = direction[k] + old * search_[k];
        search_image_[k] = image_[k] + old * search_image_[k];
        change_[k] += length_ * search_[k];
        residual_[k] -= length_ * search_image_[k];
        direction[k] = residual_[k] / diagonal_[i];
      }
    });
    return true;
  }

 private:
  std::size_t components_ = 1;
  std::vector<double> change_, residual_;  ///< by row and component
  std::vector<double> search_;             ///< direction
  std::vector<double> image_,
      search_image_;              ///< the operator on the residual over the diagonal, and on `search_`
  std::vector<double> diagonal_;  ///< by row
  bool first_ = true;
  double product_ = 0, length_ = 0;                     ///< r.u and alpha of the last iteration
  std::array<decomp::ExactSum, 2 + most_beside> sums_;  ///< r.u, w.u; the caller's
};

}  // namespace sph

#include "sph/pairs/ways_apart.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <vector>

namespace sph {
namespace {

constexpr std::int32_t nothing = -(1 << 30);

/// Of the ways in a cell, the largest along each axis and against it.
template <int D>
struct Span {
  std::array<std::int32_t, 2 * D> most;

  void add(const Span& other) {
    for (std::size_t k = 0; k < most.size(); ++k) most[k] = std::max(most[k], other.most[k]);
  }
  /// Between any two of them, squared.
  [[nodiscard]] double square() const {
    double sum = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const double along = static_cast<double>(most[a]) + static_cast<double>(most[D + a]);
      sum += along * along;
    }
    return sum;
  }
};

template <int D>
using Place = std::array<std::int64_t, D>;

/// Where rows will be.
template <int D>
class Drift {
 public:
  Drift(const Particles& particles, const std::vector<bool>& is_wall, double time)
      : x_(particles.places()),
        v_(time == 0 ? nullptr : particles.data<Field::velocity>()),
        group_(particles.data<Field::group>()) {
    for (const bool wall : is_wall) time_.push_back(wall ? 0.0 : time);
  }
  [[nodiscard]] Place<D> operator()(std::size_t i) const {
    Place<D> place;
    for (std::size_t a = 0; a < D; ++a) place[a] = x_(i, a);
    if (v_ == nullptr) return place;
    const double time = time_[group_[i]];
    for (std::size_t a = 0; a < D; ++a) place[a] += static_cast<std::int64_t>(v_[i * D + a] * time);
    return place;
  }

 private:
  RowPlaces x_;
  const double* v_;
  const std::uint32_t* group_;
  std::vector<double> time_;  ///< by group [quanta per m/s]
};

/// Cells that hold all rows, x fastest, no narrower than `near`, and not many more than rows.
template <int D>
class Cells {
 public:
  Cells(const Drift<D>& places, std::size_t rows, double near) {
    Place<D> last;
    first_.fill(std::numeric_limits<std::int64_t>::max());
    last.fill(std::numeric_limits<std::int64_t>::min());
    for (std::size_t i = 0; i < rows; ++i) {
      const Place<D> x = places(i);
      for (std::size_t a = 0; a < D; ++a) {
        first_[a] = std::min(first_[a], x[a]);
        last[a] = std::max(last[a], x[a]);
      }
    }
    // Two places nearer than an edge are in cells beside each other, whatever the product below is rounded to.
    for (double edge = near * (1 + 1e-9);; edge *= 2) {
      per_quantum_ = 1 / edge;
      double cells = 1;
      for (std::size_t a = 0; a < D; ++a) {
        number_[a] = index(last[a], a) + 1;
        cells *= static_cast<double>(number_[a]);
      }
      if (cells <= 2 * static_cast<double>(rows) + 64) break;
    }
  }

  [[nodiscard]] std::size_t all() const {
    std::size_t n = 1;
    for (const std::size_t k : number_) n *= k;
    return n;
  }
  [[nodiscard]] std::size_t number(std::size_t axis) const { return number_[axis]; }
  [[nodiscard]] std::size_t of(const Place<D>& x) const {
    std::size_t at = 0;
    for (std::size_t a = D; a-- > 0;) at = at * number_[a] + index(x[a], a);
    return at;
  }

 private:
  [[nodiscard]] std::size_t index(std::int64_t x, std::size_t axis) const {
    return static_cast<std::size_t>(
        static_cast<std::int64_t>(static_cast<double>(x - first_[axis]) * per_quantum_));
  }

  Place<D> first_{};
  std::array<std::size_t, D> number_{};
  double per_quantum_ = 0;
};

}  // namespace

void WaysApart::begin(const Particles& particles, std::int64_t reach) {
  dim_ = static_cast<std::size_t>(particles.dim());
  reach_ = reach;
  shift_ = std::max(static_cast<int>(std::bit_width(static_cast<std::uint64_t>(reach))) - 28, 0);
  const std::size_t n = particles.rows() * dim_;
  const std::int64_t* x = particles.data<Field::position>();
  begin_.resize(n);
  for (std::size_t k = 0; k < n; ++k) begin_[k] = static_cast<std::uint32_t>(x[k] >> shift_);
}

WaysApart::Ways WaysApart::look(const Particles& particles, const std::vector<bool>& is_wall,
                                double time) const {
  if (particles.rows() == 0) return {};
  return particles.dim() == 2 ? look_in<2>(particles, is_wall, time) : look_in<3>(particles, is_wall, time);
}

// Two rows in cells beside each other are together in some block of two cells along each axis.
template <int D>
WaysApart::Ways WaysApart::look_in(const Particles& particles, const std::vector<bool>& is_wall,
                                   double time) const {
  const Drift<D> places(particles, is_wall, time);
  const Cells<D> cells(places, particles.rows(), static_cast<double>(reach_));
  Span<D> none;
  none.most.fill(nothing);
  std::vector<Span<D>> spans(cells.all(), none);
  double longest2 = 0;
  for (std::size_t i = 0; i < particles.rows(); ++i) {
    const Place<D> x = places(i);
    Span<D> way;
    double way2 = 0;
    for (std::size_t a = 0; a < D; ++a) {
      const std::int32_t w = units(i * D + a, x[a]);
      way.most[a] = w;
      way.most[D + a] = -w;
      way2 += static_cast<double>(w) * static_cast<double>(w);
    }
    spans[cells.of(x)].add(way);
    longest2 = std::max(longest2, way2);
  }
  std::size_t stride = 1;
  for (std::size_t a = 0; a < D; stride *= cells.number(a), ++a)
    for (std::size_t c = 0; c + stride < spans.size(); ++c)
      if (c / stride % cells.number(a) + 1 < cells.number(a)) spans[c].add(spans[c + stride]);
  double apart2 = 0;
  for (const Span<D>& block : spans)
    if (block.most[0] != nothing) apart2 = std::max(apart2, block.square());
  // A component is less than two units off, a difference of two of them less than four.
  return {(std::sqrt(longest2) + 4) * unit(), (std::sqrt(apart2) + 8) * unit()};
}

}  // namespace sph

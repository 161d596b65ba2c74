// What a case with a known flow is held against: iterations, and the relative L2 norms of what is off.
#pragma once

#include <array>
#include <cmath>

#include "decomp/exact_sum.hpp"
#include "stokes/solver.hpp"

namespace test_stokes {

/// Relative L2 norms of differences over all ranks.
class Norms {
 public:
  void add(std::size_t kind, double got, double exact) {
    sums_[2 * kind].add((got - exact) * (got - exact));
    sums_[2 * kind + 1].add(exact * exact);
  }
  std::array<double, 2> of_all(const decomp::Comm& comm) {
    decomp::ExactSum::all_reduce(comm, sums_);
    return {std::sqrt(sums_[0].value() / sums_[1].value()), std::sqrt(sums_[2].value() / sums_[3].value())};
  }

 private:
  std::array<decomp::ExactSum, 4> sums_;
};

struct Solved {
  stokes::Effort effort;
  std::array<double, 2> errors;  ///< of velocity and pressure
};

}  // namespace test_stokes

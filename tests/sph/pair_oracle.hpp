// What a sum over pairs should be: the published formula of each term in SI units and double precision, over
// all pairs, without rows, lists or the library's kernels.
#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <string_view>
#include <vector>

#include "pair_fixture.hpp"

namespace sph::test {

/// Tells the names of terms apart in a switch: FNV-1a.
[[nodiscard]] constexpr std::uint64_t key(std::string_view name) {
  std::uint64_t hash = 0xcbf29ce484222325u;
  for (const char c : name) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3u;
  return hash;
}

[[nodiscard]] inline double power(double x, int n) { return n == 0 ? 1 : x * power(x, n - 1); }
/// 2ab / (a + b)
[[nodiscard]] inline double harmonic(double a, double b) { return a + b > 0 ? 2 * a * b / (a + b) : 0.0; }

using Vec = Eigen::Vector3d;  ///< in two dimensions the third component is 0
using Mat = Eigen::Matrix3d;

/// One particle, as its fields and its group have it. What the fusion does not read is 0.
struct PairParticle {
  std::array<std::int64_t, 3> x{}, reference{};  ///< [quanta]
  Vec v, colour, direction, slope, rest_gradient, wet_v, shift, reaction;
  Vec frame;  ///< acceleration of a body
  Vec crack;
  Mat stress, bond_stress, gradient;  ///< stress: the total one
  double mass, density, weight, pressure, wet_pressure, flux, volume, sound, energy, width, correction,
      curvature, viscosity;
  double rest_volume, modulus, hourglass;
  double temperature, trial, conductivity, sensible_heat;
  double permeability, gas_mobility, gas_pressure, gas_density;
  double dissolved, water_mobility, overload, crack_distance, crack_closing;
  std::array<double, 2> wall_pressures;
  bool mover, shears, heavy, owned, warm, open, slips, failing;
  int side, group, body;
};

/// Sums of one particle, and how large their parts are: what rounding is relative to.
struct PairSums {
  struct Sum {
    double value = 0, size = 0;
    void add(double part) { add(part, part < 0 ? -part : part); }
    void add(double part, double of_size) { value += part, size += of_size; }
  };
  std::array<std::array<Sum, 20>, field_count> of{};
};

class PairOracle {
 public:
  explicit PairOracle(const PairCase& of);
  [[nodiscard]] PairSums sums(std::size_t row) const;
  /// Does the term mean anything there? Those of walls are sums for walls alone, others for movers alone.
  [[nodiscard]] bool defined(Term term, std::size_t row) const;

 private:
  struct Pair {
    const PairParticle &i, &j;
    Vec x;  ///< x_j - x_i
    double r;
    double slope;  ///< dW/dr; where kernels differ in width the mean of both
    Vec gradient;  ///< grad_i W
  };
  struct Bond {
    Vec X, u;  ///< reference distance, displacement
  };
  void load();
  [[nodiscard]] Bond bond(const Pair& pair) const;
  [[nodiscard]] bool faces(const Pair& pair, double cosine) const;  ///< both see the other across a crack
  [[nodiscard]] bool are_faces(const Pair& pair) const;
  void add_crack(const Pair& pair, double weight, PairSums& sums) const;
  [[nodiscard]] double w(double r, double h) const;         ///< W
  [[nodiscard]] double dw(double r, double h) const;        ///< dW/dr
  [[nodiscard]] double bare(double value) const;            ///< without the kernel's factor
  [[nodiscard]] double moment(int power) const;             ///< -1/D sum V dW/dr r^power over the lattice
  [[nodiscard]] double layer(const PairParticle& p) const;  ///< h |grad C|, 0 where that is noise
  [[nodiscard]] Vec normal(const PairParticle& p) const;
  [[nodiscard]] Mat capillary(const PairParticle& p) const;
  void add(Term term, const Pair& pair, PairSums& sums) const;
  void add_force(const Pair& pair, Term term, PairSums& sums) const;
  void add_contact(const Pair& pair, Term term, PairSums& sums) const;
  void add_bond(const Pair& pair, Term term, PairSums& sums) const;
  void add_exchange(const Pair& pair, Term term, PairSums& sums) const;
  [[nodiscard]] Vec shock(const Pair& pair) const;

  const PairCase& of_;
  const Scene& scene_;
  int dim_;
  double h_;
  Mat unit_;  ///< of as many dimensions as there are
  double second_, fourth_;
  bool looks_back_;
  std::vector<PairParticle> all_;
};

}  // namespace sph::test

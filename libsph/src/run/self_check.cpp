#include "sph/run/self_check.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

#include "decomp/splitmix.hpp"
#include "sph/core/error.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/core/fixed_point.hpp"
#include "sph/core/kernels.hpp"
#include "sph/core/simd.hpp"

namespace sph {
namespace {

constexpr std::uint64_t recorded = 0xf029b4080dff47c2;  // of every correct build

// Volatile, so that nothing is computed by the compiler.
volatile std::uint64_t seed = 20240607;

struct Random {
  std::uint64_t state = seed;
  std::uint64_t bits() { return decomp::splitmix_mix(state += decomp::splitmix_stride); }
  double unit() { return decomp::splitmix_unit(bits()); }
};

class Hash {
 public:
  template <class T>
  void add(T x) {
    const std::size_t at = bytes_.size();
    bytes_.resize(at + sizeof x);
    std::memcpy(bytes_.data() + at, &x, sizeof x);
  }
  [[nodiscard]] std::uint64_t value() const { return XXH3_64bits(bytes_.data(), bytes_.size()); }

 private:
  std::vector<unsigned char> bytes_;
};

/// A particle a lane: x, y, volume, pressure.
template <class T>
std::array<Simd<T>, 4> random_particles(Random& random) {
  using Bits = typename Simd<T>::Bits;
  constexpr double range = 0x1p20;  // of a coordinate, in units
  constexpr std::size_t lanes = Simd<T>::lanes;
  std::array<std::array<T, lanes>, 4> value;
  for (std::size_t l = 0; l < lanes; ++l) {
    for (std::size_t k = 0; k < 2; ++k)
      value[k][l] = std::bit_cast<T>(static_cast<Bits>(random.unit() * range));
    value[2][l] = static_cast<T>(0.5 + random.unit());
    value[3][l] = static_cast<T>(1e5 * (random.unit() - 0.3));
  }
  std::array<Simd<T>, 4> out;
  for (std::size_t k = 0; k < 4; ++k) out[k] = Simd<T>::load(value[k].data());
  return out;
}

/// 1024 pairs through what a pass does: fixed-point distance, kernel slope, sums in order.
template <class T>
void add_pairs(Hash& hash) {
  using V = Simd<T>;
  const V unit(static_cast<T>(0.003 / 1024));
  const V tiny(static_cast<T>(1e-30));
  Random random;
  const std::array<V, 4> own = random_particles<T>(random);
  std::array<V, 4> sums;
  for (V& s : sums) s = V::zero();
  for (int block = 0; block < 1024 / V::lanes; ++block) {
    const std::array<V, 4> other = random_particles<T>(random);
    V e[2], r2 = V::zero();
    for (int k = 0; k < 2; ++k) {
      e[k] = coordinate_difference(own[k], other[k]) * unit;
      r2 += e[k] * e[k];
    }
    const V r = sqrt(r2);
    const V f = Quintic::slope<2>(r) / max(r, tiny);
    const V s = own[2] * other[2] * (own[3] + other[3]) * f;
    sums[0] += s * e[0];
    sums[1] += s * e[1];
    sums[2] += Quintic::value<2>(r) * other[2] - min(own[3], other[3]) / (r2 + V(static_cast<T>(0.01)));
    sums[3] += where_less(own[2], other[2], f) - where_equal(r2, r2, own[2] * r);
  }
  for (const V& s : sums)
    for (int l = 0; l < V::lanes; ++l) hash.add(s[l]);
}

void add_scalars(Hash& hash) {
  Random random;
  for (int k = 0; k < 32; ++k) {
    const double x = random.unit() + 1e-3, y = 20 * random.unit();
    for (double z : {exact_pow(x, y), exact_exp(x * y), exact_log(x), exact_sin(y), exact_cos(y),
                     std::sqrt(x) / y, x * y + y / x})
      hash.add(z);
    hash.add(round_to_quanta(1e9 * (x - 0.5)));
    hash.add(round_to_quanta(std::floor(y) + 0.5));
    const double small = x * 1e-160 * (y * 1e-150);  // below the smallest normal number, 2.2e-308
    hash.add(small);
    hash.add(small + x * 1e-308);
    hash.add(static_cast<float>(x) * static_cast<float>(1e-40 * y));
  }
}

}  // namespace

void self_check() {
  Hash hash;
  add_pairs<float>(hash);
  add_pairs<double>(hash);
  add_scalars(hash);
  if (hash.value() != recorded)
    throw InputError(
        fmt::format("this build does not follow the rules of the numbers: hash {:016x} instead of {:016x}; "
                    "build with the flags of cmake/FpModel.cmake, no -ffast-math, no other rounding mode",
                    hash.value(), recorded));
}

}  // namespace sph

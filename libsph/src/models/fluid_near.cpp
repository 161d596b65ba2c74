#include "sph/models/fluid_near.hpp"

#include <algorithm>
#include <bit>

#include "pairs/candidates.hpp"
#include "pairs/id_rank.hpp"
#include "sph/core/kernels.hpp"
#include "sph/core/simd_rows.hpp"

namespace sph {
namespace {

using V = Simd<double>;

/// Appends lanes [0, count) whose value is above 0, and their indices. Returns how many.
[[gnu::always_inline]] inline std::size_t append_positive(V value, const std::uint32_t* index,
                                                          std::size_t count, double* values,
                                                          std::uint32_t* indices) {
  const unsigned inside = count >= V::lanes ? 0xffu : (1u << count) - 1;
  const unsigned wanted = positive_lanes(value) & inside;
  const auto n = static_cast<std::size_t>(std::popcount(wanted));
#if defined(__AVX512F__) && defined(__AVX512VL__)
  const auto mask = static_cast<__mmask8>(wanted), out = static_cast<__mmask8>((1u << n) - 1);
  const __m256i all = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(index));
  _mm512_mask_storeu_pd(values, out, _mm512_maskz_compress_pd(mask, value.as<__m512d>()));
  _mm256_mask_storeu_epi32(indices, out, _mm256_maskz_compress_epi32(mask, all));
#else
  std::size_t k = 0;
  for (unsigned left = wanted; left != 0; left &= left - 1, ++k) {
    const int lane = std::countr_zero(left);
    values[k] = value[lane];
    indices[k] = index[lane];
  }
#endif
  return n;
}

/// Of rows listed near `at`, to be read in whole vectors, those within the support, and factor times the kernel there.
template <class Kernel>
std::size_t find_within(std::span<const std::uint32_t> listed, const std::int64_t* x, const std::int64_t* at,
                        double unit, double factor, double* kernel, std::uint32_t* rows) {
  V own[3];
  for (int a = 0; a < 3; ++a) own[a] = Int64x8(at[a]).bits<double>();
  std::size_t n = 0;
  for (std::size_t k = 0; k < listed.size(); k += V::lanes) {
    const std::uint32_t* index = listed.data() + k;
    V of[4], square = V::zero();
    load_vectors<3>(reinterpret_cast<const double*>(x), index, of);
    for (int a = 0; a < 3; ++a) {
      const V d = coordinate_difference(own[a], of[a]) * V(unit);
      square += d * d;
    }
    const V value = V(factor) * Kernel::template value<3>(sqrt(square));
    n += append_positive(value, index, listed.size() - k, kernel + n, rows + n);
  }
  return n;
}

/// How the share of the kernel that is below a surface grows with the depth of its centre, there: the integral
/// of the kernel over a plane [1/h].
double surface_slope(KernelShape kernel) {
  return kernel == KernelShape::quintic ? 239.0 / 420 : kernel == KernelShape::wendland_c2 ? 0.75 : 55.0 / 64;
}

}  // namespace

FluidNear::FluidNear(const Scene& scene, const PositionScale& scale, const SphConstants& constants)
    : scene_(&scene),
      constants_(&constants),
      scale_(scale),
      surface_slope_(surface_slope(scene.kernel.shape)) {}

void FluidNear::rebuild(const Particles& grains, const ListSetting& setting) {
  const auto timing = setting.timers.time(decomp::Region::lists);
  const Particles& fluid = *setting.other;
  const CellBins bins(fluid, setting.grid, setting.own_cells, setting.radius);
  const IdRank order(fluid.data<Field::id>(), fluid.rows());
  std::vector<std::uint32_t> tags(bins.rows().size());
  for (std::size_t k = 0; k < fluid.rows(); ++k) tags[k] = order.rank_of_row[bins.rows()[k]];
  const CandidateTable candidates{bins, tags.data()};
  const std::int64_t* x = grains.data<Field::position>();
  const auto* group = fluid.data<Field::group>();
  first_.assign(1, 0);
  entries_.clear();
  std::vector<std::uint32_t> found;
  CellBins::Runs runs;
  for (std::size_t i = 0; i < grains.rows(); ++i) {
    const std::span<const CellBins::Run> near = bins.runs_near(x + i * 3, runs);
    if (const std::size_t room = CandidateTable::room(near); room > found.size()) found.resize(2 * room);
    float at[3];
    for (int a = 0; a < 3; ++a) at[a] = bins.scaled(a, x[i * 3 + static_cast<std::size_t>(a)]);
    const std::size_t n = candidates.find<3, Keep::all>(near, at, bins.limit(), 0, found.data());
    std::sort(found.begin(), found.begin() + static_cast<std::ptrdiff_t>(n));
    for (std::size_t k = 0; k < n; ++k) {
      const std::uint32_t row = order.row_of_rank[found[k]];
      // A grain of another rank acts on the fluid of this one alone.
      const bool of_no_use = i >= grains.owned() && (row >= fluid.owned() || constants_->is_wall(group[row]));
      if (!of_no_use) entries_.push_back(row);
    }
    first_.push_back(entries_.size());
  }
  entries_.insert(entries_.end(), V::lanes, 0);
  found_.assign(grains.rows(), 0);
  rows_.resize(entries_.size());
  kernel_.resize(entries_.size());
}

void FluidNear::find_kernel(const Particles& grains, std::size_t i, const Particles& fluid) {
  const auto near = std::span(entries_).subspan(first_[i], listed(i));
  const double h = scene_->kernel.smoothing_length, h3 = h * h * h;
  const auto find = [&]<class Kernel>(Kernel) {
    return find_within<Kernel>(near, fluid.data<Field::position>(), grains.data<Field::position>() + i * 3,
                               scale_.quantum / h, Kernel::template normalisation<3> / h3,
                               kernel_.data() + first_[i], rows_.data() + first_[i]);
  };
  const KernelShape shape = scene_->kernel.shape;
  found_[i] = static_cast<std::uint32_t>(shape == KernelShape::quintic       ? find(Quintic{})
                                         : shape == KernelShape::wendland_c2 ? find(WendlandC2{})
                                                                             : find(WendlandC4{}));
}

// How much of a grain is below the surface follows from how much of the kernel around it is fluid, walls aside: half
// of it where the surface is at its centre, and beside that its slope times the depth. find_weights() has been asked.
FluidNear::Share FluidNear::share_of(std::size_t i, double radius, const Particles& fluid) const {
  constexpr double least = 0.02;  // of the kernel: what is beside a wall and dry
  const auto* group = fluid.data<Field::group>();
  const std::span<const std::uint32_t> near = rows(i);
  const std::span<const double> w = kernel(i);
  const double wall_volume = scene_->start.spacing * scene_->start.spacing * scene_->start.spacing;
  double wet = 0, walls = 0;
  for (std::size_t k = 0; k < near.size(); ++k) {
    wet += weights_[k];
    if (constants_->is_wall(group[near[k]])) walls += wall_volume * w[k];
  }
  const double open = 1 - walls;
  const double depth = (wet / open - 0.5) / surface_slope_ * scene_->kernel.smoothing_length / radius;
  if (!(wet > least) || !(open > least) || depth <= -1) return {0, 0};
  return {1 / wet, depth >= 1 ? 1.0 : 0.25 * (2 + depth * (3 - depth * depth))};
}

void FluidNear::find_volumes(const Particles& fluid, std::size_t first, std::size_t last) {
  const double* mass = fluid.data<Field::mass>();
  const double* density = fluid.data<Field::density>();
  const auto* group = fluid.data<Field::group>();
  volumes_.resize(fluid.rows());
  for (std::size_t j = first; j < last; ++j)
    volumes_[j] = constants_->is_wall(group[j]) ? 0.0 : mass[j] / density[j];
}

void FluidNear::find_weights(std::size_t i) {
  const std::span<const std::uint32_t> near = rows(i);
  const std::span<const double> w = kernel(i);
  weights_.resize(near.size());
  for (std::size_t k = 0; k < near.size(); ++k) weights_[k] = volumes_[near[k]] * w[k];
}

// Sums in the order of ids; find_weights() has been asked.
FluidAround FluidNear::look_around(const Particles& grains, std::size_t i, const Particles& fluid) const {
  const std::span<const std::uint32_t> near = rows(i);
  const std::span<const double> values = kernel(i);
  const double* v = fluid.data<Field::velocity>();
  const double* force = fluid.data<Field::force>();
  const double* porosity = fluid.data<Field::porosity>();
  const double* liquid = fluid.data<Field::liquid_density>();
  const double* sound = fluid.data<Field::sound_speed>();
  const auto* group = fluid.data<Field::group>();
  FluidAround out;
  double weight = 0, square = 0, e = 0, rho = 0, eta = 0;
  Double3 u{}, stress{};
  for (std::size_t k = 0; k < near.size(); ++k) {
    const double w = values[k], vw = weights_[k];
    if (!(vw > 0)) continue;
    const std::size_t j = near[k];
    weight += vw;
    square += vw * w;
    e += vw * porosity[j];
    rho += vw * liquid[j];
    eta += vw * scene_->groups[group[j]].viscosity;
    out.sound = std::max(out.sound, sound != nullptr ? sound[j] : constants_->groups.sound_speed[group[j]]);
    for (std::size_t a = 0; a < 3; ++a) {
      u[a] += vw * v[j * 3 + a];
      stress[a] += w * force[j * 3 + a];
    }
  }
  const double per_weight = 1 / weight;
  for (std::size_t a = 0; a < 3; ++a) {
    out.velocity[a] = u[a] * per_weight;
    out.stress[a] = stress[a] * per_weight;
  }
  out.porosity = e * per_weight;
  out.own = volume_of(grains.data<Field::radius>()[i]) * square * per_weight;
  out.density = rho * per_weight;
  out.viscosity = eta * per_weight;
  return out;
}

}  // namespace sph

#include "output/averages.hpp"

#include <cmath>

#include "sph/scene/with_kernel.hpp"

namespace sph {
namespace {

class Smoother {
 public:
  explicit Smoother(const Simulation& s)
      : scene_(s.scene()),
        particles_(s.particles(s.physics()->set())),
        d_(static_cast<std::size_t>(s.scene().dim)),
        quantum_(s.scale().quantum),
        widths_(particles_.has(Field::smoothing_length) ? particles_.data<Field::smoothing_length>()
                                                        : nullptr) {}

  /// Adds particle j's share in the average of particle i, by i's own kernel: its list reaches no further. Partners
  /// outside the support, which a list may hold or not, share nothing.
  void add(std::size_t i, std::size_t j) {
    if (particles_.data<Field::group>()[j] != particles_.data<Field::group>()[i]) return;
    const std::int64_t* x = particles_.data<Field::position>();
    double r2 = 0;
    for (std::size_t a = 0; a < d_; ++a) {
      const auto r = static_cast<double>(x[i * d_ + a] - x[j * d_ + a]);
      r2 += r * r;
    }
    const double h = widths_ != nullptr ? widths_[i] : scene_.kernel.smoothing_length;
    const double w = kernel_value(scene_.kernel.shape, scene_.dim, std::sqrt(r2) / (h / quantum_));
    if (w == 0) return;
    const double share = w * particles_.data<Field::mass>()[j] / particles_.data<Field::density>()[j];
    shares_ += share;
    for (std::size_t a = 0; a < d_; ++a)
      velocity_[a] += share * particles_.data<Field::velocity>()[j * d_ + a];
    pressure_ += share * particles_.data<Field::pressure>()[j];
  }
  /// Writes the averages of particle i and begins the next.
  void finish(std::size_t i, std::vector<double>& velocity, std::vector<double>& pressure) {
    for (std::size_t a = 0; a < d_; ++a) velocity[i * d_ + a] = velocity_[a] / shares_;
    pressure[i] = pressure_ / shares_;
    velocity_ = {};
    pressure_ = shares_ = 0;
  }

 private:
  const Scene& scene_;
  const Particles& particles_;
  std::size_t d_;
  double quantum_;
  const double* widths_;  ///< of kernels that change
  Double3 velocity_{};
  double pressure_ = 0, shares_ = 0;
};

}  // namespace

std::vector<ExtraColumn> average_columns(const Scene& scene) {
  return {{"velocity_smooth", "m/s", scene.dim, {}}, {"pressure_smooth", "Pa", 1, {}}};
}

std::vector<ExtraColumn> averages(Simulation& s) {
  std::vector<ExtraColumn> columns = average_columns(s.scene());
  s.refresh_halo(
      {Field::position, Field::velocity, Field::density, Field::mass, Field::group, Field::pressure});
  const std::size_t n = s.particles(s.physics()->set()).owned(),
                    lanes = static_cast<std::size_t>(s.lists().lanes());
  columns[0].values.resize(n * static_cast<std::size_t>(s.scene().dim));
  columns[1].values.resize(n);
  Smoother smoother(s);
  for (const RowRange& range : s.sets()[s.physics()->set()].ranges)
    for (std::size_t i = range.first; i < range.last; ++i) {
      const std::size_t k = i - range.first;
      const auto block = s.lists().block(range.first_block + k / lanes);
      smoother.add(i, i);
      for (std::size_t entry = k % lanes; entry < block.size(); entry += lanes)
        if (block[entry] != i) smoother.add(i, block[entry]);
      smoother.finish(i, columns[0].values, columns[1].values);
    }
  return columns;
}

}  // namespace sph

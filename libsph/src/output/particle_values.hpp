// The output quantities of one particle in SI, in the order of the columns of series.csv: x.., v.., rho, p,
// and psi and u where the scene has them; of a grain x.., v.. and its spin w.. if it has one. In a scene of both
// all of these, 0 where a particle lacks one.
#pragma once

#include <array>
#include <span>
#include <string>
#include <vector>

#include "sph/step/simulation.hpp"

namespace sph {

class ParticleValues {
 public:
  explicit ParticleValues(const Simulation& s) : ParticleValues(s, s.particles()) {}
  /// Of one of its sets.
  ParticleValues(const Simulation& s, const Particles& particles)
      : particles_(particles),
        scale_(s.scale()),
        wrap_(s.wrap()),
        d_(static_cast<std::size_t>(s.scene().dim)) {}

  [[nodiscard]] const Particles& particles() const { return particles_; }
  [[nodiscard]] double mass(std::size_t row) const { return particles_.data<Field::mass>()[row]; }
  [[nodiscard]] std::uint32_t group(std::size_t row) const { return particles_.data<Field::group>()[row]; }
  [[nodiscard]] std::int64_t quanta(std::size_t row, std::size_t axis) const {
    return wrap_(static_cast<int>(axis), particles_.data<Field::position>()[row * d_ + axis]);
  }
  [[nodiscard]] double position(std::size_t row, std::size_t axis) const {
    return scale_.metres(quanta(row, axis));
  }
  [[nodiscard]] double velocity(std::size_t row, std::size_t axis) const {
    return particles_.data<Field::velocity>()[row * d_ + axis];
  }

  /// Writes count() values.
  void all(std::size_t row, std::span<double> to) const {
    std::size_t k = 0;
    for (std::size_t a = 0; a < d_; ++a) to[k++] = position(row, a);
    for (std::size_t a = 0; a < d_; ++a) to[k++] = velocity(row, a);
    if (const double* spin = particles_.data<Field::spin>())
      for (std::size_t a = 0; a < d_; ++a) to[k++] = spin[row * d_ + a];
    if (!particles_.has(Field::density)) return;
    to[k++] = particles_.data<Field::density>()[row];
    to[k++] = particles_.data<Field::pressure>()[row];
    if (const double* psi = particles_.data<Field::void_fraction>()) to[k++] = psi[row];
    if (const double* u = particles_.data<Field::specific_energy>()) to[k++] = u[row];
    if (const double* t = particles_.data<Field::temperature>()) to[k++] = t[row];
  }
  [[nodiscard]] static std::vector<std::string> names(const Particles& p) {
    std::vector<std::string> out;
    constexpr std::array axes{"x", "y", "z"};
    for (int a = 0; a < p.dim(); ++a) out.emplace_back(axes[static_cast<std::size_t>(a)]);
    for (int a = 0; a < p.dim(); ++a) out.push_back(std::string("v") + axes[static_cast<std::size_t>(a)]);
    if (p.has(Field::spin))
      for (int a = 0; a < p.dim(); ++a) out.push_back(std::string("w") + axes[static_cast<std::size_t>(a)]);
    if (!p.has(Field::density)) return out;
    out.emplace_back("rho");
    out.emplace_back("p");
    if (p.has(Field::void_fraction)) out.emplace_back("psi");
    if (p.has(Field::specific_energy)) out.emplace_back("u");
    if (p.has(Field::temperature)) out.emplace_back("T");
    return out;
  }
  [[nodiscard]] static std::size_t count(const Particles& p) { return names(p).size(); }

 private:
  const Particles& particles_;
  const PositionScale& scale_;
  Wrap wrap_;
  std::size_t d_;
};

}  // namespace sph

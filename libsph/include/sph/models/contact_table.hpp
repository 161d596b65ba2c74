// The contacts of a scene in numbers: the constants of each pair of groups, and the quanta of the sums of forces and
// torques, which follow from the scene alone.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <span>

#include "decomp/memory.hpp"
#include "sph/scene/scene.hpp"

namespace sph {

class ContactTable {
 public:
  /// The time step is `dt` [s].
  ContactTable(const Scene& scene, double dt);

  [[nodiscard]] std::uint32_t groups() const { return groups_; }
  /// [groups][groups][8], each in the order of ContactConstants; aligned.
  [[nodiscard]] const double* data() const { return constants_.data(); }
  [[nodiscard]] std::span<const double, 8> operator()(std::size_t a, std::size_t b) const {
    return std::span<const double, 8>(constants_.data() + 8 * (a * groups_ + b), 8);
  }
  [[nodiscard]] double force_quantum() const { return force_quantum_; }    ///< [N]
  [[nodiscard]] double torque_quantum() const { return torque_quantum_; }  ///< [N m]

 private:
  void find_quanta(const Scene& scene);

  std::uint32_t groups_;
  decomp::LargeVector<double> constants_;
  double force_quantum_ = 1, torque_quantum_ = 1;
};

}  // namespace sph

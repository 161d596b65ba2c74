#include "sph/models/contact_table.hpp"

#include <algorithm>
#include <cmath>

#include "models/grain_constants.hpp"

namespace sph {
namespace {

double next_power_of_two(double x) { return std::ldexp(1.0, std::ilogb(x) + 1); }

}  // namespace

ContactTable::ContactTable(const Scene& scene, double dt)
    : groups_(static_cast<std::uint32_t>(scene.groups.size())) {
  const std::size_t n = groups_;
  constants_.resize(n * n * 8);
  for (std::size_t a = 0; a < n; ++a)
    for (std::size_t b = 0; b < n; ++b)
      std::ranges::copy(constants_of(scene, a, b, dt),
                        constants_.begin() + static_cast<std::ptrdiff_t>((a * n + b) * 8));
  find_quanta(scene);
}

// A force term stays below 2^50 quanta up to four times the elastic force at the largest overlap allowed: the
// rest is for dashpots. 4096 terms then fit a 64-bit sum. A torque is at most (mu + mu_r) r |F|, |F| at most
// sqrt(3) 2^50 quanta where the guard of forces lets it pass: below 2^51 quanta, and 4096 of them fit too.
void ContactTable::find_quanta(const Scene& scene) {
  double radius = 0;
  for (const Group& g : scene.groups) radius = std::max(radius, g.grain.largest_radius);
  const double overlap = scene.grains.contact.largest_overlap * radius;
  const double force = stiffest_contact(scene, radius) * overlap;
  force_quantum_ = std::ldexp(next_power_of_two(4 * force), -50);
  double friction = 1;
  for (std::size_t a = 0; a < scene.groups.size(); ++a)
    for (std::size_t b = a; b < scene.groups.size(); ++b) {
      const std::array<double, 8> k = constants_of(scene, a, b, 0);
      friction = std::max(friction, k[4] + k[5]);
    }
  torque_quantum_ = std::ldexp(next_power_of_two(8 * force * radius * friction), -50);
}

}  // namespace sph

#include "sph/models/contact_stiffness.hpp"

#include <cmath>

#include "sph/core/fixed_point.hpp"
#include "sph/laws/contact/law.hpp"

namespace sph {
namespace {

class Rows {
 public:
  Rows(const Scene& scene, const Particles& grains, const ContactTable& table, double quantum, double unit)
      : law_(contact_law(scene)),
        table_(table),
        quantum_(quantum),
        unit_(unit),
        x_(grains.data<Field::position>()),
        radius_(grains.data<Field::radius>()),
        group_(grains.data<Field::group>()) {}

  [[nodiscard]] const std::int64_t* x(std::size_t i) const { return x_ + 3 * i; }
  [[nodiscard]] double quantum() const { return quantum_; }
  [[nodiscard]] double radius(std::size_t i) const { return radius_[i]; }
  [[nodiscard]] std::uint32_t group(std::size_t i) const { return group_[i]; }
  [[nodiscard]] double overlap(std::size_t i, std::size_t j) const {
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double d = static_cast<double>(x(j)[a] - x(i)[a]) * quantum_;
      square += d * d;
    }
    return radius_[i] + radius_[j] - std::sqrt(square);
  }
  /// Of two grains of that radius.
  [[nodiscard]] std::array<std::int64_t, 2> of(std::uint32_t a, std::uint32_t b, double radius,
                                               double overlap) const {
    const std::span<const double, 8> k = table_(a, b);
    const PairConstants constants{k[0], k[1], k[2], k[7]};
    const double normal = law_.stiffness(constants, radius, overlap);
    const double tangential = k[4] > 0 ? law_.shear_stiffness(constants, normal) : 0.0;
    return {round_to_quanta(normal / unit_), round_to_quanta(tangential / unit_)};
  }

 private:
  const ContactLaw& law_;
  const ContactTable& table_;
  double quantum_, unit_;
  const std::int64_t* x_;
  const double* radius_;
  const std::uint32_t* group_;
};

void add(const std::array<std::int64_t, 2>& k, std::array<std::int64_t, 2>& to) {
  to[0] += k[0];
  to[1] += k[1];
}

}  // namespace

std::vector<std::array<std::int64_t, 2>> stiffness_of_rows(const Scene& scene, const ContactLists& lists,
                                                           const Particles& grains, const ContactTable& table,
                                                           std::span<const PlaneNow> planes, double quantum,
                                                           double unit) {
  std::vector<std::array<std::int64_t, 2>> sums(grains.rows());
  const Rows rows(scene, grains, table, quantum, unit);
  const ContactGroups &pairs = lists.pairs(), &walls = lists.walls();
  for (std::size_t l = 0; l < pairs.i.size(); ++l) {
    const std::size_t i = pairs.i[l], j = pairs.j[l];
    if (i == j) continue;
    const double overlap = rows.overlap(i, j);
    if (!(overlap > 0)) continue;
    // Two grains of the radius r have r / 2 where these have r_i r_j / (r_i + r_j).
    const double radius = 2 * rows.radius(i) * rows.radius(j) / (rows.radius(i) + rows.radius(j));
    const std::array<std::int64_t, 2> k = rows.of(rows.group(i), rows.group(j), radius, overlap);
    add(k, sums[i]);
    add(k, sums[j]);
  }
  for (std::size_t l = 0; l < walls.i.size(); ++l) {
    const std::size_t i = walls.i[l], w = walls.j[l];
    if (w >= planes.size() || !planes[w].present) continue;
    const double overlap = rows.radius(i) - distance_from(planes[w], rows.x(i), quantum);
    if (!(overlap > 0)) continue;
    add(rows.of(rows.group(i), planes[w].group, 2 * rows.radius(i), overlap), sums[i]);
  }
  return sums;
}

}  // namespace sph

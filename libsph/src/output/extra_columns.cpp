#include "output/extra_columns.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "output/averages.hpp"
#include "output/tensor_order.hpp"
#include "sph/contact_records.hpp"

namespace sph {
namespace {

constexpr std::size_t stress_components = 6;
constexpr std::array<std::array<std::size_t, 2>, stress_components> axes{
    {{0, 0}, {1, 1}, {2, 2}, {0, 1}, {1, 2}, {0, 2}}};

std::vector<ExtraColumn> grain_columns() {
  return {{"stress", "Pa", static_cast<int>(stress_components), {}, components_in_files(3)},
          {"coordination", "1", 1, {}}};
}

/// stress and coordination of this rank's grains.
std::vector<ExtraColumn> grain_columns(const Simulation& s) {
  std::vector<ExtraColumn> columns = grain_columns();
  const std::size_t owned = s.particles().owned();
  const double quantum = s.grains()->torque_quantum();
  std::vector<std::int64_t> sums(stress_components * owned, 0);
  columns[1].values.assign(owned, 0.0);
  // Force and branch change sign together from one grain to the other: their product does not.
  const auto add = [&](std::uint32_t row, const ContactRecord& c, double arm) {
    if (row >= owned) return;
    columns[1].values[row] += 1;
    for (std::size_t k = 0; k < stress_components; ++k) {
      const auto [a, b] = axes[k];
      const double moment = 0.5 * arm * (c.force[a] * c.normal[b] + c.force[b] * c.normal[a]);
      sums[row * stress_components + k] += std::llrint(moment / quantum);
    }
  };
  for_each_contact(s, [&](const ContactRecord& c) {
    add(c.row, c, c.arm);
    if (!c.with_wall()) add(c.partner_row, c, c.partner_arm);
  });
  columns[0].values.resize(sums.size());
  for (std::size_t row = 0; row < owned; ++row) {
    const double r = s.particles().data<Field::radius>()[row];
    const double volume = 4.0 / 3.0 * std::numbers::pi * (r * r * r);
    for (std::size_t k = row * stress_components; k < (row + 1) * stress_components; ++k)
      columns[0].values[k] = static_cast<double>(sums[k]) * quantum / volume;
  }
  return columns;
}

}  // namespace

std::vector<ExtraColumn> extra_columns(const Scene& scene) {
  if (scene.output.average_space) return average_columns(scene);
  return scene.output.contacts ? grain_columns() : std::vector<ExtraColumn>{};
}

std::vector<ExtraColumn> extra_columns(Simulation& s) {
  if (s.scene().output.average_space) return averages(s);
  if (!s.scene().output.contacts) return {};
  s.refresh_contacts();
  return grain_columns(s);
}

ContactColumns contact_columns(const Simulation& s) {
  ContactColumns out;
  const Wrap wrap = s.wrap();
  const std::int64_t* x = s.particles().data<Field::position>();
  for_each_contact(s, [&](const ContactRecord& c) {
    if (!c.counted) return;
    out.id.push_back(c.id);
    out.partner.push_back(c.partner);
    out.overlap.push_back(c.overlap);
    for (std::size_t a = 0; a < 3; ++a) {
      // In quanta, so that a contact across a periodic face is wrapped exactly.
      const std::int64_t point = x[std::size_t{c.row} * 3 + a] + s.scale().quanta(c.arm * c.normal[a]);
      out.point.push_back(s.scale().metres(wrap(static_cast<int>(a), point)));
      out.force.push_back(c.force[a]);
    }
  });
  return out;
}

}  // namespace sph

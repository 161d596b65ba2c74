#include "output/extra_columns.hpp"

#include <array>
#include <cmath>
#include <numbers>

#include "files/tensor_order.hpp"
#include "output/averages.hpp"
#include "sph/output/contact_records.hpp"

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
  const Particles& grains = s.particles(s.grains()->set());
  const std::size_t owned = grains.owned();
  const double quantum = s.grains()->table().torque_quantum();
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
    const double r = grains.data<Field::radius>()[row];
    const double volume = 4.0 / 3.0 * std::numbers::pi * (r * r * r);
    for (std::size_t k = row * stress_components; k < (row + 1) * stress_components; ++k)
      columns[0].values[k] = static_cast<double>(sums[k]) * quantum / volume;
  }
  return columns;
}

/// Columns of one set, for the rows of all: 0 for the others.
void append(std::vector<ExtraColumn> of_set, const Simulation& s, std::size_t set,
            std::vector<ExtraColumn>& to) {
  std::size_t before = 0, all = 0;
  for (std::size_t k = 0; k < s.sets().size(); ++k) {
    if (k < set) before += s.particles(k).owned();
    all += s.particles(k).owned();
  }
  for (ExtraColumn& column : of_set) {
    const auto width = static_cast<std::size_t>(column.components);
    column.values.insert(column.values.begin(), before * width, 0.0);
    column.values.resize(all * width, 0.0);
    to.push_back(std::move(column));
  }
}

}  // namespace

std::vector<ExtraColumn> extra_columns(const Scene& scene) {
  std::vector<ExtraColumn> columns;
  if (scene.output.average_space) columns = average_columns(scene);
  if (scene.output.contacts)
    for (ExtraColumn& column : grain_columns()) columns.push_back(std::move(column));
  return columns;
}

std::vector<ExtraColumn> extra_columns(Simulation& s) {
  std::vector<ExtraColumn> columns;
  if (s.scene().output.contacts) s.refresh_contacts();  // may move rows
  if (s.scene().output.average_space) append(averages(s), s, s.physics()->set(), columns);
  if (s.scene().output.contacts) append(grain_columns(s), s, s.grains()->set(), columns);
  return columns;
}

ContactColumns contact_columns(const Simulation& s) {
  ContactColumns out;
  const Wrap wrap = s.wrap();
  const std::int64_t* x = s.particles(s.grains()->set()).data<Field::position>();
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

#include "sph/output/contact_records.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sph/laws/contact/law.hpp"

namespace sph {
namespace {

constexpr std::size_t lanes = ContactGroups::lanes;

double dot(const Double3& a, const Double3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

/// A contact before its law is asked.
struct Found {
  ContactRecord record;
  double radius, mass;    ///< of the pair, as in Contact
  double separation;      ///< speed at which they part [m/s]
  std::size_t groups[2];  ///< materials
  double turn;            ///< -1 where the list has the pair the other way round, else 1
};

class Enumeration {
 public:
  explicit Enumeration(const Simulation& s)
      : s_(s),
        grains_(*s.grains()),
        p_(s.particles(s.grains()->set())),
        x_(p_.data<Field::position>()),
        v_(p_.data<Field::velocity>()),
        radius_(p_.data<Field::radius>()),
        mass_(p_.data<Field::mass>()),
        id_(p_.data<Field::id>()),
        group_(p_.data<Field::group>()),
        planes_(grains_.walls().now(s.global())),
        quantum_(s.scale().quantum),
        law_(contact_law(s.scene())),
        history_(static_cast<std::size_t>(grains_.pairs().lists().history())),
        springs_(history_ - law_.history.size()) {}

  [[nodiscard]] std::optional<Found> pair(std::uint32_t i, std::uint32_t j) const {
    if (i == j) return std::nullopt;  // an unused lane
    const std::uint32_t a = id_[i] < id_[j] ? i : j, b = a == i ? j : i;
    Double3 way{};
    for (std::size_t k = 0; k < 3; ++k)
      way[k] = static_cast<double>(x_[b * 3 + k] - x_[a * 3 + k]) * quantum_;
    const double distance = std::sqrt(dot(way, way));
    const double overlap = radius_[a] + radius_[b] - distance;
    if (!(overlap > 0) || distance == 0) return std::nullopt;
    Found f{};
    f.record.id = id_[a];
    f.record.partner = id_[b];
    f.record.row = a;
    f.record.partner_row = b;
    f.record.counted = a < p_.owned();
    f.record.fixed = is_fixed(a) || is_fixed(b);
    f.record.overlap = overlap;
    f.record.arm = radius_[a] - 0.5 * overlap;
    f.record.partner_arm = radius_[b] - 0.5 * overlap;
    Double3 relative{};
    for (std::size_t k = 0; k < 3; ++k) {
      f.record.normal[k] = way[k] / distance;
      relative[k] = v_[b * 3 + k] - v_[a * 3 + k];
    }
    f.separation = dot(relative, f.record.normal);
    f.radius = radius_[a] * radius_[b] / (radius_[a] + radius_[b]);
    f.mass = mass_[a] * mass_[b] / (mass_[a] + mass_[b]);
    f.groups[0] = group_[a];
    f.groups[1] = group_[b];
    f.turn = a == i ? 1 : -1;
    return f;
  }

  [[nodiscard]] std::optional<Found> wall(std::uint32_t i, std::uint32_t w) const {
    if (w >= planes_.size() || !planes_[w].present) return std::nullopt;
    const PlaneNow& plane = planes_[w];
    double away = 0;
    Double3 relative{};
    Found f{};
    for (std::size_t k = 0; k < 3; ++k) {
      away += static_cast<double>(x_[i * 3 + k] - plane.point[k]) * plane.normal[k];
      f.record.normal[k] = -plane.normal[k];
      relative[k] = plane.velocity[k] - v_[i * 3 + k];
    }
    f.record.overlap = radius_[i] - away * quantum_;
    if (!(f.record.overlap > 0)) return std::nullopt;
    f.record.id = id_[i];
    f.record.partner = wall_key | w;
    f.record.row = i;
    f.record.partner_row = w;
    f.record.counted = true;
    f.record.fixed = is_fixed(i);
    f.record.arm = radius_[i] - f.record.overlap;
    f.separation = dot(relative, f.record.normal);
    f.radius = radius_[i];
    f.mass = mass_[i];
    f.groups[0] = group_[i];
    f.groups[1] = plane.group;
    f.turn = 1;
    return f;
  }

  /// Force and energy of the contact at `lane` of group `g`, by the law that moves it.
  void respond(Found& f, const ContactGroups& list, std::size_t g, std::size_t lane) const {
    const std::span<const double, 8> table = grains_.table()(f.groups[0], f.groups[1]);
    const auto stored = [&](std::size_t c) { return list.history[(g * history_ + c) * lanes + lane]; };
    std::array<double, most_history> memory{};
    for (std::size_t m = 0; m < law_.history.size(); ++m)
      memory[m] = (law_.history[m] == Parity::odd ? f.turn : 1.0) * stored(springs_ + m);
    const PointForce law = law_.respond({f.record.overlap, f.separation, f.radius, f.mass, s_.global().dt},
                                        table, memory.data());
    const double elastic = law.elastic;
    f.record.energy = law.energy;
    const auto spring = [&](std::size_t first, std::size_t c) {
      // + 0: a zero keeps no sign, since which of the two it got depended on the orientation of the pair.
      return f.turn * stored(first + c) + 0.0;
    };
    const auto add_energy = [&](std::size_t first, double change, double stiffness) {
      const Double3 t{change * spring(first, 0), change * spring(first, 1), change * spring(first, 2)};
      if (stiffness > 0) f.record.energy += 0.5 * dot(t, t) / stiffness;
    };
    Double3 t{};
    if (springs_ >= 3) {
      t = {spring(0, 0), spring(0, 1), spring(0, 2)};
      add_energy(0, law.shear_change, law.shear_stiffness);
    }
    if (springs_ >= 6) {
      const double reach = table[5] * f.radius;
      add_energy(3, law.rolling_change,
                 2.25 * elastic / f.record.overlap * (reach * reach));  // k_r of pairs/rolling.hpp
    }
    for (std::size_t c = 0; c < 3; ++c) f.record.force[c] = -(elastic * f.record.normal[c] + t[c]) + 0.0;
  }

 private:
  [[nodiscard]] bool is_fixed(std::uint32_t row) const { return s_.scene().groups[group_[row]].grain.fixed; }

  const Simulation& s_;
  const Grains& grains_;
  const Particles& p_;
  const std::int64_t* x_;
  const double *v_, *radius_, *mass_;
  const std::uint64_t* id_;
  const std::uint32_t* group_;
  std::vector<PlaneNow> planes_;
  double quantum_;
  const ContactLaw& law_;
  std::size_t history_, springs_;
};

}  // namespace

void for_each_contact(const Simulation& s, const std::function<void(const ContactRecord&)>& visit) {
  const Enumeration all(s);
  const ContactLists& lists = s.grains()->pairs().lists();
  for (const ContactGroups* list : {&lists.pairs(), &lists.walls()})
    for (std::size_t k = 0; k < list->i.size(); ++k) {
      std::optional<Found> found =
          list == &lists.walls() ? all.wall(list->i[k], list->j[k]) : all.pair(list->i[k], list->j[k]);
      if (!found) continue;
      all.respond(*found, *list, k / lanes, k % lanes);
      visit(found->record);
    }
}

}  // namespace sph

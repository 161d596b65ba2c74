#include "sph/output/contact_records.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "sph/laws/contact/law.hpp"
#include "sph/pairs/facet_contacts.hpp"

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

/// Columns of the grains.
struct GrainRows {
  explicit GrainRows(const Particles& p)
      : owned(p.owned()),
        x(p.data<Field::position>()),
        v(p.data<Field::velocity>()),
        radius(p.data<Field::radius>()),
        mass(p.data<Field::mass>()),
        id(p.data<Field::id>()),
        group(p.data<Field::group>()) {}
  std::size_t owned;
  const std::int64_t* x;
  const double *v, *radius, *mass;
  const std::uint64_t* id;
  const std::uint32_t* group;
};

class Enumeration {
 public:
  explicit Enumeration(const Simulation& s)
      : s_(s),
        grains_(*s.grains()),
        rows_(s.particles(s.grains()->set())),
        walls_(grains_.walls().now(s.global())),
        facets_(walls_, s.scale().quantum),
        quantum_(s.scale().quantum),
        law_(contact_law(s.scene())),
        history_(static_cast<std::size_t>(grains_.pairs().lists().history())),
        springs_(history_ - law_.history.size()) {}

  [[nodiscard]] std::optional<Found> pair(std::uint32_t i, std::uint32_t j) const {
    if (i == j) return std::nullopt;  // an unused lane
    const std::uint32_t a = rows_.id[i] < rows_.id[j] ? i : j, b = a == i ? j : i;
    Double3 way{};
    for (std::size_t k = 0; k < 3; ++k)
      way[k] = static_cast<double>(rows_.x[b * 3 + k] - rows_.x[a * 3 + k]) * quantum_;
    const double distance = std::sqrt(dot(way, way));
    const double overlap = rows_.radius[a] + rows_.radius[b] - distance;
    if (!(overlap > 0) || distance == 0) return std::nullopt;
    Found f{};
    f.record.id = rows_.id[a];
    f.record.partner = rows_.id[b];
    f.record.row = a;
    f.record.partner_row = b;
    f.record.counted = a < rows_.owned;
    f.record.fixed = is_fixed(a) || is_fixed(b);
    f.record.overlap = overlap;
    f.record.arm = rows_.radius[a] - 0.5 * overlap;
    f.record.partner_arm = rows_.radius[b] - 0.5 * overlap;
    Double3 relative{};
    for (std::size_t k = 0; k < 3; ++k) {
      f.record.normal[k] = way[k] / distance;
      relative[k] = rows_.v[b * 3 + k] - rows_.v[a * 3 + k];
    }
    f.separation = dot(relative, f.record.normal);
    f.radius = rows_.radius[a] * rows_.radius[b] / (rows_.radius[a] + rows_.radius[b]);
    f.mass = rows_.mass[a] * rows_.mass[b] / (rows_.mass[a] + rows_.mass[b]);
    f.groups[0] = rows_.group[a];
    f.groups[1] = rows_.group[b];
    f.turn = a == i ? 1 : -1;
    return f;
  }

  [[nodiscard]] std::optional<Found> wall(std::uint32_t i, std::uint32_t w) const {
    if (w >= walls_.planes.size() || !walls_.planes[w].present) return std::nullopt;
    const PlaneNow& plane = walls_.planes[w];
    const double away = distance_from(plane, rows_.x + i * std::size_t{3}, quantum_);
    Found f = beside(i, plane.normal, plane.velocity, rows_.radius[i] - away);
    if (!(f.record.overlap > 0)) return std::nullopt;
    f.record.partner = wall_key | w;
    f.record.partner_row = w;
    f.groups[1] = plane.group;
    return f;
  }

  /// All that there are of meshes, each with the entry that has its history.
  template <class Visit>
  void for_facets(const ContactLists& lists, Visit&& visit) {
    const ContactGroups& list = lists.walls();
    for (const FacetContact& c : facets_.look(list, GrainPlaces(s_.particles(grains_.set())))) {
      const std::uint32_t i = list.i[c.entry];
      Found f = beside(i, c.away, c.velocity, rows_.radius[i] - c.distance);
      f.record.partner = lists.numbers().key(list.j[c.entry]);
      f.record.partner_row = static_cast<std::uint32_t>(walls_.planes.size() + c.mesh);
      f.groups[1] = walls_.meshes[c.mesh].group;
      visit(f, c.from);
    }
  }

  /// Force and energy of the contact at `lane` of group `g`, by the law that moves it.
  void respond(Found& f, const ContactGroups& list, std::size_t g, std::size_t lane) const {
    const std::span<const double, 8> table = grains_.table()(f.groups[0], f.groups[1]);
    const auto stored = [&](std::size_t c) {
      return list.remembers(g) ? list.history_of(g, history_)[c * lanes + lane] : 0.0;
    };
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
  /// A grain and a wall whose surface is `away` from it.
  [[nodiscard]] Found beside(std::uint32_t i, const Double3& away, const Double3& velocity,
                             double overlap) const {
    Found f{};
    Double3 relative{};
    for (std::size_t k = 0; k < 3; ++k) {
      f.record.normal[k] = -away[k];
      relative[k] = velocity[k] - rows_.v[i * 3 + k];
    }
    f.record.overlap = overlap;
    f.record.id = rows_.id[i];
    f.record.row = i;
    f.record.counted = true;
    f.record.fixed = is_fixed(i);
    f.record.arm = rows_.radius[i] - overlap;
    f.separation = dot(relative, f.record.normal);
    f.radius = rows_.radius[i];
    f.mass = rows_.mass[i];
    f.groups[0] = rows_.group[i];
    f.turn = 1;
    return f;
  }
  [[nodiscard]] bool is_fixed(std::uint32_t row) const {
    return s_.scene().groups[rows_.group[row]].grain.fixed;
  }

  const Simulation& s_;
  const Grains& grains_;
  GrainRows rows_;
  WallsNow walls_;
  FacetContacts facets_;
  double quantum_;
  const ContactLaw& law_;
  std::size_t history_, springs_;
};

}  // namespace

void for_each_contact(const Simulation& s, const std::function<void(const ContactRecord&)>& visit) {
  Enumeration all(s);
  const ContactLists& lists = s.grains()->pairs().lists();
  all.for_facets(lists, [&](Found& found, std::size_t entry) {
    all.respond(found, lists.walls(), entry / lanes, entry % lanes);
    visit(found.record);
  });
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

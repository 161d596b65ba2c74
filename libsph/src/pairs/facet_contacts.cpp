#include "sph/pairs/facet_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace sph {
namespace {

constexpr std::size_t lanes = ContactGroups::lanes;

bool touched(const ContactGroups& list, std::size_t entry) {
  return (list.touching[entry / lanes] >> entry % lanes & 1U) != 0;
}

double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

std::span<const FacetContact> FacetContacts::look(const ContactGroups& list, std::size_t first,
                                                  std::size_t last, const GrainPlaces& grains) {
  begin_ = first * lanes;
  of_entry_.assign((last - first) * lanes, -1);
  found_.clear();
  for (std::size_t k = begin_; k < last * lanes;) {
    const std::uint32_t row = list.i[k];
    const std::size_t start = k;
    while (k < last * lanes && list.i[k] == row && numbers_.is_facet(list.j[k])) ++k;
    if (k == start)
      ++k;
    else
      look_at_row(list, start, k, grains.x(row).data(), grains.radius(row));
  }
  for (std::size_t n = 0; n < found_.size(); ++n)
    of_entry_[found_[n].entry - begin_] = static_cast<std::int32_t>(n);
  return found_;
}

const FacetContact* FacetContacts::at(std::size_t entry) const {
  const std::int32_t n = of_entry_[entry - begin_];
  return n < 0 ? nullptr : &found_[static_cast<std::size_t>(n)];
}

void FacetContacts::look_at_row(const ContactGroups& list, std::size_t first, std::size_t last,
                                const std::int64_t* x, double radius) {
  for (std::size_t k = first; k < last;) {
    const std::size_t mesh = numbers_.facet(list.j[k]).mesh, start = k;
    while (k < last && numbers_.facet(list.j[k]).mesh == mesh) ++k;
    if (meshes_[mesh].present) look_at_mesh(list, mesh, start, k, x, radius);
  }
}

void FacetContacts::look_at_mesh(const ContactGroups& list, std::size_t mesh, std::size_t first,
                                 std::size_t last, const std::int64_t* x, double radius) {
  const MeshNow& m = meshes_[mesh];
  const Point3 at = m.in_frame(x, quantum_);
  candidates_.clear();
  for (std::size_t k = first; k < last; ++k) {
    const std::uint32_t facet = list.j[k] - numbers_.first(mesh);
    const NearPoint near = m.surface->nearest(facet, at);
    if (near.square < radius * radius) candidates_.push_back({k, facet, near, true});
  }
  keep_nearest(m);
  const std::size_t found = found_.size();
  for (const Candidate& c : candidates_) {
    if (!c.kept) continue;
    add(m, mesh, c, at);
    const Point3& away = found_.back().away;
    const bool seen = std::any_of(found_.begin() + static_cast<std::ptrdiff_t>(found), found_.end() - 1,
                                  [&](const FacetContact& f) { return dot(f.away, away) > m.smooth_cosine; });
    if (seen) found_.pop_back();
  }
  find_histories(list, m, found);
}

/// An edge or vertex is a contact where no facet that has it is nearer, and then of the first of them.
void FacetContacts::keep_nearest(const MeshNow& mesh) {
  for (Candidate& c : candidates_) {
    if (c.near.of.is_face()) continue;
    c.kept = std::ranges::none_of(candidates_, [&](const Candidate& o) {
      return mesh.surface->has(o.facet, c.near.of) && (o.near.of != c.near.of || o.facet < c.facet);
    });
  }
  std::ranges::sort(candidates_, [](const Candidate& a, const Candidate& b) {
    return std::tie(a.near.square, a.facet) < std::tie(b.near.square, b.facet);
  });
}

void FacetContacts::add(const MeshNow& mesh, std::size_t number, const Candidate& c, const Point3& x) {
  FacetContact f{c.entry, c.entry, std::sqrt(c.near.square), {}, mesh.velocity, number};
  Point3 away = mesh.surface->normal(c.facet);
  if (f.distance > 0)
    for (std::size_t a = 0; a < 3; ++a) away[a] = (x[a] - c.near.point[a]) / f.distance;
  f.away = mesh.turned(away);
  const Point3 arm = mesh.turned(c.near.point), &w = mesh.spin;
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, d = (a + 2) % 3;
    f.velocity[a] += w[b] * arm[d] - w[d] * arm[b];
  }
  found_.push_back(f);
}

/// Of the contacts from number `found` on: those of entries that did not touch may go on with what another remembers that
/// touches no more, though its facet is still as near: how far the lists reach must not count.
void FacetContacts::find_histories(const ContactGroups& list, const MeshNow& mesh, std::size_t found) {
  const std::span<FacetContact> now = std::span(found_).subspan(found);
  for (FacetContact& f : now) {
    if (touched(list, f.entry)) continue;
    const std::uint32_t facet = list.j[f.entry] - numbers_.first(f.mesh);
    double best = -1;
    for (const Candidate& c : candidates_) {
      const auto is_in_use = [&](const FacetContact& o) { return o.entry == c.entry || o.from == c.entry; };
      if (!touched(list, c.entry) || std::ranges::any_of(now, is_in_use)) continue;
      const double same = std::fabs(dot(mesh.surface->normal(facet), mesh.surface->normal(c.facet)));
      if (same > best && (same >= mesh.smooth_cosine || mesh.surface->share_vertex(facet, c.facet))) {
        best = same;
        f.from = c.entry;
      }
    }
  }
}

void FacetContacts::hand_over(ContactGroups& list, std::size_t history) const {
  const auto place = [&](std::size_t entry) {
    return list.history.data() + entry / lanes * history * lanes + entry % lanes;
  };
  for (const FacetContact& f : found_) {
    if (f.from == f.entry) continue;
    double *from = place(f.from), *to = place(f.entry);
    for (std::size_t c = 0; c < history; ++c) {
      to[c * lanes] = from[c * lanes];
      from[c * lanes] = 0;
    }
    auto &old = list.touching[f.from / lanes], &now = list.touching[f.entry / lanes];
    old = static_cast<std::uint8_t>(old & ~(1U << f.from % lanes));
    now = static_cast<std::uint8_t>(now | 1U << f.entry % lanes);
  }
}

}  // namespace sph

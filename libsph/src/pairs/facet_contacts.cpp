#include "sph/pairs/facet_contacts.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "pairs/lies_beyond.hpp"

namespace sph {
namespace {

constexpr std::size_t lanes = ContactGroups::lanes;

bool touched(const ContactGroups& list, std::size_t entry) {
  return (list.touching[entry / lanes] >> entry % lanes & 1U) != 0;
}

/// Facets that come no nearer than this share of the radius beyond touch are left out until the grain has moved as far, less
/// what rounding may hide: of places in the frame, and of nearest points.
constexpr double margin = 0.02, rounding = 0.2;

double dot(const Point3& a, const Point3& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

}  // namespace

std::span<const FacetContact> FacetContacts::look(const ContactGroups& list, FacetRuns& facets,
                                                  const ContactBlock& block, const GrainPlaces& grains) {
  first_group_ = block.walls.first;
  touching_.assign(block.walls.last - block.walls.first, 0);
  of_entry_.resize(touching_.size() * lanes);
  found_.clear();
  for (FacetRun& run :
       std::span(facets.runs).subspan(block.facets.first, block.facets.last - block.facets.first)) {
    const MeshNow& mesh = meshes_[run.mesh];
    if (!mesh.present) continue;
    const std::size_t row = list.i[run.first];
    const Point3 at = mesh.in_frame(grains.x(row).data(), quantum_);
    const double radius = grains.radius(row), far = (1 - rounding) * margin * radius;
    std::uint32_t* const near = facets.near.data() + run.first;
    const Point3 way{at[0] - run.at[0], at[1] - run.at[1], at[2] - run.at[2]};
    if (!(dot(way, way) < far * far)) find_near(list, run, near, at, radius);  // at first it is no number
    if (run.near > 0) look_at_run(list, {near, run.near}, run.mesh, at, radius);
  }
  for (std::size_t n = 0; n < found_.size(); ++n) {
    const std::size_t entry = found_[n].entry - first_group_ * lanes;
    of_entry_[entry] = static_cast<std::uint32_t>(n);
    touching_[entry / lanes] = static_cast<std::uint8_t>(touching_[entry / lanes] | 1U << entry % lanes);
  }
  return found_;
}

std::span<const FacetContact> FacetContacts::look(const ContactGroups& list, const GrainPlaces& grains) {
  FacetRuns facets = list.facets;
  return look(list, facets, {0, 0, {}, {}, {0, list.groups()}, {0, facets.runs.size()}}, grains);
}

const FacetContact* FacetContacts::at(std::size_t entry) const {
  const std::size_t n = entry - first_group_ * lanes;
  return (touching_[n / lanes] >> n % lanes & 1U) == 0 ? nullptr : &found_[of_entry_[n]];
}

/// No distance changes by more than the grain moves in the frame.
void FacetContacts::find_near(const ContactGroups& list, FacetRun& run, std::uint32_t* near, const Point3& at,
                              double radius) const {
  const double reach = (1 + margin) * radius;
  run.near = 0;
  run.at = at;
  const TriangleSurface& surface = *meshes_[run.mesh].surface;
  for (std::size_t k = run.first; k < run.last; ++k) {
    const std::uint32_t facet = list.j[k] - numbers_.first(run.mesh);
    if (lies_beyond(surface, facet, at, reach)) continue;
    if (surface.nearest(facet, at).square < reach * reach) near[run.near++] = static_cast<std::uint32_t>(k);
  }
}

void FacetContacts::look_at_run(const ContactGroups& list, std::span<const std::uint32_t> near,
                                std::size_t mesh, const Point3& at, double radius) {
  const MeshNow& m = meshes_[mesh];
  candidates_.clear();
  for (const std::uint32_t k : near) {
    const std::uint32_t facet = list.j[k] - numbers_.first(mesh);
    if (lies_beyond(*m.surface, facet, at, radius)) continue;
    const NearPoint point = m.surface->nearest(facet, at);
    if (point.square < radius * radius) candidates_.push_back({k, facet, point, true});
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
  Point3 away;
  if (f.distance > 0)
    for (std::size_t a = 0; a < 3; ++a) away[a] = (x[a] - c.near.point[a]) / f.distance;
  else
    away = mesh.surface->normal(c.facet);
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
  const auto place = [&](std::size_t entry) { return list.remember(entry / lanes, history) + entry % lanes; };
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

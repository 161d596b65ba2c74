#include "start/start_overlaps.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numeric>

#include "files/agree.hpp"
#include "sph/pairs/facet_contacts.hpp"
#include "start/start_rows.hpp"

namespace sph {
namespace {

constexpr std::uint64_t nobody = ~std::uint64_t{0};

struct Overlap {
  std::uint64_t low = nobody, high = nobody;  ///< ids; of a wall its key
  double share = 0;                           ///< overlap in radii of the smaller grain
  [[nodiscard]] bool before(const Overlap& o) const { return low != o.low ? low < o.low : high < o.high; }
};

class Search {
 public:
  Search(const Scene& scene, const PositionScale& scale, const Particles& p)
      : scene_(scene),
        scale_(scale),
        particles_(p),
        owned_(p.owned()),
        id_(p.data<Field::id>()),
        x_(p.data<Field::position>()),
        radius_(p.data<Field::radius>()) {}

  /// The first of the pairs whose lower id this rank owns: another rank may not know all pairs of that grain.
  [[nodiscard]] Overlap first(const ContactLists& lists, const WallsNow& now) const {
    Overlap found;
    const ContactGroups &pairs = lists.pairs(), &walls = lists.walls();
    for (std::size_t k = 0; k < pairs.i.size(); ++k) keep(found, of_pair(pairs.i[k], pairs.j[k]));
    for (std::size_t k = 0; k < walls.i.size(); ++k)
      if (walls.j[k] < now.planes.size() && now.planes[walls.j[k]].present)
        keep(found, of_wall(walls.i[k], walls.j[k], now.planes[walls.j[k]]));
    FacetContacts facets(now, scale_.quantum);
    for (const FacetContact& f : facets.look(walls, GrainPlaces(particles_)))
      if (const std::size_t i = walls.i[f.entry]; i < owned_)
        keep(found, {id_[i], lists.numbers().key(walls.j[f.entry]), 1 - f.distance / radius_[i]});
    return found;
  }

 private:
  void keep(Overlap& found, const Overlap& o) const {
    if (o.share > scene_.grains.contact.largest_overlap && o.before(found)) found = o;
  }
  [[nodiscard]] Overlap of_pair(std::size_t i, std::size_t j) const {
    const std::size_t low = id_[i] < id_[j] ? i : j;
    if (i == j || low >= owned_) return {};
    double square = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double d = static_cast<double>(x_[i * 3 + a] - x_[j * 3 + a]) * scale_.quantum;
      square += d * d;
    }
    return {std::min(id_[i], id_[j]), std::max(id_[i], id_[j]),
            (radius_[i] + radius_[j] - std::sqrt(square)) / std::min(radius_[i], radius_[j])};
  }
  [[nodiscard]] Overlap of_wall(std::size_t i, std::uint32_t wall, const PlaneNow& plane) const {
    if (i >= owned_) return {};
    double away = 0;
    for (std::size_t a = 0; a < 3; ++a)
      away += static_cast<double>(x_[i * 3 + a] - plane.point[a]) * plane.normal[a];
    return {id_[i], wall_key | wall, 1 - away * scale_.quantum / radius_[i]};
  }

  const Scene& scene_;
  const PositionScale& scale_;
  const Particles& particles_;
  std::size_t owned_;
  const std::uint64_t* id_;
  const std::int64_t* x_;
  const double* radius_;
};

/// Where in the start's file these grains stand, "row 7", by reading it again; empty for a lattice.
std::array<std::string, 2> rows_of(const decomp::Comm& comm, const Scene& scene,
                                   std::array<std::uint64_t, 2> ids) {
  const std::string& tile = scene.start.tile.file;
  const std::string& file = tile.empty() ? scene.start.file : tile;
  std::array<std::string, 2> out;
  if (file.empty()) return out;
  const StartRows rows =
      tile.empty() ? read_rows(scene, file, comm.rank(), comm.size()) : read_rows(scene, file, 0, 1);
  std::vector<std::uint64_t> of_tile = rows.id;  // ascending: grain n of a copy is the n-th of them
  std::sort(of_tile.begin(), of_tile.end());
  for (std::size_t k = 0; k < 2; ++k) {
    if (ids[k] > largest_id) continue;
    const std::uint64_t wanted = tile.empty() ? ids[k] : of_tile[ids[k] % of_tile.size()];
    const auto at = std::find(rows.id.begin(), rows.id.end(), wanted);
    if (at == rows.id.end()) continue;
    out[k] = fmt::format("{} {}", rows.unit, rows.number[static_cast<std::size_t>(at - rows.id.begin())]);
    if (!tile.empty()) out[k] += fmt::format(" in copy {}", ids[k] / of_tile.size());
  }
  for (std::string& text : out) text = agree(comm, text);
  return out;
}

std::string advice(const Scene& scene, bool of_wall) {
  if (!scene.start.file.empty()) return "move them apart";
  if (!scene.start.fills.empty())
    return "raise start.grains.spacing, make it divide periods, or keep [[start.grains]] apart";
  if (of_wall && scene.start.tile.file.empty())
    return "keep start.lower and start.upper further from it, or lessen start.jitter";
  return scene.start.tile.file.empty() ? "raise start.spacing or lessen start.jitter"
                                       : "settle the tile with walls or periods where its copies meet";
}

/// Between which places along each axis the points of a lattice of grains lie; displaced, `shift` beyond.
struct Sites {
  double spacing, shift;
  Double3 first, last;
};

/// Of points in the middle of cells whose corner is at `origin`; one that rounding may leave out counts.
Sites sites_of(double spacing, double jitter, const Double3& origin, const Double3& lower,
               const Double3& upper) {
  constexpr double slack = 1e-6;
  Sites out{spacing, jitter * spacing, {}, {}};
  for (std::size_t a = 0; a < 3; ++a) {
    const auto before = [&](double x) { return (x - origin[a]) / spacing - 0.5; };
    out.first[a] = origin[a] + (std::ceil(before(lower[a]) - slack) + 0.5) * spacing;
    out.last[a] = origin[a] + (std::ceil(before(upper[a]) + slack) - 0.5) * spacing;
  }
  return out;
}

/// Of each other, across periods too, and of planes. The largest grains stand deepest.
bool may_overlap(const Scene& scene, const Sites& sites) {
  const double largest = 0.5 * scene.largest_diameter(), limit = scene.grains.contact.largest_overlap;
  double nearest = sites.spacing;
  for (std::size_t a = 0; a < 3; ++a) {
    const double period = scene.domain.upper[a] - scene.domain.lower[a];
    if (scene.domain.periodic[a]) nearest = std::min(nearest, period - (sites.last[a] - sites.first[a]));
  }
  if (nearest - 2 * std::sqrt(3.0) * sites.shift < (2 - limit) * largest) return true;
  return std::ranges::any_of(scene.grains.walls, [&](const Wall& wall) {
    double away = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double n = wall.normal[a];
      away += n * ((n > 0 ? sites.first[a] : sites.last[a]) - wall.point[a]) - std::fabs(n) * sites.shift;
    }
    return away < (1 - limit) * largest;
  });
}

}  // namespace

bool may_overlap(const Scene& scene) {
  const Start& start = scene.start;
  if (!start.file.empty() || !start.tile.file.empty() || !scene.grains.meshes.empty()) return true;
  const LatticeFill& l = start.lattice;
  if (start.fills.empty() && l.kind != LatticeKind::square)
    return may_overlap(scene, Sites{start.spacing, l.jitter * start.spacing, l.lower, l.upper});
  if (start.fills.empty())
    return may_overlap(scene, sites_of(start.spacing, l.jitter, l.origin, l.lower, l.upper));
  if (start.fills.size() > 1) return true;  // a fill knows nothing of another
  const GrainFill& f = start.fills.front();
  return may_overlap(scene, sites_of(f.spacing, f.jitter, f.lower, f.lower, f.upper));
}

void refuse_overlaps(const decomp::Comm& comm, const Scene& scene, const PositionScale& scale,
                     const Particles& particles, const ContactLists& lists, const WallsNow& walls) {
  const Overlap mine = Search(scene, scale, particles).first(lists, walls);
  constexpr std::int64_t none = std::numeric_limits<std::int64_t>::max();
  const std::int64_t own = mine.low == nobody ? none : static_cast<std::int64_t>(mine.low);
  const std::int64_t lowest = -comm.max(-own);
  if (lowest == none) return;
  std::array<std::uint64_t, 2> ids{own == lowest ? mine.low : 0, own == lowest ? mine.high : 0};
  comm.sum(std::span<std::uint64_t>(ids));  // one rank owns the lowest
  const std::array<std::string, 2> rows = rows_of(comm, scene, ids);
  std::string what;
  if (own == lowest) {
    const auto named = [&](std::size_t k) {
      return fmt::format("grain {}{}", ids[k], rows[k].empty() ? "" : " (" + rows[k] + ")");
    };
    if (mine.high > largest_id)
      what = fmt::format("{} lies {:.3g} radii deep in {}", named(0), mine.share,
                         text_of_partner(scene, mine.high));
    else
      what = fmt::format("{} and {} overlap by {:.3g} radii", named(0), named(1), mine.share);
    what += fmt::format("; contact.largest_overlap allows {}: {}", scene.grains.contact.largest_overlap,
                        advice(scene, mine.high > largest_id));
  }
  const std::string& file = scene.start.tile.file.empty() ? scene.start.file : scene.start.tile.file;
  const std::string of_scene = scene.file + (scene.start.fills.empty() ? ": start" : ": start.grains");
  throw InputError(fmt::format("{}: {}", file.empty() ? of_scene : file, agree(comm, what)));
}

}  // namespace sph

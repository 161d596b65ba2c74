// Where bonds see the particles of clamps, and what these give back of the forces on them (terms/clamp.hpp).
#include "models/clamps.hpp"

#include <cmath>

#include "pairs/for_rows.hpp"
#include "sph/terms/bonds.hpp"
#include "sph/terms/clamp.hpp"
#include "sph/terms/crack.hpp"

namespace sph {
namespace {

/// k / sum W of a particle with these sums, 0 where nothing is bonded to it.
double share_of(const double* sums, std::size_t d, const WallMirror& mirror) {
  if (!(sums[0] > 0)) return 0;
  double square = 0;
  for (std::size_t a = 0; a < d; ++a) square += sums[1 + d + a] * sums[1 + d + a];
  return mirror(std::sqrt(square) / sums[0], sums[0]) / sums[0];
}

struct Shifts {
  static constexpr FieldSet reads{Field::clamp_sums};
  static constexpr FieldSet writes{Field::clamp_shift};
  double h;
  std::shared_ptr<const WallMirror> mirror;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double* sums = p.get<Field::clamp_sums>();
    double* shift = p.get<Field::clamp_shift>();
    for_walls(step.ranges, [&](std::size_t i) {
      const double* s = sums + i * (1 + 2 * d);
      const double share = share_of(s, d, *mirror);
      for (std::size_t a = 0; a < d; ++a) shift[i * d + a] = -share * h * s[1 + a];
    });
  }
};

struct Reactions {
  static constexpr FieldSet reads{Field::clamp_sums, Field::force};
  static constexpr FieldSet writes{Field::clamp_reaction};
  std::shared_ptr<const WallMirror> mirror;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double *sums = p.get<Field::clamp_sums>(), *force = p.get<Field::force>();
    double* reaction = p.get<Field::clamp_reaction>();
    for_walls(step.ranges, [&](std::size_t i) {
      const double share = share_of(sums + i * (1 + 2 * d), d, *mirror);
      for (std::size_t a = 0; a < d; ++a) reaction[i * d + a] = -share * force[i * d + a];
    });
  }
};

struct AddReactions {
  static constexpr FieldSet reads{Field::clamp_push};
  static constexpr FieldSet writes{Field::force};

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double* push = p.get<Field::clamp_push>();
    double* force = p.get<Field::force>();
    for_movers(step.ranges, [&](std::size_t i) {
      for (std::size_t a = 0; a < d; ++a) force[i * d + a] += push[i * d + a];
    });
  }
};

}  // namespace

Clamps::Clamps(const Scene& scene) : mirror_(std::make_shared<const WallMirror>(scene, scene.bond_width())) {}

void Clamps::add_shifts(Builder& b) const {
  b.add_fields({Field::clamp_shift});
  b.add_sums("clamps", {term<ClampSums>}, Builder::Rows::walls);
  b.add_update("shifts of clamps", Shifts{b.scene().bond_width(), mirror_});
}

void Clamps::add_reactions(Builder& b) const {
  b.add_fields({Field::clamp_reaction});
  b.add_sums("forces on clamps", {has_failure(b.scene()) ? term<CrackedBondForce> : term<BondForce>},
             Builder::Rows::walls);
  b.add_update("reactions of clamps", Reactions{mirror_});
  b.add_sums("reactions", {term<ClampReaction>});
  b.add_update("forces of clamps", AddReactions{});
}

}  // namespace sph

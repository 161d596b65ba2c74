// What the cells of melts begin with.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "scene/painting.hpp"
#include "sph/core/exact_math.hpp"
#include "sph/core/findings.hpp"
#include "sph/models/melt.hpp"
#include "sph/scene/melt_grid.hpp"

namespace sph {
namespace {

constexpr int samples = 4;  // along each axis of a cell

/// Where what is at x would be without the start's wave, within the domain.
Double3 without_wave(const Scene& scene, Double3 x) {
  const MeltControl& m = scene.domain.melt;
  const auto up = static_cast<std::size_t>(scene.dim) - 1;
  if (m.start.wave_height != 0) {
    double wave = m.start.wave_height;
    for (std::size_t a = 0; a < up; ++a)
      wave *= exact_cos(2 * std::numbers::pi / m.start.wave_length * (x[a] - scene.domain.lower[a]));
    x[up] -= wave;
  }
  const double inside = 1e-6 * scene.start.spacing;
  x[up] = std::clamp(x[up], scene.domain.lower[up], scene.domain.upper[up] - inside);
  return x;
}

/// Of the domain, as a share.
double height_of(const Scene& scene, const Double3& x) {
  const auto up = static_cast<std::size_t>(scene.dim) - 1;
  return (x[up] - scene.domain.lower[up]) / (scene.domain.upper[up] - scene.domain.lower[up]);
}

/// Of what is conducted between two sides.
double conducted(const Scene& scene, const Double3& x) {
  const auto up = static_cast<std::size_t>(scene.dim) - 1;
  std::array<double, 2> at{};
  for (const MeltSide& s : scene.domain.melt.sides)
    if (static_cast<std::size_t>(s.side) / 2 == up && s.temperature)
      at[static_cast<std::size_t>(s.side) % 2] = *s.temperature;
  return at[0] + (at[1] - at[0]) * height_of(scene, x);
}

/// Means over a cell about `centre`.
struct CellMeans {
  double temperature = 0, composition = 0;
};
CellMeans means_of(const Scene& scene, const std::array<double, 3>& edge, const Double3& centre) {
  CellMeans sum;
  int count = 0;
  const auto [first, last] = melts_of(scene);
  const std::size_t second = first == last ? scene.groups.size() : last;
  const int deep = scene.dim == 3 ? samples : 1;
  for (int z = 0; z < deep; ++z)
    for (int y = 0; y < samples; ++y)
      for (int x = 0; x < samples; ++x, ++count) {
        const std::array<int, 3> k{x, y, z};
        Double3 at = centre;
        for (std::size_t a = 0; a < static_cast<std::size_t>(scene.dim); ++a)
          at[a] += edge[a] * ((k[a] + 0.5) / samples - 0.5);
        at = without_wave(scene, at);
        const int group = painted_group(scene, at);
        if (group < 0)
          throw InputError(scene.file + ": start.region: paints no melt " +
                           place_text(std::span(at).first(static_cast<std::size_t>(scene.dim))) +
                           "; begin with one of shape \"everywhere\"");
        sum.temperature += scene.domain.melt.start.profile == MeltProfile::conductive
                               ? conducted(scene, at)
                               : scene.groups[static_cast<std::size_t>(group)].heat.temperature.value_or(0);
        if (scene.domain.melt.start.mixture == MeltMixture::linear)
          sum.composition += height_of(scene, at);
        else
          sum.composition += static_cast<std::size_t>(group) == second ? 1 : 0;
      }
  return {sum.temperature / count, sum.composition / count};
}

}  // namespace

double Melt::start(const decomp::Comm&, Particles& cells, GlobalState&) {
  const auto d = static_cast<std::size_t>(scene_->dim);
  const std::array<double, 3> edge = melt_grid(*scene_).edge;
  double* temperature = cells.data<Field::temperature>();
  double* composition = cells.data<Field::composition>();
  for (std::size_t i = 0; i < cells.owned(); ++i) {
    Double3 centre{};
    for (std::size_t a = 0; a < d; ++a) centre[a] = scale_.metres(cells.data<Field::position>()[i * d + a]);
    const CellMeans means = means_of(*scene_, edge, centre);
    if (temperature != nullptr) temperature[i] = means.temperature;
    if (composition != nullptr) composition[i] = means.composition;
    cells.data<Field::melt_share>()[i] = 1;
    cells.data<Field::flow_pressure>()[i] = 0;
  }
  return scene_->time.dt.value_or(any_step);
}

}  // namespace sph

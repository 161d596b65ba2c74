#include "start/start_sounds.hpp"

#include <algorithm>
#include <cmath>

#include "sph/laws/eos/law.hpp"
#include "start/initial_fields.hpp"

namespace sph {
namespace {

double sound_at(const Group& g, double density) {
  double pressure, sound;
  g.eos.law->derive(g, {&density, nullptr, nullptr, nullptr, &pressure, &sound, nullptr, 0}, 0, 1);
  return sound;
}

/// Where the pressure of a start is largest: at this height against gravity, or between Taylor's vortices.
Double3 most_pressed(const Scene& scene, double low) {
  if (scene.start.pressure == InitialPressure::taylor_green) {
    const double quarter = 0.25 * scene.start.velocity.flow_length;
    return {quarter, quarter, 0};
  }
  Double3 x{};
  double g2 = 0;
  for (std::size_t a = 0; a < 3; ++a)
    g2 += scene.domain.periodic[a] ? 0.0 : scene.domain.gravity[a] * scene.domain.gravity[a];
  if (g2 == 0) return x;
  for (std::size_t a = 0; a < 3; ++a)
    x[a] = scene.domain.periodic[a] ? 0.0 : -low * scene.domain.gravity[a] / std::sqrt(g2);
  return x;
}

}  // namespace

bool stiffens(const Group& g) {
  return g.kind != GroupKind::grain && g.eos.law->kind == EosKind::barotropic && !g.eos.law->constant_sound;
}

bool is_quiet(const Scene& scene, const Group& group) {
  return is_rigid(group) && scene.has_kind(GroupKind::fluid) && !has_body_contacts(scene);
}

std::vector<double> sounds_at_rest(const Scene& scene) {
  std::vector<double> sounds;
  for (const Group& g : scene.groups)
    sounds.push_back(g.kind == GroupKind::grain || is_quiet(scene, g) ? 0.0 : sound_at_rest(g));
  return sounds;
}

std::vector<double> fastest_sounds(const decomp::Comm& comm, const Scene& scene, const Particles& particles) {
  std::vector<double> sounds = sounds_at_rest(scene);
  if (std::ranges::none_of(scene.groups, stiffens)) return sounds;
  const double* density = particles.data<Field::density>();
  const double* porosity = particles.data<Field::porosity>();
  const auto* group = particles.data<Field::group>();
  for (std::size_t i = 0; i < particles.owned(); ++i) {
    const Group& g = scene.groups[group[i]];
    if (!stiffens(g) || g.kind == GroupKind::wall) continue;
    sounds[group[i]] =
        std::max(sounds[group[i]], sound_at(g, porosity == nullptr ? density[i] : density[i] / porosity[i]));
  }
  comm.max(std::span<double>(sounds));
  return sounds;
}

std::vector<double> fastest_sounds(const Scene& scene, const std::vector<Height>& heights) {
  std::vector<double> sounds = sounds_at_rest(scene);
  if (heights.empty() || std::ranges::none_of(scene.groups, stiffens)) return sounds;
  const InitialFields fields(scene);
  for (std::size_t g = 0; g < scene.groups.size(); ++g) {
    if (!stiffens(scene.groups[g]) || scene.groups[g].kind == GroupKind::wall) continue;
    if (!(heights[g].low <= heights[g].high)) continue;
    NewParticle p{};
    p.group = static_cast<std::uint32_t>(g);
    p.position = most_pressed(scene, heights[g].low);
    fields.set(p);
    if (p.density > 0) sounds[g] = std::max(sounds[g], sound_at(scene.groups[g], p.density));
  }
  return sounds;
}

}  // namespace sph

#include "sph/models/insertions.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <span>
#include <unordered_map>

#include "core/random.hpp"
#include "sph/core/error.hpp"
#include "sph/core/findings.hpp"
#include "sph/models/grain_limits.hpp"
#include "sph/scene/grain_mass.hpp"
#include "start/initial_fields.hpp"

namespace sph {
namespace {

constexpr int most_attempts = 200;

struct Ball {
  Double3 centre;  ///< from the box's lower corner [m]
  double radius;
};

/// Balls in a box, and images of them, in cells as wide as the largest.
class Packing {
 public:
  Packing(const Double3& extent, const Double3& period, double widest)
      : extent_(extent), period_(period), edge_(widest) {}

  /// With those of its images that may touch what is in the box.
  void add(const Ball& ball) {
    std::array<int, 3> first{}, last{};
    for (std::size_t a = 0; a < 3; ++a)
      if (period_[a] > 0) first[a] = -1, last[a] = 1;
    for (int i = first[0]; i <= last[0]; ++i)
      for (int j = first[1]; j <= last[1]; ++j)
        for (int k = first[2]; k <= last[2]; ++k) {
          Ball image = ball;
          bool near = true;
          const std::array<int, 3> shift{i, j, k};
          for (std::size_t a = 0; a < 3; ++a) {
            image.centre[a] += shift[a] * period_[a];
            near = near && image.centre[a] > -edge_ && image.centre[a] < extent_[a] + edge_;
          }
          if (near) cells_[key(cell(image.centre))].push_back(image);
        }
  }
  /// Deeper than that much of the smaller radius.
  [[nodiscard]] bool touches(const Ball& ball, double deeper = 0) const {
    const std::array<std::int64_t, 3> c = cell(ball.centre);
    for (std::int64_t i = c[0] - 1; i <= c[0] + 1; ++i)
      for (std::int64_t j = c[1] - 1; j <= c[1] + 1; ++j)
        for (std::int64_t k = c[2] - 1; k <= c[2] + 1; ++k) {
          const auto found = cells_.find(key({i, j, k}));
          if (found == cells_.end()) continue;
          for (const Ball& other : found->second) {
            double square = 0;
            for (std::size_t a = 0; a < 3; ++a)
              square += (other.centre[a] - ball.centre[a]) * (other.centre[a] - ball.centre[a]);
            const double reach = other.radius + ball.radius - deeper * std::min(other.radius, ball.radius);
            if (square < reach * reach) return true;
          }
        }
    return false;
  }

 private:
  [[nodiscard]] std::array<std::int64_t, 3> cell(const Double3& x) const {
    std::array<std::int64_t, 3> c;
    for (std::size_t a = 0; a < 3; ++a) c[a] = static_cast<std::int64_t>(std::floor(x[a] / edge_));
    return c;
  }
  /// Cells along an axis are less than 2^20.
  static std::int64_t key(const std::array<std::int64_t, 3>& c) {
    return ((c[0] + 2) << 42) + ((c[1] + 2) << 21) + c[2] + 2;
  }

  Double3 extent_, period_;
  double edge_;
  std::unordered_map<std::int64_t, std::vector<Ball>> cells_;
};

bool touches(const WallsNow& walls, const std::array<std::int64_t, 3>& x, double radius, double quantum) {
  for (const PlaneNow& plane : walls.planes)
    if (plane.present && distance_from(plane, x.data(), quantum) < radius) return true;
  std::vector<std::uint32_t> facets;
  for (const MeshNow& mesh : walls.meshes) {
    if (!mesh.present) continue;
    facets.clear();
    mesh.surface->find(mesh.in_frame(x.data(), quantum), radius, facets);
    if (!facets.empty()) return true;
  }
  return false;
}

/// Up to when what comes in has its turn before a step that begins so.
double paid(const Insertion& in, std::int64_t step, double time) {
  return step == 0 ? 0 : (std::floor(time / in.every) + 1) * in.every;
}

/// A box in the domain, in quanta.
struct Place {
  std::array<std::int64_t, 3> corner;
  Double3 extent, period;  ///< [m]; 0 without one
  double widest;           ///< grain of the scene

  [[nodiscard]] Ball ball(const PositionScale& scale, const std::array<std::int64_t, 3>& x,
                          double radius) const {
    Ball out{{}, radius};
    for (std::size_t a = 0; a < 3; ++a) out.centre[a] = scale.metres(x[a] - corner[a]);
    return out;
  }
  /// Some image of it may touch what is in the box.
  [[nodiscard]] bool reaches(const Double3& x) const {
    for (std::size_t a = 0; a < 3; ++a) {
      const auto near = [&](double at) { return at > -widest && at < extent[a] + widest; };
      if (!near(x[a]) && !(period[a] > 0 && (near(x[a] - period[a]) || near(x[a] + period[a])))) return false;
    }
    return true;
  }
};

/// A diameter's half may be rounded away from the group's, from single precision even.
double radius_in(const Group& group, double radius) {
  const double nearest = std::clamp(radius, group.grain.least_radius, group.grain.largest_radius);
  return std::fabs(nearest - radius) <= 1e-6 * nearest ? nearest : radius;
}

/// What is wrong with it, in itself; empty if nothing is.
std::string fault_of(const Scene& scene, const GivenGrain& given, double dt) {
  const Group& group = scene.groups[given.group];
  const double least = group.grain.least_radius, largest = group.grain.largest_radius;
  const double radius = radius_in(group, given.radius);
  if (!(radius >= least && radius <= largest && largest > 0) || group.grain.fixed)
    return largest > 0 && !group.grain.fixed
               ? fmt::format("its radius is {:.6g} m; grains of \"{}\" have {:.6g} to {:.6g} m", given.radius,
                             group.name, least, largest)
               : fmt::format("\"{}\" is no group of grains that move", group.name);
  for (std::size_t a = 0; a < 3; ++a)
    if (!(given.position[a] >= scene.domain.lower[a] && given.position[a] < scene.domain.upper[a]))
      return fmt::format("it is outside the domain, {}", place_text(given.position));
  const double speed = speed_of(given.velocity);
  if (!(speed * dt <= longest_grain_move(scene)))
    return fmt::format("of {:.6g} m/s {}", speed, grain_move_text(scene, speed * dt));
  return {};
}

/// The smallest box with these places, which are within the periods.
Place place_around(std::span<const InsertedGrain> grains, const Scene& scene, const PositionScale& scale,
                   const Wrap& wrap) {
  Place place{grains.front().position, {}, {}, scene.largest_diameter()};
  std::array<std::int64_t, 3> last = place.corner;
  for (const InsertedGrain& grain : grains)
    for (std::size_t a = 0; a < 3; ++a) {
      place.corner[a] = std::min(place.corner[a], grain.position[a]);
      last[a] = std::max(last[a], grain.position[a]);
    }
  for (std::size_t a = 0; a < 3; ++a) {
    place.extent[a] = scale.metres(last[a] - place.corner[a]);
    place.period[a] = scale.metres(wrap.period[a]);
  }
  return place;
}

/// The grains of all ranks that may touch what is in the box.
std::vector<Ball> balls_near(const decomp::Comm& comm, const Place& place, const PositionScale& scale,
                             const Wrap& wrap, const Particles& p, const std::vector<bool>& stays) {
  std::vector<Ball> mine;
  const std::int64_t* x = p.data<Field::position>();
  for (std::size_t i = 0; i < p.owned(); ++i) {
    if (!stays[i]) continue;
    std::array<std::int64_t, 3> at;
    for (std::size_t a = 0; a < 3; ++a) at[a] = wrap(static_cast<int>(a), x[i * 3 + a]);
    const Ball ball = place.ball(scale, at, p.data<Field::radius>()[i]);
    if (place.reaches(ball.centre)) mine.push_back(ball);
  }
  const std::vector<std::byte> all =
      decomp::gather_everywhere(comm, std::as_bytes(std::span<const Ball>(mine)));
  std::vector<Ball> out(all.size() / sizeof(Ball));
  std::memcpy(out.data(), all.data(), all.size());
  return out;
}

}  // namespace

double speed_of(const Double3& velocity) {
  double square = 0;
  for (const double v : velocity) square += v * v;
  return std::sqrt(square);
}

double Insertions::due(std::size_t insertion, const GlobalState& before) const {
  const Insertion& in = scene_->domain.openings.insertions[insertion];
  const double from = paid(in, before.step, before.time),
               to = paid(in, before.step + 1, before.time + before.dt);
  return to > from ? integral_of(in.rate, to) - integral_of(in.rate, from) : 0.0;
}

std::vector<InsertedGrain> Insertions::choose(const decomp::Comm& comm, std::size_t insertion,
                                              const Particles& p, const std::vector<bool>& stays,
                                              std::span<const InsertedGrain> earlier, const WallsNow& walls,
                                              std::uint64_t first_id, std::int64_t step, double& due) const {
  const Scene& scene = *scene_;
  const Insertion& in = scene.domain.openings.insertions[insertion];
  const Group& group = scene.groups[static_cast<std::size_t>(in.group)];
  Place place{{}, {}, {}, scene.largest_diameter()};
  for (std::size_t a = 0; a < 3; ++a) {
    place.corner[a] = scale_.quanta(in.lower[a]);
    place.extent[a] = in.upper[a] - in.lower[a];
    place.period[a] = scale_.metres(wrap_.period[a]);
  }
  Packing packing(place.extent, place.period, place.widest);
  for (const Ball& there : balls_near(comm, place, scale_, wrap_, p, stays)) packing.add(there);
  for (const InsertedGrain& grain : earlier) {
    const Ball there = place.ball(scale_, grain.position, grain.radius);
    if (place.reaches(there.centre)) packing.add(there);
  }

  std::vector<InsertedGrain> chosen;
  const std::uint64_t seed = decomp::splitmix_mix(scene.start.seed + 1) + static_cast<std::uint64_t>(step);
  for (;;) {
    NewParticle drawn{first_id + chosen.size(), {}, {}, static_cast<std::uint32_t>(in.group), 0, 0};
    InsertedGrain grain{drawn.id, drawn.group, {}, in.velocity, random_radius(scene, drawn), 0};
    grain.mass = grain_mass(group.density, grain.radius);
    if (!(due >= 0.5 * grain.mass)) return chosen;
    bool placed = false;
    for (int attempt = 1; attempt <= most_attempts && !placed; ++attempt) {
      const std::uint64_t of_attempt =
          decomp::splitmix_mix(seed + decomp::splitmix_stride * static_cast<std::uint64_t>(attempt));
      for (std::size_t a = 0; a < 3; ++a) {
        const double u = 0.5 * (uniform_minus_one_to_one(of_attempt, grain.id, a) + 1);
        grain.position[a] =
            scale_.quanta(in.lower[a] + grain.radius + (place.extent[a] - 2 * grain.radius) * u);
      }
      const Ball at = place.ball(scale_, grain.position, grain.radius);
      placed = !packing.touches(at) && !sph::touches(walls, grain.position, grain.radius, scale_.quantum);
      if (placed) packing.add(at);
    }
    if (!placed) {
      due = 0;
      return chosen;
    }
    chosen.push_back(grain);
    due -= grain.mass;
  }
}

std::vector<InsertedGrain> Insertions::take(const decomp::Comm& comm, std::span<const GivenGrain> given,
                                            const Particles& p, const std::vector<bool>& stays,
                                            const WallsNow& walls, std::uint64_t first_id, double dt) const {
  const auto refuse = [&](std::size_t k, const std::string& why) {
    if (!why.empty()) throw InputError(fmt::format("add: grain {} of {}: {}", k + 1, given.size(), why));
  };
  std::vector<InsertedGrain> out;
  for (const GivenGrain& g : given) {
    const std::size_t k = out.size();
    refuse(k, fault_of(*scene_, g, dt));
    const Group& group = scene_->groups[g.group];
    InsertedGrain grain{first_id + k, g.group, {}, g.velocity, radius_in(group, g.radius), 0};
    grain.mass = grain_mass(group.density, grain.radius);
    for (std::size_t a = 0; a < 3; ++a)
      grain.position[a] = wrap_(static_cast<int>(a), scale_.quanta(g.position[a]));
    out.push_back(grain);
  }
  if (out.empty()) return out;
  const Place place = place_around(out, *scene_, scale_, wrap_);
  Packing packing(place.extent, place.period, place.widest);
  for (const Ball& there : balls_near(comm, place, scale_, wrap_, p, stays)) packing.add(there);
  const double most = scene_->grains.contact.largest_overlap;
  for (std::size_t k = 0; k < out.size(); ++k) {
    const Ball ball = place.ball(scale_, out[k].position, out[k].radius);
    if (packing.touches(ball, most) ||
        touches(walls, out[k].position, (1 - most) * out[k].radius, scale_.quantum))
      refuse(k, fmt::format("{} it lies deeper in another grain or in a wall than contact.largest_overlap "
                            "allows, {} radii",
                            place_text(given[k].position), most));
    packing.add(ball);
  }
  return out;
}

}  // namespace sph

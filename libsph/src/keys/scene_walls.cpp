// [[wall]]: planes, one by one or as the sides of a box.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include "keys/scene_resolve.hpp"

namespace sph {
namespace {

using WallReader = Reader<keys::wall>;

constexpr std::array axis_names{"x", "y", "z"};

/// The corner of the domain furthest along the normal must be in front of the plane.
void check_plane(const WallReader& table, const Scene& scene, const Wall& wall) {
  double room = 0;
  for (std::size_t a = 0; a < 3; ++a) {
    if (scene.domain.periodic[a] && wall.normal[a] != 0)
      table.fail("normal", fmt::format("points along {}, which is periodic", axis_names[a]),
                 "a wall must be the same in every period: make its normal 0 there");
    room += ((wall.normal[a] > 0 ? scene.domain.upper[a] : scene.domain.lower[a]) - wall.point[a]) *
            wall.normal[a];
  }
  if (!(room > 0))
    table.fail("point", "leaves the whole domain behind the wall",
               "grains stay on the side to which the normal points: move it or turn the normal round");
}

/// Prescribed velocity or servo. Gain and largest speed alone are for a servo that a stage begins.
void read_drive(const WallReader& table, Wall& wall) {
  table.not_both("velocity", "force");
  wall.velocity = table.vector("velocity").value_or(Double3{});
  const bool gain = wall.servo_gain > 0, speed = wall.largest_speed > 0;
  const bool servo = wall.force || gain || speed;
  if (servo && !gain)
    table.fail_missing("servo_gain", "a servo needs it: speed of the wall per excess of force, in m/s/N");
  if (servo && !speed) table.fail_missing("largest_speed", "a servo needs it, in m/s");
}

Wall read_plane(const WallReader& table, const Scene& scene, Wall wall) {
  const std::optional<Double3> normal = unit_vector(wall.normal);
  if (!normal) table.fail("normal", "has no direction", "it points to the side of the grains");
  wall.normal = *normal;
  check_plane(table, scene, wall);
  read_drive(table, wall);
  return wall;
}

/// `open` as a bit per side: x0, x1, y0, ...
unsigned read_open(const WallReader& table, const std::vector<std::string>& sides) {
  const toml_tree::Node* value = table.find("open");
  if (value == nullptr) return 0;
  const toml_tree::Array* names = value->array();
  if (names == nullptr)
    table.fail("open", fmt::format("is {}", type_name(*value)), "it must be an array like [\"z1\"]");
  unsigned open = 0;
  for (const toml_tree::Node& n : *names) {
    const auto* name = std::get_if<std::string>(&n.value);
    if (name == nullptr)
      table.fail("open", fmt::format("holds {}", type_name(n)), "it must be an array like [\"z1\"]");
    const auto at = std::find(sides.begin(), sides.end(), *name);
    if (at == sides.end())
      table.fail("open", fmt::format("names \"{}\", which is no side of the box", *name),
                 fmt::format("its sides, on axes without period: {}", fmt::join(sides, ", ")));
    open |= 1U << (at - sides.begin());
  }
  return open;
}

std::vector<Wall> read_box(const WallReader& table, const Scene& scene, const Wall& like) {
  const Double3 lower = *table.vector("lower"), upper = *table.vector("upper");
  std::vector<std::string> sides;
  std::vector<Wall> planes;
  for (std::size_t a = 0; a < 3; ++a) {
    if (!(lower[a] < upper[a]))
      table.fail("upper", fmt::format("is not above lower in {}", axis_names[a]), "the box is empty");
    if (lower[a] < scene.domain.lower[a] || upper[a] > scene.domain.upper[a])
      table.fail(lower[a] < scene.domain.lower[a] ? WallReader::Name<>("lower") : WallReader::Name<>("upper"),
                 fmt::format("lies outside the domain in {}", axis_names[a]),
                 "a box must lie between domain.lower and domain.upper");
    if (scene.domain.periodic[a]) continue;
    for (const int side : {0, 1}) {
      sides.push_back(fmt::format("{}{}", axis_names[a], side));
      Wall plane = like;
      plane.name = fmt::format("{}_{}", like.name, sides.back());
      plane.point = side == 0 ? lower : upper;
      plane.normal[a] = side == 0 ? 1 : -1;
      planes.push_back(plane);
    }
  }
  const unsigned open = read_open(table, sides);
  std::vector<Wall> closed;
  for (std::size_t k = 0; k < planes.size(); ++k)
    if ((open >> k & 1U) == 0) closed.push_back(planes[k]);
  if (closed.empty())
    table.fail("shape", "is \"box\", but no side of it is left", "remove it, or open fewer sides");
  return closed;
}

}  // namespace

std::optional<Double3> unit_vector(Double3 n) {
  constexpr double rounding = 16 * std::numeric_limits<double>::epsilon();
  const auto square = [&] { return n[0] * n[0] + n[1] * n[1] + n[2] * n[2]; };
  if (std::fabs(square() - 1) <= rounding) return n;
  const double largest = std::max({std::fabs(n[0]), std::fabs(n[1]), std::fabs(n[2])});
  if (!(largest > 0)) return std::nullopt;
  for (double& c : n) c /= largest;
  const double length = std::sqrt(square());
  for (double& c : n) c /= length;
  return n;
}

std::vector<Wall> read_walls(const TopReader& top, const Scene& scene) {
  std::vector<Wall> walls;
  std::vector<std::string> names;
  for (const WallReader& table : top.tables<keys::wall>()) {
    Wall wall;
    table.read(wall);
    (void)read_name(table, "wall", names);
    if (table.choice<keys::WallShape>("shape") == keys::WallShape::box) {
      for (const Wall& side : read_box(table, scene, wall)) {
        if (std::find(names.begin(), names.end(), side.name) != names.end())
          table.fail("name", fmt::format("makes a side \"{}\", the name of an earlier wall", side.name),
                     "give each wall its own name");
        names.push_back(side.name);
        walls.push_back(side);
      }
    } else {
      walls.push_back(read_plane(table, scene, wall));
    }
    names.push_back(wall.name);
    table.finish();
  }
  return walls;
}

}  // namespace sph

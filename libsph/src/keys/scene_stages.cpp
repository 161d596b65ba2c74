// [[stage]] and [[stage.wall]]: from a time on, some walls behave otherwise.
#include <fmt/format.h>

#include <cstddef>
#include <optional>

#include "keys/scene_resolve.hpp"

namespace sph {
namespace {

/// What has become of the walls up to the stage that is being read.
struct Course {
  std::vector<bool> removed, driven_by_force;
};

WallChange read_change(const Reader<keys::stage_wall>& table, const std::vector<Wall>& walls,
                       Course& course) {
  WallChange change;
  table.read(change);
  const auto k = static_cast<std::size_t>(change.wall);
  if (k >= walls.size())
    table.fail("name", "names a [[mesh]]",
               "its motion follows time by its own keys: begin, end, velocity, spin");
  if (course.removed[k])
    table.fail("name", fmt::format("names \"{}\", which an earlier stage removed", walls[k].name),
               "a wall does not come back");
  table.not_both("velocity", "force");
  table.not_both("velocity", "remove");
  table.not_both("force", "remove");
  if (change.force && walls[k].servo_gain == 0)
    table.fail("force", fmt::format("is given, but the wall \"{}\" is no servo", walls[k].name),
               "give that [[wall]] servo_gain and largest_speed");
  change.remove = table.flag("remove").value_or(false);
  if (table.has("remove") && !change.remove) table.fail("remove", "is false", "leave it out; the wall stays");
  if (!change.velocity && !change.force && !change.remove)
    table.fail_missing("velocity", "give it, force, or remove = true");
  course.driven_by_force[k] = course.driven_by_force[k] || change.force.has_value();
  table.finish();
  return change;
}

WallStage read_stage(const Reader<keys::stage>& table, const Scene& scene, Course& course) {
  WallStage stage;
  table.read(stage);
  for (const auto& t : table.tables<keys::stage_wall>()) {
    const WallChange change = read_change(t, scene.grains.walls, course);
    for (const WallChange& other : stage.walls)
      if (other.wall == change.wall)
        t.fail("name", "names a wall that this stage has changed already", "change each wall once a stage");
    stage.walls.push_back(change);
  }
  for (const WallChange& change : stage.walls)
    if (change.remove) course.removed[static_cast<std::size_t>(change.wall)] = true;
  if (stage.walls.empty()) table.fail_missing("wall", "say in [[stage.wall]] what changes");
  return stage;
}

/// A servo that nothing ever sets a force for.
void check_servos(const TopReader& top, const Scene& scene, const Course& course) {
  for (const auto& table : top.tables<keys::wall>())
    for (std::size_t k = 0; k < scene.grains.walls.size(); ++k)
      if (scene.grains.walls[k].name == table.text("name") && scene.grains.walls[k].servo_gain > 0 &&
          !scene.grains.walls[k].force && !course.driven_by_force[k])
        table.fail("servo_gain", "is given, but no force", "give force here or in a [[stage.wall]]");
}

}  // namespace

std::vector<WallStage> read_stages(const TopReader& top, const Scene& scene) {
  std::vector<WallStage> stages;
  std::vector<std::string> names;
  Course course{std::vector<bool>(scene.grains.walls.size()), std::vector<bool>(scene.grains.walls.size())};
  for (const auto& table : top.tables<keys::stage>()) {
    names.push_back(read_name(table, "stage", names));
    WallStage stage = read_stage(table, scene, course);
    if (!stages.empty() && !(stages.back().begin < stage.begin))
      table.fail("begin", fmt::format("is {}, not after the stage before it", stage.begin),
                 "write stages in the order of their times");
    table.finish();
    stages.push_back(std::move(stage));
  }
  check_servos(top, scene, course);
  return stages;
}

}  // namespace sph

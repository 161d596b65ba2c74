#include "averages.hpp"

namespace sph {

std::vector<ExtraColumn> extra_columns(const Scene& scene) {
  if (!scene.output.average_space) return {};
  return {{"velocity_smooth", "m/s", scene.dim, {}}, {"pressure_smooth", "Pa", 1, {}}};
}

std::vector<ExtraColumn> averages(Simulation& simulation) {
  std::vector<ExtraColumn> columns = extra_columns(simulation.scene());
  return columns;
}

}  // namespace sph

// Scenes whose particles and velocities a test makes itself.
#pragma once

#include <unistd.h>

#include <filesystem>
#include <fstream>

#include "accuracy/measure.hpp"

namespace measure {

/// A scene of benchmarks/accuracy, or the text of one, with particles as given; `x`, `v` and `group` matter.
class Bodies {
 public:
  explicit Bodies(double rho) : rho_(rho) {}
  void add(double x, double y, double vx, double vy, int group = 0) {
    particles_.push_back({{x, y, 0}, {vx, vy, 0}, rho_, 0, 0, static_cast<unsigned>(group)});
  }
  [[nodiscard]] sph::Simulation start(const decomp::Comm& comm, const std::string& scene, double spacing,
                                      std::vector<std::string> overrides = {}) const {
    const std::filesystem::path file =
        std::filesystem::temp_directory_path() / ("peperite_" + std::to_string(getpid()) + ".csv");
    std::ofstream csv(file);
    csv.precision(17);
    csv << "id,x,y,vx,vy,group,rho,m\n";
    for (std::size_t k = 0; k < particles_.size(); ++k) {
      const Sample& q = particles_[k];
      csv << k + 1 << ',' << q.x[0] << ',' << q.x[1] << ',' << q.v[0] << ',' << q.v[1] << ',' << q.group
          << ',' << q.rho << ",0\n";
    }
    csv.close();
    std::string number(32, '\0');
    number.resize(static_cast<std::size_t>(std::snprintf(number.data(), 32, "%.17g", spacing)));
    overrides.push_back("start.file=" + file.string());
    overrides.push_back("start.spacing=" + number);
    const bool is_text = scene.find('\n') != std::string::npos;
    const measure::Removed removed{file};
    return sph::Simulation(comm, is_text ? sph::parse_scene(scene, "solid.toml", overrides)
                                         : sph::read_scene(PEPERITE_ACCURACY_DIR "/" + scene, overrides));
  }

 private:
  double rho_;
  std::vector<Sample> particles_;
};

}  // namespace measure

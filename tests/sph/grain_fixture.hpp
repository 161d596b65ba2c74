// Scenes of grains made from TOML text, and what tests of whole runs ask of them.
#pragma once

#include <filesystem>
#include <memory>
#include <string>
#include <vector>

#include "decomp/comm.hpp"
#include "sph/output/monitors.hpp"
#include "sph/step/simulation.hpp"

namespace sph::test {

/// A grain of a start file.
struct StartGrain {
  std::string group;
  Double3 x, v, w{};
  double radius;
};

/// A file of rank 0's making, in a directory of its own that goes with it. Collective.
class StartFile {
 public:
  StartFile(const decomp::Comm& comm, const std::vector<StartGrain>& grains);
  ~StartFile();
  StartFile(const StartFile&) = delete;
  StartFile& operator=(const StartFile&) = delete;
  [[nodiscard]] const std::string& path() const { return path_; }

 private:
  bool mine_;
  std::string path_;
};

/// What is known of the grain with this id, on every rank. Collective.
struct GrainNow {
  Double3 x, v, w;
};
[[nodiscard]] GrainNow grain(const Simulation& simulation, std::uint64_t id);

/// The simulation as it goes on from a checkpoint of its state, which is written to `folder`. Collective.
[[nodiscard]] std::unique_ptr<Simulation> through_a_checkpoint(const Simulation& simulation,
                                                               const std::filesystem::path& folder);

}  // namespace sph::test

// What a run says: banner, status lines, final table, perf.json and the fingerprint line. Rank 0 prints.
#pragma once

#include <chrono>
#include <filesystem>

#include "sph/step/simulation.hpp"

namespace sph {

class Screen {
 public:
  /// `launched`: when setting up began.
  Screen(Simulation& simulation, std::chrono::steady_clock::time_point launched);

  void banner() const;
  void status();  ///< collective
  /// Table, perf.json in `dir`, fingerprint line. Collective. Throws OutputError on all ranks.
  void final_report(const std::filesystem::path& dir);

 private:
  using Clock = std::chrono::steady_clock;
  [[nodiscard]] double seconds_left() const;

  Simulation& simulation_;
  GlobalState first_;  ///< when this run began
  Clock::time_point begin_ = Clock::now();
  double setup_seconds_;
  GlobalState last_;  ///< at the last status line
  Clock::time_point last_time_ = begin_;
  double last_computation_ = 0;
};

/// "fingerprint <hex> step <n> t <time>". Collective.
void print_fingerprint(const Simulation& simulation);

}  // namespace sph

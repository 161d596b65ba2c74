// When to save, speak and stop: signals (any rank), the clock, --max-time and the file `stop` (rank 0). A
// rank's wish travels with the reduction of the step, and all ranks act on the greatest one in the same step.
// A wish lasts until it is granted, so that a smaller one is not lost to a greater one.
#pragma once

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <optional>

#include "sph/scene/scene.hpp"

namespace sph {

enum class Wish : std::int64_t { none, status, checkpoint, stop, give_up };

class RunControl {
 public:
  using Clock = std::chrono::steady_clock;
  /// `begin` is when the program started, as far as --max-time is concerned.
  RunControl(int rank, Clock::time_point begin, const OutputControl& output, std::filesystem::path stop_file,
             std::optional<double> max_seconds);

  /// `failed`: this rank cannot write, and the ranks must meet to give up.
  [[nodiscard]] Wish wish(bool failed);
  void granted(Wish wish);
  /// How long the last checkpoint took, so that --max-time leaves time for another.
  void checkpoint_took(double seconds) { checkpoint_seconds_ = seconds; }

 private:
  [[nodiscard]] static double seconds_since(Clock::time_point t) {
    return std::chrono::duration<double>(Clock::now() - t).count();
  }
  [[nodiscard]] bool stop_file_found();

  int rank_;
  double checkpoint_interval_, status_interval_;
  std::filesystem::path stop_file_;
  std::optional<double> max_seconds_;
  double checkpoint_seconds_ = 0;
  double longest_step_ = 0;
  bool stopping_ = false;
  Clock::time_point begin_, last_status_ = Clock::now(), last_checkpoint_ = last_status_,
                            last_look_ = last_status_;
  std::optional<Clock::time_point> last_wish_;
};

}  // namespace sph

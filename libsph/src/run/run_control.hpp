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

using WallClock = std::chrono::steady_clock;

[[nodiscard]] inline double seconds_since(WallClock::time_point t) {
  return std::chrono::duration<double>(WallClock::now() - t).count();
}

/// Due so many seconds after it was reset, or made.
class Alarm {
 public:
  explicit Alarm(double seconds) : seconds_(seconds) {}
  [[nodiscard]] bool due() const { return seconds_since(last_) >= seconds_; }
  void reset() { last_ = WallClock::now(); }

 private:
  double seconds_;
  WallClock::time_point last_ = WallClock::now();
};

/// --max-time, which must leave time for the step under way and a checkpoint after it.
class TimeLimit {
 public:
  TimeLimit(WallClock::time_point begin, std::optional<double> max_seconds)
      : begin_(begin), max_seconds_(max_seconds) {}
  void step_begins();
  void checkpoint_took(double seconds) { checkpoint_seconds_ = seconds; }
  [[nodiscard]] bool reached() const;

 private:
  WallClock::time_point begin_;
  std::optional<double> max_seconds_;
  std::optional<WallClock::time_point> last_step_;
  double longest_step_ = 0, checkpoint_seconds_ = 0;
};

class RunControl {
 public:
  /// `begin` is when the program started, as far as --max-time is concerned.
  RunControl(int rank, WallClock::time_point begin, const OutputControl& output,
             std::filesystem::path stop_file, std::optional<double> max_seconds);

  /// `failed`: this rank cannot write, and the ranks must meet to give up.
  [[nodiscard]] Wish wish(bool failed);
  void granted(Wish wish);
  /// How long the last checkpoint took, so that --max-time leaves time for another.
  void checkpoint_took(double seconds) { limit_.checkpoint_took(seconds); }

 private:
  [[nodiscard]] bool stop_file_found();

  int rank_;
  Alarm status_, checkpoint_;
  TimeLimit limit_;
  std::filesystem::path stop_file_;
  Alarm look_;  ///< for the stop file
  bool stopping_ = false;
};

}  // namespace sph

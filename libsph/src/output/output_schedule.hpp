// When output is due: at the first step with t >= k interval, k = 0, 1, ... The next wanted time follows from
// t alone, so that nothing needs to be remembered across a restart.
#pragma once

#include <cmath>
#include <limits>

namespace sph {

class OutputSchedule {
 public:
  /// A new run, which begins with output. An interval of 0 is never due.
  explicit OutputSchedule(double interval) : interval_(interval) {}
  [[nodiscard]] bool due(double time) const { return interval_ > 0 && time >= wanted_; }
  /// Output at `time` is done: the next multiple beyond it is wanted.
  void done(double time) {
    if (interval_ <= 0) return;
    double k = std::floor(time / interval_);
    wanted_ = k * interval_;
    for (int more = 0; more < 3 && wanted_ <= time; ++more) wanted_ = ++k * interval_;  // both may be rounded
    // Multiples that cannot be told apart: every step is beyond one.
    if (wanted_ <= time || !std::isfinite(wanted_))
      wanted_ = std::nextafter(time, std::numeric_limits<double>::infinity());
  }

 private:
  double interval_, wanted_ = 0;
};

}  // namespace sph

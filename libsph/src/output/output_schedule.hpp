// When output is due: at the first step with t >= k interval, k = 0, 1, ... The next wanted time follows from
// t alone, so that nothing needs to be remembered across a restart.
#pragma once

#include <cmath>

namespace sph {

class OutputSchedule {
 public:
  /// A new run, which begins with output. An interval of 0 is never due.
  explicit OutputSchedule(double interval) : interval_(interval) {}
  [[nodiscard]] bool due(double time) const { return interval_ > 0 && time >= next_ * interval_; }
  /// Output at `time` is done: the next multiple beyond it is wanted.
  void done(double time) {
    if (interval_ <= 0) return;
    next_ = std::floor(time / interval_);
    while (next_ * interval_ <= time) ++next_;  // the quotient may have been rounded
  }

 private:
  double interval_;
  double next_ = 0;  ///< a whole number
};

}  // namespace sph

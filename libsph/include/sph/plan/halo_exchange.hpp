// Brings halo copies of fields up to date, those that are not, while the interior is computed.
#pragma once

#include <cstdint>

#include "decomp/halo.hpp"
#include "decomp/timer.hpp"
#include "sph/core/particles.hpp"
#include "sph/plan/plan.hpp"

namespace sph {

class HaloExchange {
 public:
  /// Without `overlap`, begin() waits for its messages.
  explicit HaloExchange(bool overlap) : overlap_(overlap) {}

  /// `in_lines`: what is in lines travels in whole lines. All ranks must say the same: whether a rank's grains are in lines now depends on
  /// who has looked at them there.
  void begin(decomp::HaloPlan& halo, Particles& particles, FieldSet wanted, decomp::Timers& timers,
             bool in_lines = false);
  void end(decomp::HaloPlan& halo, decomp::Timers& timers);
  /// Halo copies of these fields are out of date.
  void changed(Particles& particles, FieldSet fields);
  /// ... of all: the halo has new rows.
  void forget() { fresh_ = {}; }
  [[nodiscard]] std::int64_t refreshes() const { return refreshes_; }

 private:
  bool overlap_, under_way_ = false;
  Freshness fresh_;
  std::int64_t refreshes_ = 0;
};

}  // namespace sph

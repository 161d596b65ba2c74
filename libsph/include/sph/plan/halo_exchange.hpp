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

  void begin(decomp::HaloPlan& halo, Particles& particles, FieldSet wanted, decomp::Timers& timers);
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

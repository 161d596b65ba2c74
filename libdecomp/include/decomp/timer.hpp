// Where the time goes: exclusive seconds per named region, computation told apart from waiting. A region
// begun inside another stops the outer one's clock. Timers may decide where cuts lie, never enter a sum.
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "decomp/comm.hpp"

namespace decomp {

enum class Region : std::uint8_t {
  pairs,      ///< pair passes
  update,     ///< local updates and integration
  contacts,   ///< contact forces and history
  lists,      ///< cell binning, halo plan, neighbour lists
  order,      ///< work done only for the bits: ranking and sorting partners by id
  pack,       ///< packing and unpacking of halo messages
  halo_wait,  ///< waiting for halo messages
  migrate,    ///< balancing, migration, sorting in memory
  reduce,     ///< the global reduction of a step, waiting included
  output,     ///< snapshots, checkpoints, monitors
  grid,       ///< flow on a grid, waiting included: its cells follow no cut
  other,
  count_
};
inline constexpr int region_count = static_cast<int>(Region::count_);
[[nodiscard]] std::string_view name_of(Region r);
/// CPU time of this thread: what others take of a shared core is not in it.
[[nodiscard]] double thread_seconds();
[[nodiscard]] bool is_computation(Region r);  ///< counts towards the cost that moves the cuts

class Timers {
 public:
  class Scope {  ///< stops on destruction and resumes the outer region
   public:
    Scope(Timers& t, Region r) : timers_(t), outer_(t.current_) {
      t.switch_to(r);
      ++t.calls_[static_cast<std::size_t>(r)];
    }
    ~Scope() { timers_.switch_to(outer_); }
    Scope(const Scope&) = delete;
    Scope& operator=(const Scope&) = delete;

   private:
    Timers& timers_;
    Region outer_;
  };
  [[nodiscard]] Scope time(Region r) { return Scope(*this, r); }

  [[nodiscard]] double seconds(Region r) const;  ///< so far, a running region included
  [[nodiscard]] std::int64_t calls(Region r) const;
  [[nodiscard]] double total() const;  ///< since construction; equals the sum over regions
  /// CPU seconds of computation so far: where ranks share a core, what others took is not in it.
  [[nodiscard]] double cost() const;
  [[nodiscard]] double take_cost();  ///< since the last call (or construction): what a balancer sees

  struct Row {
    Region region;
    double min, mean, max;  ///< over ranks [s]
    std::int64_t calls;     ///< on this rank
  };
  [[nodiscard]] std::vector<Row> summary(const Comm& comm) const;  ///< collective

 private:
  using Clock = std::chrono::steady_clock;
  using Durations = std::array<std::chrono::nanoseconds, region_count>;  ///< integers: they add up exactly
  [[nodiscard]] Durations elapsed() const;                               ///< up to now
  void switch_to(Region r);
  Durations elapsed_{};  ///< up to started_
  std::array<std::int64_t, region_count> calls_{};
  Region current_ = Region::other;
  Clock::time_point started_ = Clock::now();
  std::chrono::nanoseconds cpu_{};          ///< of computation, up to cpu_started_
  std::chrono::nanoseconds cpu_started_{};  ///< while a region of computation runs
  double cost_taken_ = 0;
};

}  // namespace decomp

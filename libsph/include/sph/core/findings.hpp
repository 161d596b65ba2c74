// What guards find wrong with this rank's particles. Others go on with the step, so nothing is thrown where
// it is found: the ranks agree when they meet anyway, and one message tells of the lowest id of the first
// stage that found any, whoever owns it. What later stages find may follow from it.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include "decomp/comm.hpp"

namespace sph {

class Findings {
 public:
  /// As often on all ranks.
  void begin_stage() { ++stage_; }

  /// `text()` says what is wrong with particle `id`, in full; it is asked if no lower id was found before, and nothing
  /// in an earlier stage.
  template <class Text>
  void add(std::uint64_t id, Text&& text) {
    if (any() && (found_in_ < stage_ || id_ <= id)) return;
    found_in_ = stage_;
    id_ = id;
    text_ = text();
  }
  void add(const Findings& other) {
    if (other.any()) add(other.id_, [&] { return other.text_; });
  }
  [[nodiscard]] bool any() const { return !text_.empty(); }

  /// The text of the earliest stage's lowest id on any rank, on all ranks; empty if there is none. Collective.
  [[nodiscard]] std::string agree(const decomp::Comm& comm) const;
  /// Throws GuardError with that text, after `prefix`, on all ranks if there is any. Collective.
  void stop(const decomp::Comm& comm, const std::string& prefix = {}) const;

 private:
  std::int64_t stage_ = 0;     ///< of the run, one after another
  std::int64_t found_in_ = 0;  ///< a stage
  std::uint64_t id_ = 0;
  std::string text_;
};

/// "at (x, y) m"
[[nodiscard]] std::string place_text(std::span<const double> metres);

/// "step 12: "
[[nodiscard]] std::string step_text(std::int64_t step);

}  // namespace sph

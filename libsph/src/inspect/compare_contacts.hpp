// peperite diff: contact histories and walls of two states.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "inspect/state_file.hpp"

namespace sph {

/// Finds the first contact of a grain that differs, in the order of the partners' keys. Two snapshots, or one
/// and a checkpoint, have no histories to compare.
class ContactComparison {
 public:
  ContactComparison(const StateFile& a, const StateFile& b);
  /// Of the grain in these rows of the two files, empty if nothing differs: "contact 12-57: history[1]:
  /// 0x1p-3 (0.125) != 0x1p-2 (0.25)", or "contact 12-wall 0: only in FILE".
  [[nodiscard]] std::string difference(std::uint64_t id, std::uint64_t row_a, std::uint64_t row_b) const;

 private:
  struct Side {
    std::string path;
    std::optional<decomp::Payload> entries;
    [[nodiscard]] std::span<const std::byte> of(std::uint64_t row) const;
  };
  Side a_, b_;
  std::size_t width_ = 0;  ///< bytes of an entry; 0: the scene does not say
};

[[nodiscard]] std::string wall_difference(const std::vector<WallState>& a, const std::vector<WallState>& b);
/// The same of rigid bodies.
[[nodiscard]] std::string body_difference(const std::vector<BodyState>& a, const std::vector<BodyState>& b);

/// "name: a != b"; doubles with all their bits.
[[nodiscard]] std::string unequal(const std::string& name, double a, double b);
[[nodiscard]] std::string unequal(const std::string& name, std::int64_t a, std::int64_t b);
[[nodiscard]] std::string unequal(const std::string& name, std::uint64_t a, std::uint64_t b);

}  // namespace sph

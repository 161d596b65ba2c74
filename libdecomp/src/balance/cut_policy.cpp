#include "decomp/cut_policy.hpp"

#include <utility>

#include "cut_line.hpp"

namespace decomp {

namespace {

class Fixed final : public CutPolicy {
 public:
  [[nodiscard]] bool uses_costs() const override { return false; }
  Cuts next(const Cuts& now, const Load&, const CutLimits&) override { return now; }
};

class Replay final : public CutPolicy {
 public:
  explicit Replay(std::vector<Cuts> recorded) : recorded_(std::move(recorded)) {
    if (recorded_.empty()) throw InputError("the recording of cuts is empty");
  }
  [[nodiscard]] bool uses_costs() const override { return false; }

  Cuts next(const Cuts& now, const Load&, const CutLimits& limits) override {
    const Cuts& cuts = recorded_[position_];
    const std::string entry = "recorded cuts, entry " + std::to_string(position_ + 1);
    bool same_shape = cuts.column.size() == now.column.size();
    for (std::size_t row = 0; same_shape && row < now.column.size(); ++row)
      same_shape = cuts.column[row].size() == now.column[row].size();
    if (!same_shape)
      throw InputError(entry + ": " + std::to_string(part_count(cuts)) + " parts in " +
                       std::to_string(cuts.column.size()) + " rows do not have the shape of this run's " +
                       std::to_string(part_count(now)) + " parts in " + std::to_string(now.column.size()) +
                       " rows");
    if (cuts.row.back() != limits.row_cells || cuts.column[0].back() != limits.column_cells)
      throw InputError(entry + ": made for " + std::to_string(cuts.row.back()) + " x " +
                       std::to_string(cuts.column[0].back()) + " cells, but this grid has " +
                       std::to_string(limits.row_cells) + " x " + std::to_string(limits.column_cells));
    if (position_ + 1 < recorded_.size()) ++position_;
    return cuts;
  }

 private:
  std::vector<Cuts> recorded_;
  std::size_t position_ = 0;
};

}  // namespace

std::unique_ptr<CutPolicy> make_fixed() { return std::make_unique<Fixed>(); }

std::unique_ptr<CutPolicy> make_replay(std::vector<Cuts> recorded) {
  return std::make_unique<Replay>(std::move(recorded));
}

}  // namespace decomp

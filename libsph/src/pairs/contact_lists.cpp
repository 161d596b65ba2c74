#include "sph/pairs/contact_lists.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <deque>
#include <numeric>
#include <optional>

#include "pairs/candidates.hpp"

namespace sph {
namespace {

constexpr std::size_t lanes = ContactGroups::lanes;
/// Appends to groups of contacts whose old entries are overwritten, not cleared.
class Writer {
 public:
  explicit Writer(ContactGroups& g) : g_(g) {}
  [[nodiscard]] std::size_t entries() const { return n_; }
  [[nodiscard]] std::size_t groups() const { return n_ / lanes; }
  /// Where the next `room` partners may be written before add() says how many of them were.
  [[nodiscard]] std::uint32_t* partners(std::size_t room) {
    if (g_.j.size() < n_ + room) {
      const std::size_t size = std::max(n_ + room, g_.j.size() + g_.j.size() / 2);
      g_.i.resize(size);
      g_.j.resize(size);
    }
    return g_.j.data() + n_;
  }
  void add(std::uint32_t i, std::size_t count) {
    std::fill_n(g_.i.data() + n_, count, i);
    n_ += count;
  }
  void add(const std::deque<std::array<std::uint32_t, 2>>& all) {
    std::uint32_t* j = partners(all.size());
    std::uint32_t* i = g_.i.data() + n_;
    for (const auto& pair : all) *i++ = pair[0], *j++ = pair[1];
    n_ += all.size();
  }
  /// Fills the last group with pairs (i, j) that are none.
  void pad(std::uint32_t i, std::uint32_t j) {
    const std::size_t rest = (lanes - n_ % lanes) % lanes;
    std::fill_n(partners(rest), rest, j);
    add(i, rest);
  }
  /// Groups from `candidates` on are such.
  void finish(std::size_t candidates, std::size_t history) {
    g_.i.resize(n_);
    g_.j.resize(n_);
    g_.touching.assign(groups(), 0);
    g_.candidates = candidates;
    g_.history.assign(candidates * lanes * history, 0.0);
    g_.place.assign(groups() - candidates, ContactGroups::no_place);
    g_.late_history.clear();
    g_.asleep.assign(groups(), -1.0);
  }

 private:
  ContactGroups& g_;
  std::size_t n_ = 0;
};

/// Finds the partners of rows, one row after the other.
class PartnerFinder {
 public:
  PartnerFinder(const Particles& p, const decomp::CellGrid& grid, const decomp::Box& own_cells,
                std::int64_t reach, double skin, double quantum)
      : bins_(p, grid, own_cells, reach), reaches_(p.rows() + CellBins::padding, 0.0f) {
    // In the order of the bins and in their units, each with half of what lists reach beyond: the skin, and the
    // rounding of positions to float (the bins' limit is 1 and that).
    const double* radius = p.data<Field::radius>();
    const double per_unit = 1 / (static_cast<double>(reach) * quantum);
    const float slack = 0.5f * (bins_.limit() - 1.0f);
    for (std::size_t k = 0; k < p.rows(); ++k)
      reaches_[k] = static_cast<float>((radius[bins_.rows()[k]] + 0.5 * skin) * per_unit) + slack;
  }

  /// Those above `row`, after what `pairs` has.
  [[nodiscard]] std::span<std::uint32_t> find(std::uint32_t row, Writer& pairs) {
    if (bins_.bin(row) != cell_) runs_ = bins_.runs(cell_ = bins_.bin(row), all_runs_);
    const std::size_t place = bins_.place(row);
    const float at[3] = {bins_.x(0)[place], bins_.x(1)[place], bins_.x(2)[place]};
    std::uint32_t* const partner = pairs.partners(CandidateTable::room(runs_));
    const CandidateTable candidates{bins_, bins_.rows().data(), reaches_.data()};
    return {partner, candidates.find<3, Keep::above>(runs_, at, reaches_[place], row, partner)};
  }

 private:
  CellBins bins_;
  std::vector<float> reaches_;
  std::uint32_t cell_ = ~std::uint32_t{0};
  CellBins::Runs all_runs_;
  std::span<const CellBins::Run> runs_;
};

/// Pairs of a block that do not touch, until those of all blocks that do are written.
class Candidates {
 public:
  Candidates(const Particles& p, double quantum, double skin)
      : x_(p.data<Field::position>()),
        radius_(p.data<Field::radius>()),
        quantum_(quantum),
        to_distance_((distances - 1) / skin) {}

  /// Takes from `partners` of row i those that are apart from it; returns how many it leaves.
  std::size_t take(std::uint32_t i, std::span<std::uint32_t> partners) {
    std::size_t left = 0;
    for (const std::uint32_t j : partners) {
      const double gap = gap_between(i, j);
      if (gap > 0)
        of_block_.push_back(
            {static_cast<std::uint32_t>(std::min(gap * to_distance_, distances - 1.0)), i, j});
      else
        partners[left++] = j;
    }
    return left;
  }
  /// Which groups those of a block will be, counted from the first of all; `row` of unused lanes.
  ContactBlock::Groups end_block(std::uint32_t row) {
    const std::size_t first = all_.size(), entries = of_block_.size();
    std::array<std::size_t, distances> at{};
    for (const Pair& pair : of_block_) ++at[pair.distance];
    std::exclusive_scan(at.begin(), at.end(), at.begin(), first);
    all_.resize(first + (entries + lanes - 1) / lanes * lanes, {row, row});
    for (const Pair& pair : of_block_) all_[at[pair.distance]++] = {pair.i, pair.j};
    of_block_.clear();
    return {first / lanes, all_.size() / lanes};
  }
  void append_to(Writer& pairs, std::vector<ContactBlock>& blocks) const {
    for (ContactBlock& block : blocks) {
      block.candidates.first += pairs.groups();
      block.candidates.last += pairs.groups();
    }
    pairs.add(all_);
  }

 private:
  static constexpr std::uint32_t distances = 32;  ///< classes of gaps, from 0 to the skin
  struct Pair {
    std::uint32_t distance, i, j;
  };
  [[nodiscard]] double gap_between(std::uint32_t i, std::uint32_t j) const {
    double distance2 = 0;
    for (std::size_t a = 0; a < 3; ++a) {
      const double d =
          static_cast<double>(x_[j * std::size_t{3} + a] - x_[i * std::size_t{3} + a]) * quantum_;
      distance2 += d * d;
    }
    return std::sqrt(distance2) - (radius_[i] + radius_[j]);
  }

  const std::int64_t* x_;
  const double* radius_;
  double quantum_, to_distance_;
  std::vector<Pair> of_block_;
  std::deque<std::array<std::uint32_t, 2>> all_;  // a vector that grows takes all twice
};

/// Lists the walls that grains may touch before lists are made anew.
class WallFinder {
 public:
  WallFinder(const WallsNow& walls, const WallNumbers& numbers, double quantum, Writer& list,
             FacetRuns& facets)
      : walls_(walls), numbers_(numbers), quantum_(quantum), list_(list), facets_(facets) {
    facets_.runs.clear();
  }

  /// Rows to come are in this box, and reach so far.
  void look_around(const PlaceBox& box, double reach) {
    find_near(walls_.planes, box, reach, quantum_, planes_);
  }
  /// Those closer than `reach`, by their numbers, ascending.
  void add(std::uint32_t row, const std::int64_t* x, double reach) {
    found_.clear();
    for (const std::uint32_t w : planes_)
      if (distance_from(walls_.planes[w], x, quantum_) < reach) found_.push_back(w);
    for (std::size_t m = 0; m < walls_.meshes.size(); ++m) {
      const MeshNow& mesh = walls_.meshes[m];
      if (!mesh.listed) continue;
      mesh.surface->find(mesh.in_frame(x, quantum_), reach, near_);
      if (near_.empty()) continue;
      const std::size_t first = list_.entries() + found_.size();
      facets_.runs.push_back({first, first + near_.size(), static_cast<std::uint32_t>(m)});
      for (const std::uint32_t f : near_) found_.push_back(numbers_.first(m) + f);
    }
    std::ranges::copy(found_, list_.partners(found_.size()));
    list_.add(row, found_.size());
  }

 private:
  const WallsNow& walls_;
  const WallNumbers& numbers_;
  double quantum_;
  Writer& list_;
  FacetRuns& facets_;
  std::vector<std::uint32_t> planes_, found_, near_;
};

}  // namespace

std::uint32_t ContactGroups::add_place(std::size_t components) {
  const std::size_t size = late_history.size(), more = components * lanes;
  late_history.resize(size + more, 0.0);
  return static_cast<std::uint32_t>(components > 0 ? size / more : 0);
}

void ContactLists::build(const Particles& p, const decomp::CellGrid& grid, const decomp::Box& own_cells,
                         std::int64_t reach, double skin, double quantum, const RowRanges& ranges,
                         const std::vector<bool>& fixed, const WallsNow& now) {
  std::optional<PartnerFinder> partners(std::in_place, p, grid, own_cells, reach, skin, quantum);
  const auto* group = p.data<Field::group>();
  const RowPlaces places = p.places();
  const auto* x = p.data<Field::position>();
  const double* radius = p.data<Field::radius>();
  blocks_.clear();
  Writer pairs(pairs_), walls(walls_);
  Candidates apart(p, quantum, skin);
  numbers_ = WallNumbers(now.planes.size(), now.meshes);
  WallFinder finder(now, numbers_, quantum, walls, walls_.facets);
  listed_ = 0;
  for (const RowRange& range : ranges) {
    if (&range == &ranges[static_cast<std::size_t>(RowClass::boundary_movers)])
      interior_blocks_ = blocks_.size();
    for (std::size_t first = range.first; first < range.last; first += ContactBlock::rows) {
      ContactBlock block{static_cast<std::uint32_t>(first),
                         static_cast<std::uint32_t>(std::min(first + ContactBlock::rows, range.last)),
                         {pairs.groups(), 0},
                         {},
                         {walls.groups(), 0},
                         {walls_.facets.runs.size(), 0}};
      finder.look_around({places, block.first, block.last},
                         *std::max_element(radius + block.first, radius + block.last) + skin);
      for (std::uint32_t row = block.first; row < block.last; ++row) {
        const bool is_fixed = fixed[group[row]];
        std::span<std::uint32_t> found = partners->find(row, pairs);
        if (is_fixed) {
          const auto neither_moves = [&](std::uint32_t j) { return fixed[group[j]]; };
          found = {found.begin(), std::remove_if(found.begin(), found.end(), neither_moves)};
        }
        listed_ += found.size();
        pairs.add(row, apart.take(row, found));
        if (!is_fixed) finder.add(row, x + row * 3, radius[row] + skin);
      }
      pairs.pad(block.first, block.first);
      walls.pad(block.first, ContactGroups::no_wall);
      block.pairs.last = pairs.groups();
      block.candidates = apart.end_block(block.first);
      block.walls.last = walls.groups();
      block.facets.last = walls_.facets.runs.size();
      blocks_.push_back(block);
    }
  }
  partners.reset();  // before histories come, as memory is at its peak here
  const std::size_t candidates = pairs.groups();
  apart.append_to(pairs, blocks_);
  pairs.finish(candidates, history_);
  walls.finish(walls.groups(), history_);
  walls_.facets.near.resize(walls_.facets.runs.empty() ? 0 : walls_.i.size());
}

}  // namespace sph

// Neighbour lists against brute force, where particles are wherever they like: alone, in heaps, on faces, as
// far apart as lists reach.
#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <unordered_map>
#include <vector>

#include "core/random.hpp"
#include "pairs/list_slack.hpp"
#include "sph/models/sph_constants.hpp"
#include "sph/pairs/fusions.hpp"
#include "sph/plan/distribution.hpp"

namespace sph {
namespace {

/// What a cloud of particles is drawn from.
struct Cloud {
  int dim = 2;
  std::array<bool, 3> periodic{};
  std::array<int, 3> size{40, 40, 40};  ///< of the domain [tenths of the lists' reach]
  int count = 1;
  std::uint64_t seed = 0;
  Precision precision = Precision::double_;
  double skin = 0.2;
  double wider = 1;  ///< how far lists reach, over what the cells were made for
};

Scene scene_of(const Cloud& cloud) {
  Scene s;
  s.dim = cloud.dim;
  s.terms.precision = cloud.precision;
  s.start.spacing = s.kernel.smoothing_length = 0.1;
  s.decomposition.skin = cloud.skin;
  s.decomposition.cuts = CutRule::fixed;
  s.groups.resize(2);
  s.groups[1].kind = GroupKind::wall;
  const double reach = s.support() * (1 + cloud.skin);
  for (std::size_t a = 0; a < static_cast<std::size_t>(cloud.dim); ++a) {
    s.domain.periodic[a] = cloud.periodic[a];
    // A little more than three cells, of which a period must have as many: no list then reaches two images.
    const int least = cloud.periodic[a] ? 31 : 1;
    s.domain.lower[a] = -0.7 - 0.3 * static_cast<double>(a);
    s.domain.upper[a] = s.domain.lower[a] + 0.1 * reach * std::max(cloud.size[a], least);
  }
  return s;
}

/// All particles of a cloud, as every rank knows them.
struct Crowd {
  std::vector<std::uint64_t> id;
  std::vector<decomp::Int3> x;
  std::vector<std::uint32_t> group;
  std::vector<double> reach;  ///< of their own, where kernels differ [quanta]
  std::unordered_map<std::uint64_t, std::size_t> of_id;
};

Crowd draw(const Cloud& cloud, const decomp::CellGrid& grid, std::int64_t radius) {
  const auto d = static_cast<std::size_t>(cloud.dim);
  Crowd all;
  for (std::uint64_t k = 0; k < static_cast<std::uint64_t>(cloud.count); ++k) {
    const auto random = [&](std::uint64_t what) {  // in (0, 1)
      return 0.5 + 0.5 * uniform_minus_one_to_one(cloud.seed, k * 8 + what / 4, what % 4);
    };
    const double kind = random(0);
    decomp::Int3 x{};
    for (std::size_t a = 0; a < d; ++a) {
      const auto length = static_cast<double>(grid.length()[a]);
      x[a] = grid.origin()[a] + static_cast<std::int64_t>(length * random(1 + a));
    }
    if (kind < 0.25 && k > 0) {  // in the heap about the first one
      for (std::size_t a = 0; a < d; ++a)
        x[a] = all.x[0][a] +
               static_cast<std::int64_t>(0.3 * static_cast<double>(radius) * (random(1 + a) - 0.5));
    } else if (kind < 0.6 && k > 0) {  // as far from another one as lists reach, or its own reach
      const auto of = static_cast<std::size_t>(random(4) * static_cast<double>(k));
      const auto axis = static_cast<std::size_t>(random(5) * static_cast<double>(d));
      const double r = random(6) < 0.5 ? static_cast<double>(radius) : all.reach[of];
      const double beyond = random(7) < 0.3 ? 0 : 4e-5 * (random(8) - 0.5);
      x = all.x[of];
      x[axis] += static_cast<std::int64_t>(r * (1 + beyond)) + static_cast<std::int64_t>(3 * random(9)) - 1;
    } else if (kind < 0.7) {  // on a face
      const auto axis = static_cast<std::size_t>(random(4) * static_cast<double>(d));
      x[axis] = grid.origin()[axis] + (random(5) < 0.5 ? 0 : grid.length()[axis] - 1);
    }
    x = grid.wrap(x);
    for (std::size_t a = 0; a < d; ++a)
      x[a] = std::clamp(x[a], grid.origin()[a], grid.origin()[a] + grid.length()[a] - 1);
    const auto spread = static_cast<std::uint64_t>(random(10) * 0x1p40);
    all.id.push_back(cloud.seed % 2 == 0 ? spread * 4096 + k : static_cast<std::uint64_t>(cloud.count) - k);
    all.x.push_back(x);
    all.group.push_back(random(11) < 0.2 ? 1 : 0);
    all.reach.push_back(std::floor(static_cast<double>(radius) * (0.05 + 0.95 * std::pow(random(12), 3))));
    all.of_id[all.id.back()] = k;
  }
  return all;
}

/// Where a partner is in terms of the lists' promise.
enum class Place { inside, either, outside };

/// One rank's part of a crowd, its halo up to date.
class Part {
 public:
  Part(const decomp::Comm& comm, const Cloud& cloud)
      : scene_(scene_of(cloud)),
        scale_(position_scale(scene_)),
        distribution_(comm, scene_, scale_),
        skin_(scene_.support() * (cloud.wider * (1 + cloud.skin) - 1)),
        set_{Particles(cloud.dim, {Field::id, Field::position, Field::group}),
             is_wall_,
             {},
             {},
             HaloExchange(true)},
        crowd_(draw(cloud, distribution_.grid(), scale_.quanta(scene_.support() + skin_) + 1)) {
    const auto d = static_cast<std::size_t>(cloud.dim), size = static_cast<std::size_t>(comm.size());
    std::vector<std::size_t> mine;  // some of them, to begin with
    for (std::size_t k = static_cast<std::size_t>(comm.rank()); k < crowd_.id.size(); k += size)
      mine.push_back(k);
    particles_.table().resize(mine.size(), 0);
    for (std::size_t row = 0; row < mine.size(); ++row) {
      particles_.data<Field::id>()[row] = crowd_.id[mine[row]];
      particles_.data<Field::group>()[row] = crowd_.group[mine[row]];
      for (std::size_t a = 0; a < d; ++a)
        particles_.data<Field::position>()[row * d + a] = crowd_.x[mine[row]][a];
    }
    distribution_.scatter(particles_);
    std::array<Distribution::Carried, 1> nothing;
    distribution_.rebuild(std::span(&set_, 1), 0, {}, 0, skin_, nothing);
    set_.refresh(particles_.fields(), timers_);
  }

  /// What is wrong with the lists of one radius; nothing: "".
  [[nodiscard]] std::string fault_of_even_lists(bool walls_list_walls = true) {
    NeighbourLists lists(lanes_of(scene_.terms.precision));
    const std::int64_t radius = distribution_.list_radius();
    lists.build(particles_, distribution_.grid(), distribution_.own_cells(), radius, set_.ranges, timers_,
                PartnerOrder::by_id, walls_list_walls ? nullptr : &is_wall_);
    NeighbourLists walls(lists.lanes());
    walls.build(particles_, lists, set_.ranges, is_wall_);
    if (const std::string fault = fault_of_walls(walls, lists); !fault.empty()) return fault;
    // Beside the slack there is the rounding that it makes up for, less than a quarter of it.
    const double slack = 1.25 * list_slack(distribution_.grid(), distribution_.own_cells(), radius);
    return fault_of(lists, [&](std::size_t i, std::size_t j, long double r) {
      if (!walls_list_walls && crowd_.group[i] == 1 && crowd_.group[j] == 1) return Place::outside;
      const auto far = static_cast<long double>(radius);
      return r <= far ? Place::inside : r > far * (1 + slack) ? Place::outside : Place::either;
    });
  }
  [[nodiscard]] std::string fault_of_uneven_lists() {
    NeighbourLists lists(lanes_of(scene_.terms.precision));
    std::vector<double> reach(particles_.rows());
    for (std::size_t row = 0; row < reach.size(); ++row) reach[row] = crowd_.reach[number(row)];
    lists.build(particles_, reach, set_.ranges, timers_);
    // Coordinates of 2^61 quanta, and squares of distances, are rounded to 53 bits.
    constexpr long double rounding = 1e-12L;
    return fault_of(lists, [&](std::size_t i, std::size_t j, long double r) {
      const long double most = std::max(crowd_.reach[i], crowd_.reach[j]);
      return r < most * (1 - rounding)   ? Place::inside
             : r > most * (1 + rounding) ? Place::outside
                                         : Place::either;
    });
  }
  [[nodiscard]] std::size_t owned() const { return particles_.owned(); }

 private:
  [[nodiscard]] std::size_t number(std::size_t row) const {
    return crowd_.of_id.at(particles_.data<Field::id>()[row]);
  }

  /// From i to the nearest image of j.
  [[nodiscard]] decomp::Int3 way(std::size_t i, std::size_t j) const {
    decomp::Int3 out{};
    for (std::size_t a = 0; a < 3; ++a) {
      out[a] = crowd_.x[j][a] - crowd_.x[i][a];
      const std::int64_t period = distribution_.grid().periodic()[a] ? distribution_.grid().length()[a] : 0;
      if (2 * out[a] >= period && period > 0) out[a] -= period;
      if (2 * out[a] < -period && period > 0) out[a] += period;
    }
    return out;
  }

  /// Lists between what moves and walls are what of all lists is, in the same order.
  [[nodiscard]] std::string fault_of_walls(const NeighbourLists& walls, const NeighbourLists& all) const {
    const auto lanes = static_cast<std::size_t>(all.lanes());
    const auto* group = particles_.data<Field::group>();
    std::size_t pairs = 0;
    for (const RowRange& range : set_.ranges)
      for (std::size_t row = range.first; row < range.last; ++row) {
        const std::size_t block = range.first_block + (row - range.first) / lanes,
                          lane = (row - range.first) % lanes;
        std::size_t next = lane;
        const auto found = walls.block(block);
        for (std::size_t k = lane; k < all.block(block).size(); k += lanes) {
          const std::uint32_t j = all.block(block)[k];
          if (group[row] != 0 || group[j] != 1) continue;
          if (next >= found.size() || found[next] != j) return "a list of walls lacks one";
          next += lanes;
          ++pairs;
        }
        for (; next < found.size(); next += lanes)
          if (found[next] != row) return "a list of walls is not padded with the particle itself";
      }
    return pairs == walls.pairs() ? "" : "pairs with walls are not counted right";
  }

  template <class Promise>
  [[nodiscard]] std::string fault_of(const NeighbourLists& lists, const Promise& promise) const {
    const auto lanes = static_cast<std::size_t>(lists.lanes());
    std::size_t row = 0, block = 0, pairs = 0;
    for (std::size_t c = 0; c < 4; ++c) {
      const RowRange& range = set_.ranges[c];
      if (range.first != row) return "rows are in no class, or in two";
      if (range.first_block != block) return "a block is shared by two classes, or by none";
      for (; row < range.last; ++row) {
        block = range.first_block + (row - range.first) / lanes;
        const std::string fault =
            fault_of_row(lists, block, (row - range.first) % lanes, row, c < 2, promise, pairs);
        if (!fault.empty()) return "row " + std::to_string(row) + ": " + fault;
      }
      for (std::size_t lane = range.rows() % lanes; lane != 0 && lane < lanes; ++lane)
        for (std::size_t k = lane; k < lists.block(block).size(); k += lanes)
          if (lists.block(block)[k] != range.last - 1) return "a lane without a row is not padded";
      block = range.first_block + (range.rows() + lanes - 1) / lanes;
    }
    if (row != particles_.owned()) return "rows are in no class";
    return pairs == lists.pairs() ? "" : "pairs are not counted right";
  }

  template <class Promise>
  [[nodiscard]] std::string fault_of_row(const NeighbourLists& lists, std::size_t block, std::size_t lane,
                                         std::size_t row, bool interior, const Promise& promise,
                                         std::size_t& pairs) const {
    const auto d = static_cast<std::size_t>(particles_.dim()),
               lanes = static_cast<std::size_t>(lists.lanes());
    const auto entries = lists.block(block);
    if (entries.size() % lanes != 0) return "a block is not whole";
    const std::size_t i = number(row);
    const std::int64_t* x = particles_.data<Field::position>();
    std::vector<bool> listed(crowd_.id.size(), false);
    std::uint64_t last = 0;
    std::size_t k = lane;
    bool any = false;
    for (; k < entries.size() && entries[k] != row; k += lanes, ++pairs) {
      if (entries[k] >= particles_.rows()) return "an entry is no row";
      const std::size_t j = number(entries[k]);
      if (any && crowd_.id[j] <= last) return "partners are not in ascending order";
      if (interior && entries[k] >= particles_.owned()) return "a row of the interior lists the halo";
      const decomp::Int3 nearest = way(i, j);
      for (std::size_t a = 0; a < d; ++a)
        if (x[entries[k] * d + a] - x[row * d + a] != nearest[a]) return "a partner is not the nearest image";
      any = listed[j] = true;
      last = crowd_.id[j];
    }
    for (; k < entries.size(); k += lanes)
      if (entries[k] != row) return "a list is not padded with the particle itself";
    for (std::size_t j = 0; j < crowd_.id.size(); ++j) {
      if (i == j) continue;
      long double square = 0;
      for (const std::int64_t a : way(i, j))
        square += static_cast<long double>(a) * static_cast<long double>(a);
      const Place place = promise(i, j, std::sqrt(square));
      const std::string which = std::to_string(crowd_.id[j]) + " of " + std::to_string(crowd_.id[i]);
      if (place == Place::inside && !listed[j]) return "lacks partner " + which;
      if (place == Place::outside && listed[j]) return "has a partner too far away, " + which;
    }
    return "";
  }

  const std::vector<bool> is_wall_{false, true};
  Scene scene_;
  PositionScale scale_;
  Distribution distribution_;
  double skin_;  ///< [m]
  ParticleSet set_;
  Particles& particles_ = set_.particles;
  Crowd crowd_;
  decomp::Timers timers_;
};

Cloud random_cloud(std::uint64_t seed) {
  const auto random = [&](std::uint64_t what) {
    return 0.5 + 0.5 * uniform_minus_one_to_one(seed, what / 4, what % 4);
  };
  Cloud c;
  c.dim = random(0) < 0.5 ? 2 : 3;
  for (std::size_t a = 0; a < 3; ++a) {
    c.periodic[a] = random(1 + a) < 0.5;
    c.size[a] = static_cast<int>(1 + 99 * random(4 + a));
  }
  c.count = static_cast<int>(std::pow(400.0, random(7)));
  c.seed = seed;
  c.precision = random(8) < 0.5 ? Precision::double_ : Precision::mixed;
  c.skin = random(9) < 0.3 ? 0 : random(10);
  c.wider = random(11) < 0.7 ? 1 : 1 + 0.5 * random(12);
  return c;
}

Cloud arbitrary_cloud() {
  Cloud c;
  c.dim = *rc::gen::inRange(2, 4);
  for (std::size_t a = 0; a < 3; ++a) {
    c.periodic[a] = *rc::gen::arbitrary<bool>();
    c.size[a] = *rc::gen::inRange(1, 100);
  }
  c.count = *rc::gen::oneOf(rc::gen::inRange(1, 20), rc::gen::inRange(20, 400));
  c.seed = *rc::gen::arbitrary<std::uint64_t>();
  c.precision = *rc::gen::element(Precision::double_, Precision::mixed);
  c.skin = 0.05 * *rc::gen::inRange(0, 20);
  c.wider = 1 + 0.05 * std::max(*rc::gen::inRange(-10, 10), 0);
  return c;
}

RC_GTEST_PROP(NeighbourLists, hold_all_within_their_radius_and_none_beyond, ()) {
  const decomp::Comm self(MPI_COMM_SELF);
  Part part(self, arbitrary_cloud());
  RC_ASSERT(part.fault_of_even_lists() == "");
  RC_ASSERT(part.fault_of_even_lists(false) == "");
}

RC_GTEST_PROP(NeighbourLists, hold_all_within_the_reach_of_either, ()) {
  const decomp::Comm self(MPI_COMM_SELF);
  Part part(self, arbitrary_cloud());
  RC_ASSERT(part.fault_of_uneven_lists() == "");
}

// Clouds that all ranks know without asking each other.
TEST(NeighbourLists, are_whole_on_any_rank) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  int drawn = 0;
  std::int64_t owned = 0;
  for (std::uint64_t seed = 1; seed <= 60; ++seed) {
    const Cloud cloud = random_cloud(seed);
    try {
      Part part(comm, cloud);
      EXPECT_EQ(part.fault_of_even_lists(), "") << "cloud " << seed;
      EXPECT_EQ(part.fault_of_even_lists(false), "") << "cloud " << seed;
      EXPECT_EQ(part.fault_of_uneven_lists(), "") << "cloud " << seed;
      owned += static_cast<std::int64_t>(part.owned());
      ++drawn;
    } catch (const decomp::InputError&) {  // fewer cells than ranks
    }
  }
  EXPECT_GT(drawn, 30);
  EXPECT_GT(comm.sum(owned), 1000);
}

}  // namespace
}  // namespace sph

// Of gases whose kernels differ: lists hold every pair within the kernel of either, at the end of each step.
#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "sph/step/simulation.hpp"

namespace sph {
namespace {

/// Pairs of an owned row and any other that lie within the wider kernel of the two, and how many of those the
/// lists lack.
struct Pairs {
  std::int64_t near = 0, unlike = 0, lost = 0;
};

Pairs look(const Simulation& s) {
  const Particles& p = s.particles();
  const auto d = static_cast<std::size_t>(p.dim()), lanes = static_cast<std::size_t>(s.lists().lanes());
  const std::int64_t* x = p.data<Field::position>();
  const double* h = p.data<Field::smoothing_length>();
  const double radius = s.scene().support() / s.scene().kernel.smoothing_length / s.scale().quantum;
  Pairs found;
  for (const RowRange& range : s.sets().front().ranges)
    for (std::size_t i = range.first; i < range.last; ++i) {
      const std::size_t lane = (i - range.first) % lanes;
      const auto block = s.lists().block(range.first_block + (i - range.first) / lanes);
      std::vector<bool> listed(p.rows(), false);
      for (std::size_t k = lane; k < block.size(); k += lanes) listed[block[k]] = true;
      for (std::size_t j = 0; j < p.rows(); ++j) {
        double square = 0;
        for (std::size_t a = 0; a < d; ++a) {
          const auto way = static_cast<double>(x[j * d + a] - x[i * d + a]);
          square += way * way;
        }
        const double wide = radius * std::max(h[i], h[j]), narrow = radius * std::min(h[i], h[j]);
        if (i == j || square >= wide * wide) continue;
        ++found.near;
        found.unlike += square >= narrow * narrow ? 1 : 0;
        found.lost += listed[j] ? 0 : 1;
      }
    }
  return found;
}

TEST(UnevenLists, hold_every_pair_within_the_kernel_of_either) {
  const decomp::Comm comm(MPI_COMM_WORLD);
  Simulation s(comm, read_scene(PEPERITE_TEST_DIR "/scenes/blast2d.toml",
                                {"kernel.least_growth=0.3", "kernel.largest_growth=1.6", "start.spacing=0.02",
                                 "domain.lower=[0, -0.1]", "domain.upper=[1, 0.4]", "decomposition.skin=0.1",
                                 "decomposition.balance=fixed"}));
  std::int64_t unlike = 0;
  for (int k = 0; k < 30; ++k) {
    s.step();
    s.refresh_halo({Field::position, Field::smoothing_length});
    const Pairs pairs = look(s);
    EXPECT_EQ(pairs.lost, 0) << "of " << pairs.near << " after step " << k + 1;
    unlike += pairs.unlike;
  }
  EXPECT_GT(comm.sum(unlike), 1000);
  EXPECT_LT(s.rebuilds(), 31);
}

}  // namespace
}  // namespace sph

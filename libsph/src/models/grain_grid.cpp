#include "sph/models/grain_grid.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "sph/core/fixed_point.hpp"

namespace sph {
namespace {

constexpr int layers = 2;

KernelLine line_at(std::int64_t nearest, double t, double edge) {
  const double before = 0.5 - t, after = 0.5 + t;
  return {nearest - 1,
          {0.5 * before * before, 0.75 - t * t, 0.5 * after * after},
          {-before / edge, -2 * t / edge, after / edge}};
}

const KernelLine& line_of(const GridKernel& k, int lattice, int axis) {
  const auto a = static_cast<std::size_t>(axis);
  return lattice == axis ? k.face[a] : k.centre[a];
}

/// work(index in the patch, weight) for the 27 points, the middle one last; `slope`: of which axis, -1: none.
template <class Work>
void for_points(const stokes::Patch& p, const GridKernel& k, int lattice, int slope, Work work) {
  const KernelLine &x = line_of(k, lattice, 0), &y = line_of(k, lattice, 1), &z = line_of(k, lattice, 2);
  const std::array<double, 3>&wx = slope == 0 ? x.slope : x.weight, &wy = slope == 1 ? y.slope : y.weight,
                           &wz = slope == 2 ? z.slope : z.weight;
  for (std::int64_t c = 0; c < 3; ++c)
    for (std::int64_t b = 0; b < 3; ++b) {
      const std::ptrdiff_t first = p.at(x.first, y.first + b, z.first + c);
      const double w = wy[static_cast<std::size_t>(b)] * wz[static_cast<std::size_t>(c)];
      for (std::int64_t a = 0; a < 3; ++a)
        work(static_cast<std::size_t>(first + a), w * wx[static_cast<std::size_t>(a)]);
    }
}

/// work(index of a point at 0 along the axis, were it in the frame) for each line of the frame along it.
template <class Work>
void for_frame_lines(const stokes::Patch& p, std::size_t axis, Work work) {
  decomp::Box face = p.frame;
  face.hi[axis] = face.lo[axis] + 1;
  const std::ptrdiff_t zero = p.frame.lo[axis] * p.stride[axis];
  for (std::int64_t z = face.lo[2]; z < face.hi[2]; ++z)
    for (std::int64_t y = face.lo[1]; y < face.hi[1]; ++y)
      for (std::int64_t x = face.lo[0]; x < face.hi[0]; ++x) work(p.at(x, y, z) - zero);
}

/// Behind a wall at point 0 or n of an axis: the point `x` and its image before the wall.
struct Image {
  std::int64_t x, image;
};
std::vector<Image> images(const stokes::Patch& p, std::size_t axis, bool faces) {
  std::vector<Image> out;
  const std::int64_t n = p.grid.cells[axis], shift = faces ? 0 : 1;
  for (std::int64_t x = p.frame.lo[axis]; x < 0; ++x) out.push_back({x, -shift - x});
  for (std::int64_t x = n + 1 - shift; x < p.frame.hi[axis]; ++x) out.push_back({x, 2 * n - shift - x});
  return out;
}

}  // namespace

GrainGrid::GrainGrid(const decomp::Comm& comm, const stokes::Grid& grid, const PositionScale& scale,
                     const decomp::Int3& length, std::vector<decomp::Box> cells)
    : comm_(&comm), grid_(grid), scale_(scale), length_(length), cells_(std::move(cells)) {}

void GrainGrid::follow(const decomp::JaggedPartition& partition, double strayed) {
  std::vector<decomp::Box> frames;
  for (int r = 0; r < partition.ranks(); ++r) {
    const decomp::Box part = partition.cells(r);
    decomp::Box box;
    for (std::size_t a = 0; a < 3; ++a) {
      const auto cell_at = [&](std::int64_t line) {
        const std::int64_t x = partition.grid().line(static_cast<int>(a), line) - scale_.origin[a];
        return static_cast<double>(x) *
               (static_cast<double>(grid_.cells[a]) / static_cast<double>(length_[a]));
      };
      const auto more = static_cast<std::int64_t>(std::ceil(strayed / grid_.edge[a]));
      box.lo[a] = static_cast<std::int64_t>(std::floor(cell_at(part.lo[a]))) - more;
      box.hi[a] = static_cast<std::int64_t>(std::ceil(cell_at(part.hi[a]))) + more;
      if (grid_.periodic(static_cast<int>(a))) continue;
      box.lo[a] = std::clamp<std::int64_t>(box.lo[a], 0, grid_.cells[a] - 1);
      box.hi[a] = std::clamp<std::int64_t>(box.hi[a], box.lo[a] + 1, grid_.cells[a]);
    }
    const stokes::Patch patch(grid_, box, layers);
    frames.push_back(patch.frame);
    if (r == comm_->rank()) patch_.emplace(patch);
  }
  exchange_.emplace(*comm_, grid_.cells, grid_.periodic_axes(), cells_, frames);
}

// Between rebuilds of lists grains may be stored a period away: the weights are those of the place in the domain.
GridKernel GrainGrid::kernel(const std::int64_t* x) const {
  GridKernel out;
  for (std::size_t a = 0; a < 3; ++a) {
    std::int64_t inside = x[a] - scale_.origin[a], periods = 0;
    if (grid_.periodic(static_cast<int>(a))) {
      periods = inside / length_[a] - (inside % length_[a] < 0 ? 1 : 0);
      inside -= periods * length_[a];
    }
    const double s =
        static_cast<double>(inside) * (static_cast<double>(grid_.cells[a]) / static_cast<double>(length_[a]));
    const double cell = std::floor(s), t = s - cell;
    const std::int64_t i = static_cast<std::int64_t>(cell) + periods * grid_.cells[a];
    out.centre[a] = line_at(i, t - 0.5, grid_.edge[a]);
    out.face[a] = t < 0.5 ? line_at(i, t, grid_.edge[a]) : line_at(i + 1, t - 1, grid_.edge[a]);
  }
  return out;
}

double GrainGrid::mean(const GridKernel& k, int lattice, const stokes::Field& f) const {
  double sum = 0;
  for_points(*patch_, k, lattice, -1, [&](std::size_t at, double w) { sum += w * f[at]; });
  return sum;
}

double GrainGrid::slope(const GridKernel& k, int lattice, const stokes::Field& f, int axis) const {
  double sum = 0;
  for_points(*patch_, k, lattice, axis, [&](std::size_t at, double w) { sum += w * f[at]; });
  return sum;
}

double GrainGrid::own(const GridKernel& k, int lattice) {
  double product = 1;
  for (int a = 0; a < 3; ++a) {
    double square = 0;
    for (const double w : line_of(k, lattice, a).weight) square += w * w;
    product *= square;
  }
  return product;
}

void GrainGrid::spread(const GridKernel& k, int lattice, double value, Deposit& to) const {
  std::int64_t rest = round_to_quanta(value);
  for_points(*patch_, k, lattice, -1, [&](std::size_t at, double w) {
    const std::int64_t part = round_to_quanta(w * value);
    to[at] += part;
    rest -= part;
  });
  const auto middle = [&](int axis) { return line_of(k, lattice, axis).first + 1; };
  to[static_cast<std::size_t>(patch_->at(middle(0), middle(1), middle(2)))] += rest;
}

namespace {

/// Weights of both ends of a way along one axis, over the points that either of them has, and what passes through the lower
/// face of each: W_to - W_from = -(J_next - J).
struct FacePassage {
  static constexpr std::size_t most = 12;
  std::int64_t first = 0;
  std::size_t points = 0;
  std::array<double, most> from{}, change{}, through{};

  FacePassage(const KernelLine& a, const KernelLine& b) {
    first = std::min(a.first, b.first);
    points = static_cast<std::size_t>(std::max(a.first, b.first) - first) + 3;
    for (std::size_t k = 0; k < 3; ++k) {
      const auto at_a = static_cast<std::size_t>(a.first - first) + k;
      const auto at_b = static_cast<std::size_t>(b.first - first) + k;
      from[at_a] += a.weight[k];
      change[at_a] -= a.weight[k];
      change[at_b] += b.weight[k];
    }
    for (std::size_t k = 1; k < points; ++k) through[k] = through[k - 1] - change[k - 1];
  }
};

}  // namespace

// Of the two other axes the mean over the way: W W' + (W dW' + dW W') / 2 + dW dW' / 3.
void GrainGrid::spread_way(const GridKernel& from, const GridKernel& to, double value,
                           const std::array<Deposit*, 3>& through) const {
  const std::array<FacePassage, 3> p{FacePassage(from.centre[0], to.centre[0]),
                                     FacePassage(from.centre[1], to.centre[1]),
                                     FacePassage(from.centre[2], to.centre[2])};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::size_t b = (a + 1) % 3, c = (a + 2) % 3;
    for (std::size_t j = 0; j < p[b].points; ++j)
      for (std::size_t k = 0; k < p[c].points; ++k) {
        const double wb = p[b].from[j], wc = p[c].from[k], db = p[b].change[j], dc = p[c].change[k];
        const double share = value * (wb * wc + 0.5 * (wb * dc + db * wc) + db * dc / 3);
        decomp::Int3 at{};
        at[a] = p[a].first;
        at[b] = p[b].first + static_cast<std::int64_t>(j);
        at[c] = p[c].first + static_cast<std::int64_t>(k);
        const std::ptrdiff_t first = patch_->at(at);
        for (std::size_t i = 1; i < p[a].points; ++i)
          (*through[a])[static_cast<std::size_t>(first +
                                                 static_cast<std::ptrdiff_t>(i) * patch_->stride[a])] +=
              round_to_quanta(share * p[a].through[i]);
      }
  }
}

void GrainGrid::fold_walls(Deposit& deposit, int lattice, bool as_flux) const {
  for (std::size_t a = 0; a < 3; ++a) {
    if (grid_.periodic(static_cast<int>(a))) continue;
    const bool across = lattice == static_cast<int>(a);
    const std::ptrdiff_t s = patch_->stride[a];
    const std::int64_t sign = across && as_flux ? -1 : 1;
    const std::vector<Image> all = images(*patch_, a, across);
    for_frame_lines(*patch_, a, [&](std::ptrdiff_t zero) {
      const auto value = [&](std::int64_t x) -> std::int64_t& {
        return deposit[static_cast<std::size_t>(zero + x * s)];
      };
      for (const Image& i : all) value(i.image) += sign * std::exchange(value(i.x), 0);
      if (across && as_flux && patch_->frame.lo[a] <= 0) value(0) = 0;
    });
  }
}

void GrainGrid::fold(std::span<const Folded> all, const stokes::Patch& owners) {
  std::vector<Deposit> sums(all.size(), Deposit(owners.size, 0));
  std::vector<decomp::CellValues> to, from;
  for (std::size_t k = 0; k < all.size(); ++k) {
    fold_walls(*all[k].deposit, all[k].lattice, all[k].as_flux);
    to.push_back(decomp::cell_values(std::span(*all[k].deposit), patch_->frame));
    from.push_back(decomp::cell_values(std::span(sums[k]), owners.frame));
  }
  exchange_->fold(to, from);
  for (std::size_t k = 0; k < all.size(); ++k) {
    stokes::Field& field = *all[k].to;
    field.assign(owners.size, 0.0);
    stokes::for_lines(owners, [&](std::ptrdiff_t first, std::int64_t n, std::int64_t, std::int64_t) {
      for (std::ptrdiff_t i = first; i < first + n; ++i)
        field[static_cast<std::size_t>(i)] =
            static_cast<double>(sums[k][static_cast<std::size_t>(i)]) * all[k].unit;
    });
  }
}

void GrainGrid::mirror(stokes::Field& f, int lattice, Behind behind) const {
  for (std::size_t a = 0; a < 3; ++a) {
    if (grid_.periodic(static_cast<int>(a))) continue;
    const bool across = lattice == static_cast<int>(a);
    const std::ptrdiff_t s = patch_->stride[a];
    const std::int64_t n = grid_.cells[a];
    const bool odd = across && (behind == Behind::velocity || behind == Behind::flux);
    const auto sign_of = [&](std::size_t side) {
      if (across) return odd ? -1.0 : 1.0;
      return behind == Behind::velocity && grid_.sides[a][side] == stokes::Side::no_slip ? -1.0 : 1.0;
    };
    const std::array<double, 2> sign{sign_of(0), sign_of(1)};
    const bool lower = patch_->frame.lo[a] <= 0, upper = patch_->frame.hi[a] > n;
    const std::vector<Image> all = images(*patch_, a, across);
    for_frame_lines(*patch_, a, [&](std::ptrdiff_t zero) {
      const auto value = [&](std::int64_t x) -> double& { return f[static_cast<std::size_t>(zero + x * s)]; };
      if (across && lower) value(0) = odd ? 0.0 : value(1);
      if (across && upper) value(n) = odd ? 0.0 : value(n - 1);
      for (const Image& i : all) value(i.x) = sign[i.x < 0 ? 0 : 1] * value(i.image);
    });
  }
}

void GrainGrid::copy(std::span<const Copied> all, const stokes::Patch& owners) {
  std::vector<decomp::CellValues> from, to;
  for (const Copied& c : all) {
    c.to->assign(patch_->size, 0.0);
    auto* data = const_cast<double*>(c.from->data());  // begin() does not write to it
    from.push_back(decomp::cell_values(std::span(data, c.from->size()), owners.frame));
    to.push_back(decomp::cell_values(std::span(*c.to), patch_->frame));
  }
  exchange_->copy(from, to);
  for (const Copied& c : all) mirror(*c.to, c.lattice, c.behind);
}

}  // namespace sph

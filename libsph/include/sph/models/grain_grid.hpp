// Between grains and the grid that melts flow on. The kernel K_h is a quadratic B-spline on each lattice of the grid: that
// of the cells' centres, and those of the faces across each axis. Grains put integers down, in any order, which then go to
// the owners of the cells; what walls have behind them has its image before them.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "decomp/box_exchange.hpp"
#include "decomp/partition.hpp"
#include "sph/core/particles.hpp"
#include "stokes/grid.hpp"

namespace sph {

/// Of one grain along one axis: three points in a row, their weights and how these change with its place [1/m].
struct KernelLine {
  std::int64_t first;
  std::array<double, 3> weight, slope;
};
/// Of one grain; by axis.
struct GridKernel {
  std::array<KernelLine, 3> centre, face;
};

/// The lattice of centres; those of faces are 0, 1, 2, the axis across which they lie.
inline constexpr int centres = -1;

class GrainGrid {
 public:
  using Deposit = std::vector<std::int64_t>;

  /// `length`: of the domain [quanta]; `cells`: who has which.
  GrainGrid(const decomp::Comm& comm, const stokes::Grid& grid, const PositionScale& scale,
            const decomp::Int3& length, std::vector<decomp::Box> cells);

  /// Grains are where `partition` has them, or up to `strayed` [m] beyond. Collective.
  void follow(const decomp::JaggedPartition& partition, double strayed);
  /// The cells that this rank's grains may reach, and two more behind each side.
  [[nodiscard]] const stokes::Patch& patch() const { return *patch_; }

  [[nodiscard]] GridKernel kernel(const std::int64_t* x) const;
  /// sum w f, and sum of its slope along `axis` [1/m].
  [[nodiscard]] double mean(const GridKernel& kernel, int lattice, const stokes::Field& f) const;
  [[nodiscard]] double slope(const GridKernel& kernel, int lattice, const stokes::Field& f, int axis) const;
  /// sum w^2: what of 1 that a grain spreads it sees itself.
  [[nodiscard]] static double own(const GridKernel& kernel, int lattice);

  [[nodiscard]] Deposit make_deposit() const { return Deposit(patch_->size, 0); }
  /// Adds w value in whole numbers whose sum is that of `value`, |value| < 2^50.
  void spread(const GridKernel& kernel, int lattice, double value, Deposit& to) const;
  /// Adds what passes through faces across each axis on the way from one place to the other, so that with what spread()
  /// has put down at both d_t + div is 0 (Esirkepov 2001).
  void spread_way(const GridKernel& from, const GridKernel& to, double value,
                  const std::array<Deposit*, 3>& through) const;

  /// Deposits to the owners of cells, times `unit`, into fields over their patches. `as_flux`: of faces, and what goes
  /// through a wall is 0, and opposite behind it. Collective.
  struct Folded {
    Deposit* deposit;
    int lattice;
    stokes::Field* to;
    double unit;
    bool as_flux = false;
  };
  void fold(std::span<const Folded> all, const stokes::Patch& owners);

  /// What a field is behind walls: as it is before them; a velocity, whose sides slip or hold; what flows through faces; a
  /// force, which at a wall is that beside it.
  enum class Behind : std::uint8_t { same, velocity, flux, force };
  struct Copied {
    const stokes::Field* from;
    int lattice;
    Behind behind;
    stokes::Field* to;
  };
  /// From the owners of cells to those whose grains look at them. Collective.
  void copy(std::span<const Copied> all, const stokes::Patch& owners);

 private:
  void fold_walls(Deposit& deposit, int lattice, bool as_flux) const;
  void mirror(stokes::Field& f, int lattice, Behind behind) const;

  const decomp::Comm* comm_;
  stokes::Grid grid_;
  PositionScale scale_;
  decomp::Int3 length_;
  std::vector<decomp::Box> cells_;
  std::optional<stokes::Patch> patch_;
  std::optional<decomp::BoxExchange> exchange_;  ///< from owners to grains
};

}  // namespace sph

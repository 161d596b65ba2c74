// Particles of one rank: a decomp::Table whose columns are the scene's fields. Owned rows come first, in the
// order interior movers, interior walls, boundary movers, boundary walls (each along the Hilbert curve of
// cells, by id within a cell), then the halo.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "decomp/table.hpp"
#include "sph/core/fields.hpp"
#include "sph/core/grain_lines.hpp"

namespace sph {

template <Field F>
using field_type = std::conditional_t<
    info(F).type == Type::f64, double,
    std::conditional_t<info(F).type == Type::i64, std::int64_t,
                       std::conditional_t<info(F).type == Type::u64, std::uint64_t, std::uint32_t>>>;

/// Ids of particles run from 0 to this; keys of walls lie above (sph/pairs/contact_lists.hpp).
inline constexpr std::uint64_t largest_id = (std::uint64_t{1} << 63) - 1;

class Particles {
 public:
  Particles(int dim, FieldSet fields) : dim_(dim), fields_(fields) {
    column_.fill(-1);
    for (Field f : fields.list())
      column_[static_cast<std::size_t>(f)] =
          table_.add_column(std::string(info(f).name), width(f, dim),
                            passing_sums.has(f) ? decomp::Values::passing : decomp::Values::kept);
  }
  [[nodiscard]] int dim() const { return dim_; }
  [[nodiscard]] FieldSet fields() const { return fields_; }
  [[nodiscard]] bool has(Field f) const { return fields_.has(f); }
  [[nodiscard]] std::size_t owned() const { return table_.owned(); }
  [[nodiscard]] std::size_t rows() const { return table_.rows(); }
  [[nodiscard]] int column(Field f) const { return column_[static_cast<std::size_t>(f)]; }
  [[nodiscard]] decomp::Table& table() {
    settle();
    return table_;
  }
  [[nodiscard]] const decomp::Table& table() const {
    settle();
    return table_;
  }

  /// Pointer to row 0; `components` values a row. nullptr if the scene does not have the field.
  template <Field F>
  [[nodiscard]] field_type<F>* data() {
    if constexpr (in_lines.has(F) || F == Field::radius || F == Field::mass || F == Field::group) settle();
    return has(F) ? table_.as<field_type<F>>(column(F)) : nullptr;
  }
  template <Field F>
  [[nodiscard]] const field_type<F>* data() const {
    if constexpr (in_lines.has(F)) settle();
    return has(F) ? std::as_const(table_).as<field_type<F>>(column(F)) : nullptr;
  }

  /// What a sweep over contacts changes of grains lives in lines from lines() on, until anyone asks for a column of it.
  static constexpr FieldSet in_lines{Field::position, Field::velocity, Field::spin};
  [[nodiscard]] GrainLines& lines();
  [[nodiscard]] bool has_lines() const { return lines_ != nullptr; }
  [[nodiscard]] RowPlaces places() const {
    if (has_lines()) return {lines_->motion.data(), GrainLines::motion_width * sizeof(double)};
    return {data<Field::position>(), static_cast<std::size_t>(dim_) * sizeof(std::int64_t)};
  }

 private:
  void settle() const {
    if (has_lines()) leave_lines();
  }
  void leave_lines() const;

  int dim_;
  FieldSet fields_;
  std::array<int, field_count> column_{};
  mutable decomp::Table table_;
  mutable std::unique_ptr<GrainLines> lines_;
};

/// Fields of `fields` that are state, in the order of the field table.
[[nodiscard]] inline FieldSet state_of(FieldSet fields) {
  FieldSet out;
  for (Field f : fields.list())
    if (info(f).state) out |= FieldSet{f};
  return out;
}

/// A wall that grains touch, as it is now. The scene says where it started.
struct WallState {
  std::array<std::int64_t, 3> offset{};  ///< way since the start [quanta of position]
  std::array<double, 3> velocity{};      ///< [m/s]
  std::array<std::int64_t, 3> force{};   ///< of the grains on it in the last step [quanta of force]
  friend bool operator==(const WallState&, const WallState&) = default;
};

/// Volume of all particles that move, mass / density in units of spacing^D 2^-26, in scenes that shift
/// particles and have no free surface; else 0. Integers, so that ranks may add in any order.
struct FluidVolume {
  std::int64_t start = 0, now = 0;
  friend bool operator==(const FluidVolume&, const FluidVolume&) = default;
};

/// How the particles that move do so together, in scenes that shift them; else 0.
struct CommonMotion {
  std::array<double, 3> velocity{};  ///< mean of theirs [m/s]
  double unlike = 0;                 ///< mean difference from it, of eighth powers [m/s]
  double largest = 0;                ///< difference from the mean of the step before [m/s]
  friend bool operator==(const CommonMotion&, const CommonMotion&) = default;
};
/// Its sums over a rank's particles, in integers, so that ranks may add in any order: their number, how much
/// their velocities differ from the mean known before, and the eighth powers of that, in four digits.
struct MotionSums {
  std::array<std::int64_t, 8> sums{};
  double largest = 0;  ///< of the differences [m/s]
};

/// The last flow of melts; and in scenes of grains in melts, when it is found anew.
struct FlowClock {
  double interval = 0;          ///< from the last flow to the next [s]
  std::int64_t left = 0;        ///< steps of it; 0: the next step begins with a flow
  std::int64_t iterations = 0;  ///< that the last flow took
  double residual = 0;          ///< that it was left with
  friend bool operator==(const FlowClock&, const FlowClock&) = default;
};

/// A rigid body (models/rigid_bodies.hpp): what it is, where it is, what acts on it.
struct BodyShape {
  double mass = 0;       ///< [kg], in 2D per metre
  double heaviness = 0;  ///< mass that gravity acts on, less what a background bears [kg]
  double radius = 0;     ///< of the particle that is the furthest from the centre of mass [m]
  std::array<double, 6>
      inertia{};  ///< about that at the start: xx yy zz xy xz yz; in 2D zz is all three [kg m^2]
  friend bool operator==(const BodyShape&, const BodyShape&) = default;
};
struct BodyMotion {
  std::array<std::int64_t, 3> centre{};      ///< of mass, through periods without a jump [quanta of position]
  std::array<double, 3> velocity{};          ///< of the centre, half a step after it [m/s]
  std::array<double, 4> turn{1, 0, 0, 0};    ///< since the start: a unit quaternion, its scalar first
  double angle = 0;                          ///< ... in 2D, all turns counted
  std::array<double, 3> angular_momentum{};  ///< about the centre, half a step after it [kg m^2/s]
  std::array<double, 3> spin{};  ///< that of this momentum where the body is turned to now [rad/s]
  friend bool operator==(const BodyMotion&, const BodyMotion&) = default;
};
struct BodyLoad {
  std::array<double, 3> force{}, torque{};  ///< in the last step, torque about the centre [N], [N m]
  /// Means of what that accelerates it by, over h / c of the fluid; 0 without one.
  std::array<double, 3> acceleration{}, angular_acceleration{};
  friend bool operator==(const BodyLoad&, const BodyLoad&) = default;
};
struct BodyState {
  BodyShape shape;
  BodyMotion motion;
  BodyLoad load;
  friend bool operator==(const BodyState&, const BodyState&) = default;
};

/// All numbers of a body in their order, with what they are called: `see(name, index, number)`.
template <class Body, class See>
void for_each_number(Body& body, See&& see) {
  const auto all = [&](const char* name, auto& numbers) {
    for (std::size_t k = 0; k < numbers.size(); ++k) see(name, k, numbers[k]);
  };
  see("mass", std::size_t{0}, body.shape.mass);
  see("heaviness", std::size_t{0}, body.shape.heaviness);
  see("radius", std::size_t{0}, body.shape.radius);
  all("inertia", body.shape.inertia);
  all("centre", body.motion.centre);
  all("velocity", body.motion.velocity);
  all("turn", body.motion.turn);
  see("angle", std::size_t{0}, body.motion.angle);
  all("angular_momentum", body.motion.angular_momentum);
  all("spin", body.motion.spin);
  all("force", body.load.force);
  all("torque", body.load.torque);
  all("acceleration", body.load.acceleration);
  all("angular_acceleration", body.load.angular_acceleration);
}
/// What has come in through an inlet or an insertion, or left through an outlet or a face, since the start.
struct Passage {
  std::int64_t count = 0;            ///< of particles
  std::array<double, 7> amounts{};   ///< as core/budget.hpp counts them [kg, kg, J, J, kg, kg, J]
  std::array<double, 3> momentum{};  ///< [kg m/s]
  double kinetic_energy = 0;         ///< [J]
  /// Of an inlet with a pressure: mean speed of what flows in [m/s]; of other boxes: how the pressure beside them grows
  /// along the axis, but for weight, a mean over time [Pa/m]; of an insertion: what it has not put in yet, as the next grain
  /// is heavier than that [kg].
  double beside = 0;
  friend bool operator==(const Passage&, const Passage&) = default;
};

/// How particles come and go, in scenes where they do: of each inlet, of each outlet, of the faces, of each insertion.
struct Throughput {
  std::vector<Passage> passages;
  std::uint64_t id_stride =
      0;  ///< above all ids of the start: the particle that follows on id has id + id_stride, the n-th inserted id_stride + n
  friend bool operator==(const Throughput&, const Throughput&) = default;
};

/// Of a [[reset]] into which mass flows.
struct Inflow {
  std::int64_t receivers =
      0;           ///< how many particles it went into in the last step, or were in the box at the start
  double due = 0;  ///< what has not come in yet, as those in the next step are another number [kg]
  friend bool operator==(const Inflow&, const Inflow&) = default;
};

/// State that belongs to no particle. Checkpointed and fingerprinted with the particles.
struct GlobalState {
  std::int64_t step = 0;
  double time = 0;              ///< [s]
  double dt = 0;                ///< of the next step [s]
  double max_speed = 0;         ///< of all particles after the last step [m/s]
  double max_acceleration = 0;  ///< [m/s^2]
  std::vector<WallState> walls;
  FluidVolume fluid_volume;
  CommonMotion motion;
  FlowClock flow;
  std::vector<BodyState> bodies{};  ///< rigid ones, in the order of their groups
  Throughput throughput{};
  std::vector<Inflow> inflows{};  ///< in the order of the resets that have one
  friend bool operator==(const GlobalState&, const GlobalState&) = default;
};

/// One fixed-point scale for the scene: positions are integers times a power of two [m].
struct PositionScale {
  double quantum = 1;                    ///< [m], a power of two
  std::array<std::int64_t, 3> origin{};  ///< quanta of the domain's lower corner
  [[nodiscard]] double metres(std::int64_t x) const { return static_cast<double>(x) * quantum; }
  /// Rounded to nearest even. |metres / quantum| < 2^62, and the division by a power of two is exact.
  [[nodiscard]] std::int64_t quanta(double metres) const {
    return static_cast<std::int64_t>(std::nearbyint(metres / quantum));
  }
};

/// Periodic domain in quanta; period 0 on axes that are not periodic. Between rebuilds a particle may be
/// stored outside the domain; whatever is compared (files, fingerprint) takes its wrapped coordinate.
struct Wrap {
  std::array<std::int64_t, 3> origin{};
  std::array<std::int64_t, 3> period{};
  /// x brought into [origin, origin + period) on a periodic axis: exact.
  [[nodiscard]] std::int64_t operator()(int axis, std::int64_t x) const {
    const auto a = static_cast<std::size_t>(axis);
    if (period[a] == 0) return x;
    const std::int64_t above = (x % period[a] - origin[a] % period[a]) % period[a];  // of any x
    return origin[a] + (above < 0 ? above + period[a] : above);
  }
};

}  // namespace sph

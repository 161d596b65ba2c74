#include "sph/core/grain_lines.hpp"

#include "decomp/poison.hpp"
#include "sph/core/particles.hpp"

namespace sph {
namespace {

constexpr std::size_t motion_width = GrainLines::motion_width, spin_width = GrainLines::spin_width;

}  // namespace

void GrainLines::poison(FieldSet fields, std::size_t owned) {
  const auto part = [&](Field f, decomp::LargeVector<double>& of, std::size_t line, std::size_t first) {
    if (!fields.has(f)) return;
    for (std::size_t k = owned * line; k < of.size(); k += line)
      decomp::poison(reinterpret_cast<std::byte*>(of.data() + k + first), 3 * sizeof(double));
  };
  part(Field::position, motion, motion_width, 0);
  part(Field::velocity, motion, motion_width, 4);
  part(Field::spin, spin, spin_width, 0);
}

GrainLines& Particles::lines() {
  if (has_lines()) return *lines_;
  const auto* x = data<Field::position>();
  const auto *v = data<Field::velocity>(), *w = data<Field::spin>();
  const auto *radius = data<Field::radius>(), *mass = data<Field::mass>();
  const auto* group = data<Field::group>();
  auto lines = std::make_unique<GrainLines>();
  lines->motion.resize(rows() * motion_width);
  lines->spin.resize(rows() * spin_width);
  for (std::size_t i = 0; i < rows(); ++i) {
    double *m = lines->motion.data() + i * motion_width, *s = lines->spin.data() + i * spin_width;
    std::memcpy(m, x + i * 3, 3 * sizeof(double));
    m[3] = radius[i];
    std::memcpy(m + 4, v + i * 3, 3 * sizeof(double));
    m[7] = mass[i];
    if (w != nullptr) std::memcpy(s, w + i * 3, 3 * sizeof(double));
    s[3] = group[i];
  }
  lines_ = std::move(lines);
  return *lines_;
}

void Particles::leave_lines() const {
  const std::unique_ptr<GrainLines> lines = std::move(lines_);
  auto* x = table_.as<std::int64_t>(column(Field::position));
  auto* v = table_.as<double>(column(Field::velocity));
  double* w = has(Field::spin) ? table_.as<double>(column(Field::spin)) : nullptr;
  for (std::size_t i = 0; i < rows(); ++i) {
    const double *m = lines->motion.data() + i * motion_width, *s = lines->spin.data() + i * spin_width;
    std::memcpy(x + i * 3, m, 3 * sizeof(double));
    std::memcpy(v + i * 3, m + 4, 3 * sizeof(double));
    if (w != nullptr) std::memcpy(w + i * 3, s, 3 * sizeof(double));
  }
}

}  // namespace sph

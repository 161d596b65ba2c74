#include "models/crack_plane.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "sph/terms/added_term.hpp"

namespace sph {
namespace {

using Vector = std::array<double, 3>;

/// In particles: a crack turns within some spacings, not with the noise of its tip.
constexpr double memory = 4;
/// K_II / K_I over shear / tension at the particle at the tip.
constexpr double tip_shear = 1.85;
/// Erdogan & Sih's angle is 70.5 degrees at most, that of a plane that is only sheared.
constexpr double most_slope = 1.23;

double dot(const Vector& a, const Vector& b) { return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]; }

Vector traction(const SymmetricTensor& s, const Vector& m) {
  return {s[0] * m[0] + s[3] * m[1] + s[4] * m[2], s[3] * m[0] + s[1] * m[1] + s[5] * m[2],
          s[4] * m[0] + s[5] * m[1] + s[2] * m[2]};
}

double size_of(const SymmetricTensor& s) {
  double size = 0;
  for (const double component : s) size += std::fabs(component);
  return size;
}

CrackPlane moved(const CrackPlane& plane, const Vector& by, double part) {
  Vector normal = plane.normal;
  for (std::size_t a = 0; a < 3; ++a) normal[a] += part * by[a];
  const double length = std::sqrt(dot(normal, normal));
  for (double& component : normal) component /= length;
  return {normal, plane.distance * dot(normal, plane.normal)};
}

}  // namespace

SymmetricTensor in_space(const double* s, int dim) {
  if (dim == 3) return {s[0], s[1], s[2], s[3], s[4], s[5]};
  return {s[0], s[1], -2 * (std::fabs(s[0]) + std::fabs(s[1]) + std::fabs(s[2])), s[2], 0, 0};
}

CrackPlane plane_of(const double* sums, int dim) {
  const SymmetricTensor weights = in_space(sums + dim, dim);
  CrackPlane out{principal_axes(weights).axes[0], 0};
  for (int a = 0; a < dim; ++a) out.distance += out.normal[static_cast<std::size_t>(a)] * sums[a];
  out.distance /= dot(out.normal, traction(weights, out.normal));
  return out;
}

CrackPlane plane_of_tension(const SymmetricTensor& s, std::span<const double> along) {
  Vector n{};
  std::ranges::copy(along, n.begin());
  const double square = dot(n, n);
  if (square == 0) return {principal_axes(s).axes[0], 0};
  // P s P less so much of n n that it comes last, P = 1 - n n.
  const double length = std::sqrt(square);
  for (double& component : n) component /= length;
  const Vector t = traction(s, n);
  const double more = dot(n, t) - 4 * size_of(s);
  SymmetricTensor projected = s;
  for (int a = 0; a < 3; ++a)
    for (int b = a; b < 3; ++b) {
      const auto i = static_cast<std::size_t>(a), j = static_cast<std::size_t>(b);
      projected[static_cast<std::size_t>(symmetric_index(a, b, 3))] +=
          more * (n[i] * n[j]) - t[i] * n[j] - n[i] * t[j];
    }
  return {principal_axes(projected).axes[0], 0};
}

double tension_across(const CrackPlane& plane, const SymmetricTensor& s) {
  return dot(plane.normal, traction(s, plane.normal));
}

double strain_across(const CrackPlane& plane, const SymmetricTensor& deviator, double pressure,
                     const Group& rock) {
  return tension_across(plane, deviator) / (2 * rock.solid.shear_modulus) -
         pressure / (3 * rock.eos.bulk_modulus);
}

CrackPlane turned(const CrackPlane& plane, const SymmetricTensor& s, double inside) {
  const Vector t = traction(s, plane.normal);
  const double across = dot(plane.normal, t) + inside;
  if (!(across > 0)) return plane;
  Vector shear{};
  for (std::size_t a = 0; a < 3; ++a) shear[a] = t[a] - dot(plane.normal, t) * plane.normal[a];
  const double slope = 2 * tip_shear * std::sqrt(dot(shear, shear)) / across;
  return moved(plane, shear, 2 * tip_shear / (across * std::max(1.0, slope / most_slope)));
}

CrackPlane gone_on(const CrackPlane& plane, const CrackPlane& here) {
  Vector change{};
  const double sign = dot(plane.normal, here.normal) < 0 ? -1 : 1;
  for (std::size_t a = 0; a < 3; ++a) change[a] = sign * here.normal[a] - plane.normal[a];
  return moved(plane, change, 1 / memory);
}

}  // namespace sph

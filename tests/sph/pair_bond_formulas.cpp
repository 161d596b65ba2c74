// The formulas of bonds: of total-Lagrangian solids, whole and cracked.
#include <cmath>
#include <string>

#include "pair_oracle.hpp"

namespace sph::test {

PairOracle::Bond PairOracle::bond(const Pair& pair) const {
  Bond out{Vec::Zero(), Vec::Zero()};
  for (std::size_t a = 0; a < 3; ++a) {
    const std::int64_t then = pair.j.reference[a] - pair.i.reference[a];
    out.X(static_cast<Eigen::Index>(a)) = static_cast<double>(then) * of_.quantum();
    out.u(static_cast<Eigen::Index>(a)) =
        static_cast<double>(pair.j.x[a] - pair.i.x[a] - then) * of_.quantum();
  }
  return out;
}

bool PairOracle::faces(const Pair& pair, double cosine) const {
  const Vec X = bond(pair).X;
  const double at_i = pair.i.crack.dot(X), at_j = -pair.j.crack.dot(X), least = cosine * X.norm();
  return at_i > least * pair.i.crack.norm() && at_j > least * pair.j.crack.norm() && at_i > 0 && at_j > 0;
}

bool PairOracle::are_faces(const Pair& pair) const {
  const PairParticle &i = pair.i, &j = pair.j;
  const double reach = scene_.bond_width() / h_ * scene_.kernel_radius();
  const bool bonded = i.body == j.body && bond(pair).X.norm() < reach && !faces(pair, 0.8);
  return i.shears && j.shears && !bonded && i.crack.dot(j.crack) < 0 && faces(pair, 0);
}

// `weight`: of a bond to a particle of any body, without its unit.
void PairOracle::add_crack(const Pair& pair, double weight, PairSums& sums) const {
  const PairParticle &i = pair.i, &j = pair.j;
  const Vec X = bond(pair).X;
  const double h = scene_.bond_width(), reach = h / h_ * scene_.kernel_radius();
  auto& to = sums.of[static_cast<std::size_t>(Field::crack_sums)];
  const bool bonded =
      i.body == j.body && X.norm() < reach && pair.r < scene_.list_range() && !faces(pair, 0.8);
  if (bonded && pair.r > 0.95 * scene_.list_range()) to[0].add(1);
  const bool ahead = X(0) > 0 || (X(0) == 0 && (X(1) > 0 || (X(1) == 0 && X(2) > 0)));
  if (bonded && (j.overload > i.overload || (j.overload == i.overload && ahead))) to[1].add(1);
  if (!j.failing) return;
  const Vec m = j.crack.norm() > 0 ? Vec(j.crack.normalized()) : Vec(Vec::Zero());
  const double distance = j.crack_distance - m.dot(X) / h;
  const double parts = std::fabs(j.crack_distance) + m.cwiseAbs().dot(X.cwiseAbs()) / h;
  for (int a = 0; a < dim_; ++a) {
    to[static_cast<std::size_t>(2 + a)].add(weight * X(a) / h);
    to[static_cast<std::size_t>(2 + dim_ + a)].add(weight * m(a) * distance,
                                                   std::fabs(weight * m(a)) * parts);
    for (int b = a; b < dim_; ++b)
      to[static_cast<std::size_t>(2 + 2 * dim_ + symmetric_index(a, b, dim_))].add(weight * m(a) * m(b));
  }
}

void PairOracle::add_bond(const Pair& pair, Term term, PairSums& sums) const {
  const PairParticle &i = pair.i, &j = pair.j;
  const Vec& x = pair.x;
  const double r = pair.r, h = scene_.bond_width(), reach = h / h_ * scene_.kernel_radius();
  const auto [X, u_now] = bond(pair);
  Vec u = u_now;
  // Beyond the range of lists a bond is lost.
  const double R = X.norm(), weight = r < scene_.list_range() ? -dw(R, h) / R : 0.0,
               both = i.rest_volume * j.rest_volume;
  const auto bare = [&](double value) { return this->bare(value) * power(h / h_, dim_); };
  if (term.name == "CrackSums") return add_crack(pair, bare(weight) * h * h, sums);
  const bool cracked = term.name.starts_with("Cracked");
  if (i.body != j.body || (cracked && faces(pair, 0.8))) return;
  const auto one = [&](Field f, int k, double value) {
    sums.of[static_cast<std::size_t>(f)][static_cast<std::size_t>(k)].add(value);
  };
  Vec force = Vec::Zero();
  if (term.name == "ClampSums" || term.name == "ClampReaction") {
    if (j.mover != (term.name == "ClampSums")) return;
    const double part = R < reach && r < scene_.list_range() ? bare(w(R, h)) : 0.0;
    if (term.name == "ClampSums") one(Field::clamp_sums, 0, part);
    for (int a = 0; a < dim_; ++a) {
      if (term.name == "ClampReaction") {
        one(Field::clamp_push, a, part * j.reaction(a));
        continue;
      }
      one(Field::clamp_sums, 1 + a, part * u(a) / h);
      one(Field::clamp_sums, 1 + dim_ + a, part * X(a) / h);
    }
    return;
  }
  u += j.shift - i.shift;
  if (term.name.ends_with("Deformation")) {
    const double bare_weight = bare(weight) * h * h * j.rest_volume / power(scene_.start.spacing, dim_);
    one(Field::deformation, 0, R < reach && r < scene_.list_range() ? 1 : 0);
    one(Field::deformation, 1, bare_weight * u.squaredNorm() / (h * h));
    for (int a = 0; a < dim_; ++a) {
      for (int b = a; b < dim_; ++b)
        one(Field::deformation, 2 + symmetric_index(a, b, dim_), bare_weight * X(a) * X(b) / (h * h));
      for (int b = 0; b < dim_; ++b)
        one(Field::deformation, 2 + dim_ * (dim_ + 1) / 2 + a * dim_ + b,
            bare_weight * u(a) * X(b) / (h * h));
    }
    return;
  }
  if (term.name.ends_with("BondForce"))
    force = both * weight * ((i.bond_stress + j.bond_stress) * X + (i.hourglass + j.hourglass) * u);
  else
    force =
        2 * (dim_ + 2) * 0.5 * (i.viscosity + j.viscosity) * both * weight * (j.v - i.v).dot(x) * x / (r * r);
  for (int a = 0; a < dim_; ++a) one(Field::force, a, force(a));
}

}  // namespace sph::test

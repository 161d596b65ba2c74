// What a grain touches of a mesh, while it moves and the mesh turns under it: sweeps, which look at few facets, find what those find
// that look at all.
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "sph/pairs/facet_contacts.hpp"

namespace sph {
namespace {

constexpr double quantum = 0x1p-40;
constexpr std::size_t lanes = ContactGroups::lanes;

/// Bumpy ground of 2 n^2 triangles with edges of about 0.1.
TriangleSurface ground(std::mt19937_64& random, std::uint32_t n) {
  std::uniform_real_distribution<double> shift(-0.02, 0.02);
  std::vector<Point3> vertices;
  std::vector<TriangleSurface::Triangle> triangles;
  for (std::uint32_t j = 0; j <= n; ++j)
    for (std::uint32_t i = 0; i <= n; ++i)
      vertices.push_back(
          {0.1 * i - 0.05 * n + shift(random), 0.1 * j - 0.05 * n + shift(random), shift(random)});
  for (std::uint32_t j = 0; j < n; ++j)
    for (std::uint32_t i = 0; i < n; ++i) {
      const std::uint32_t v = j * (n + 1) + i;
      triangles.push_back({v, v + 1, v + n + 2});
      triangles.push_back({v, v + n + 2, v + n + 1});
    }
  return {vertices, triangles};
}

class FacetContactsTest : public ::testing::Test {
 protected:
  FacetContactsTest() {
    mesh_.surface = &surface_;
    mesh_.rotation = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}};
    mesh_.smooth_cosine = std::cos(0.1);
    mesh_.present = mesh_.listed = true;
    const std::size_t groups = (surface_.size() + lanes - 1) / lanes;
    list_.i.assign(groups * lanes, 0);
    list_.j.assign(groups * lanes, ContactGroups::no_wall);
    for (std::uint32_t f = 0; f < surface_.size(); ++f) list_.j[f] = f;
    list_.touching.assign(groups, 0);
    list_.facets.runs.push_back({0, surface_.size(), 0});
    list_.facets.near.resize(groups * lanes);
    all_ = {0, 1, {}, {}, {0, groups}, {0, 1}};
    grain_.table().resize(1, 0);
    *grain_.data<Field::radius>() = 0.35;
    place({0, 0, 0.34});
  }
  void place(const Point3& x) {
    for (std::size_t a = 0; a < 3; ++a)
      grain_.data<Field::position>()[a] = static_cast<std::int64_t>(x[a] / quantum);
  }
  void turn(double angle) {
    mesh_.rotation = {
        {{std::cos(angle), -std::sin(angle), 0}, {std::sin(angle), std::cos(angle), 0}, {0, 0, 1}}};
  }
  /// Looks twice, expects the same, and returns how many there are.
  std::size_t look(FacetRuns& kept) {
    const WallsNow walls{{}, {mesh_}};
    FacetContacts few(walls, quantum), every(walls, quantum);
    const auto a = few.look(list_, kept, all_, GrainPlaces(grain_)),
               b = every.look(list_, GrainPlaces(grain_));
    EXPECT_EQ(a.size(), b.size());
    for (std::size_t k = 0; k < std::min(a.size(), b.size()); ++k) {
      EXPECT_EQ(a[k].entry, b[k].entry);
      EXPECT_EQ(a[k].distance, b[k].distance);
      EXPECT_EQ(a[k].away, b[k].away);
      EXPECT_EQ(few.at(a[k].entry), &a[k]);
      EXPECT_TRUE(few.any_in(a[k].entry / lanes));
    }
    return a.size();
  }

  std::mt19937_64 random_{11};
  TriangleSurface surface_ = ground(random_, 30);
  MeshNow mesh_{};
  ContactGroups list_;
  ContactBlock all_{};
  Particles grain_{3, {Field::position, Field::radius}};
};

TEST_F(FacetContactsTest, AreThoseOfAllFacets) {
  std::uniform_real_distribution<double> part(-1, 1), size(-4, -0.5);
  Point3 x{0, 0, 0.34};
  FacetRuns kept = list_.facets;
  std::size_t touched = 0, looks = 0, near = 0;
  constexpr int steps = 4000;
  for (int n = 0; n < steps; ++n) {
    const double step = 0.35 * std::pow(10, size(random_));
    for (std::size_t a = 0; a < 2; ++a) x[a] = std::clamp(x[a] + step * part(random_), -1.0, 1.0);
    x[2] = std::clamp(x[2] + 0.2 * step * part(random_), 0.32, 0.37);
    place(x);
    turn(1e-3 * n);
    const Point3 before = kept.runs[0].at;
    touched += look(kept);
    looks += kept.runs[0].at != before ? 1 : 0;
    near += kept.runs[0].near;
  }
  EXPECT_GT(touched, steps / 2U);
  EXPECT_LT(looks, steps / 2U);
  EXPECT_LT(near, steps * surface_.size() / 50);
}

// A grain that rests looks at what is near, and no more at all others.
TEST_F(FacetContactsTest, KeepWhatWasNear) {
  FacetRuns kept = list_.facets;
  look(kept);
  const Point3 seen = kept.runs[0].at;
  place({1e-3, 0, 0.34});
  look(kept);
  EXPECT_EQ(kept.runs[0].at, seen);
  turn(1);
  place({0.2, 0, 0.34});
  look(kept);
  EXPECT_NE(kept.runs[0].at, seen);
}

}  // namespace
}  // namespace sph

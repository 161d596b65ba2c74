// Balls of steel that meet meshes, whose files are made for a test.
#pragma once

#include <unistd.h>

#include <array>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

#include "sph/step/simulation.hpp"

namespace mesh_balls {

using Point = std::array<double, 3>;

/// Files of a test, gone with it.
class Files {
 public:
  Files()
      : folder_(std::filesystem::temp_directory_path() / ("peperite_meshes_" + std::to_string(getpid()))) {
    std::filesystem::create_directories(folder_);
  }
  ~Files() {
    std::error_code ignored;
    std::filesystem::remove_all(folder_, ignored);
  }
  Files(const Files&) = delete;
  Files& operator=(const Files&) = delete;
  std::string add(const std::string& name, const std::string& text) const {
    std::ofstream(folder_ / name) << text;
    return (folder_ / name).string();
  }

 private:
  std::filesystem::path folder_;
};

/// An OBJ file as it grows.
class Mesh {
 public:
  int vertex(const Point& p) {
    char line[128];
    (void)std::snprintf(line, sizeof line, "v %.9g %.9g %.9g\n", p[0], p[1], p[2]);
    text_ += line;
    return ++vertices_;
  }
  void facet(int a, int b, int c) {
    text_ += "f " + std::to_string(a) + ' ' + std::to_string(b) + ' ' + std::to_string(c) + '\n';
  }
  /// Of n x m quadrilaterals between points of a grid.
  template <class At>
  void sheet(int n, int m, At&& at) {
    const int first = vertices_ + 1;
    for (int i = 0; i <= n; ++i)
      for (int j = 0; j <= m; ++j) vertex(at(i, j));
    for (int i = 0; i < n; ++i)
      for (int j = 0; j < m; ++j) {
        const int a = first + i * (m + 1) + j, b = a + m + 1;
        facet(a, b, b + 1);
        facet(a, b + 1, a + 1);
      }
  }
  [[nodiscard]] const std::string& text() const { return text_; }

 private:
  std::string text_;
  int vertices_ = 0;
};

inline const std::string steel = R"(
dimension = 3
[contact]
law = "linear"
[[group]]
name = "steel"
kind = "grain"
diameter = 0.2
density = 2500
normal_stiffness = 1e5
tangential_stiffness = 5e4
)";

struct Ball {
  Point x, v, w;
};

inline std::string start_of(const Files& files, const std::vector<Ball>& balls) {
  std::string rows = "id,x,y,z,vx,vy,vz,wx,wy,wz,group,radius\n";
  char line[256];
  for (std::size_t k = 0; k < balls.size(); ++k) {
    const Ball& b = balls[k];
    (void)std::snprintf(line, sizeof line,
                        "%zu,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,%.17g,0,0.1\n", k, b.x[0],
                        b.x[1], b.x[2], b.v[0], b.v[1], b.v[2], b.w[0], b.w[1], b.w[2]);
    rows += line;
  }
  return "[start]\nfile = \"" + files.add("start.csv", rows) + "\"\n";
}

inline Ball ball(const sph::Simulation& s) {
  const sph::Particles& p = s.particles();
  Ball out{};
  for (std::size_t a = 0; a < 3; ++a) {
    out.x[a] = s.scale().metres(p.data<sph::Field::position>()[a]);
    out.v[a] = p.data<sph::Field::velocity>()[a];
    if (p.has(sph::Field::spin)) out.w[a] = p.data<sph::Field::spin>()[a];
  }
  return out;
}

/// After so long, and what is seen on the way.
template <class See>
inline Ball run(const std::string& text, double until, See&& see) {
  const decomp::Comm comm(MPI_COMM_SELF);
  sph::Simulation s(comm, sph::parse_scene(text + "until = 1e9\n", "mesh.toml", {}));
  while (s.global().time < until) {
    s.step();
    see(s);
  }
  return ball(s);
}
inline Ball run(const std::string& text, double until) {
  return run(text, until, [](const sph::Simulation&) {});
}

}  // namespace mesh_balls

// Regions of a start as a scene has them.
#pragma once

#include <string>

namespace sph::test {

inline std::string region(const std::string& group, const std::string& shape) {
  return "[[start.region]]\ngroup = \"" + group + "\"\n" + shape;
}
inline std::string box(const std::string& lower, const std::string& upper) {
  return "shape = \"box\"\nlower = " + lower + "\nupper = " + upper + "\n";
}
inline std::string ball(const std::string& centre, double radius) {
  return "shape = \"ball\"\ncentre = " + centre + "\nradius = " + std::to_string(radius) + "\n";
}

}  // namespace sph::test

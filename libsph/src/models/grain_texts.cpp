#include "models/grain_texts.hpp"

#include <array>

#include "sph/core/findings.hpp"

namespace sph {

std::string text_of_place(const Scene& scene, const PositionScale& scale, const std::int64_t* quanta) {
  const Wrap wrap = wrap_of(scene, scale);
  std::array<double, 3> at;
  for (std::size_t a = 0; a < 3; ++a) at[a] = scale.metres(wrap(static_cast<int>(a), quanta[a]));
  return place_text(at);
}

}  // namespace sph

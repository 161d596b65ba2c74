#include "terms/fusion_list.hpp"

namespace sph {
std::vector<Fusion> fusions_2d_float() { return FusionList<float, 2>::all(); }
}  // namespace sph

#include "terms/fusion_list.hpp"

namespace sph {
std::vector<Fusion> fusions_3d_float() { return FusionList<float, 3>::all(); }
}  // namespace sph

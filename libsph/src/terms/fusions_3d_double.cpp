#include "terms/fusion_list.hpp"

namespace sph {
std::vector<Fusion> fusions_3d_double() { return FusionList<double, 3>::all(); }
}  // namespace sph

#include "terms/fusion_list.hpp"

namespace sph {
std::vector<Fusion> fusions_2d_double() { return FusionList<double, 2>::all(); }
}  // namespace sph

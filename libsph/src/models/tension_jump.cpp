// Surface tension as a jump of the pressure: the sums that find the interface's curvature, before the one of
// the forces (terms/interface_curvature.hpp, terms/tension_jump.hpp).
#include "pairs/for_rows.hpp"
#include "sph/models/models.hpp"
#include "sph/terms/interface_curvature.hpp"

namespace sph {
namespace {

struct FindCurvature {
  static constexpr FieldSet reads{Field::curvature_sums};
  static constexpr FieldSet writes{Field::curvature};
  const Scene* scene;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const double* sums = p.get<Field::curvature_sums>();
    double* curvature = p.get<Field::curvature>();
    const double scale = (p.dim() - 1) / scene->kernel.smoothing_length;
    for_movers(step.ranges, [&](std::size_t i) {
      const double* s = sums + 2 * i;
      curvature[i] = s[1] > 0 ? scale * (s[0] / s[1]) : 0.0;
    });
  }
};

// The sums leave the particle itself out, as lists are padded with it.
struct AverageCurvature {
  static constexpr FieldSet reads{Field::curvature_sums, Field::mass, Field::density, Field::colour_gradient};
  static constexpr FieldSet writes{Field::curvature};
  const SphConstants* constants;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const double* sums = p.get<Field::curvature_sums>();
    const double* mass = p.get<Field::mass>();
    const double* rho = p.get<Field::density>();
    const double* colour = p.get<Field::colour_gradient>();
    double* curvature = p.get<Field::curvature>();
    const auto d = static_cast<std::size_t>(p.dim());
    for_movers(step.ranges, [&](std::size_t i) {
      const double* s = sums + 2 * i;
      const double share = layer_share(colour + i * d, p.dim(), constants->row_scale.inverse_h);
      const double own =
          mass[i] / rho[i] * constants->row_scale.inverse_volume * share * constants->kernel_at_zero;
      curvature[i] = own > 0 ? (s[0] + own * curvature[i]) / (s[1] + own) : 0.0;
    });
  }
};

}  // namespace

void add_curvature(Builder& b) {
  b.add_fields({Field::curvature});
  b.add_sums("normals", {term<Curvature>});
  b.add_update("curvature", FindCurvature{&b.scene()});
  b.add_sums("curvatures", {term<CurvatureMean>});
  b.add_update("mean curvature", AverageCurvature{&b.constants()});
}

}  // namespace sph

// Total-Lagrangian solids: the passes of a scene of them, and what happens to a particle between the two. The
// scheme is a Hamiltonian system (terms/bonds.hpp): stress is a function of the positions alone, and nothing
// is integrated in time but position and velocity.
#include <string>

#include "sph/neo_hooke.hpp"
#include "sph/physics.hpp"

namespace sph {
namespace {

/// Least determinant of A over that of the isotropic tensor of the same trace: below it is a thread.
constexpr double least_shape = 1e-3;

/// Inverse of a symmetric tensor stored xx yy xy or xx yy zz xy xz yz, times its determinant.
template <int D>
Tensor<D> adjugate(const double* a) {
  Tensor<D> out;
  if constexpr (D == 2) {
    out << a[1], -a[2], -a[2], a[0];
  } else {
    const double xy = a[4] * a[5] - a[3] * a[2], xz = a[3] * a[5] - a[4] * a[1],
                 yz = a[3] * a[4] - a[0] * a[5];
    out << a[1] * a[2] - a[5] * a[5], xy, xz, xy, a[0] * a[2] - a[4] * a[4], yz, xz, yz,
        a[0] * a[1] - a[3] * a[3];
  }
  return out;
}

/// The sums of terms/bonds.hpp for one particle, with their scale undone.
template <int D>
struct BondSums {
  double count, square, shape;
  Tensor<D> inverse;   ///< A^-1
  Tensor<D> gradient;  ///< H = B A^-1
  double residual;     ///< sum w |u - H X|^2
  BondSums(const double* sums, double scale) : count(sums[0]) {
    constexpr int n = D * (D + 1) / 2;
    const double* a = sums + 2;
    const Eigen::Map<const Tensor<D>> b(sums + 2 + n);
    const Tensor<D> adjugate_of_a = adjugate<D>(a);
    double determinant = 0, trace = 0;
    for (int k = 0; k < D; ++k) {
      determinant += a[symmetric_index(0, k, D)] * adjugate_of_a(k, 0);
      trace += a[k];
    }
    const double mean = trace / D;
    shape = determinant / (D == 2 ? mean * mean : mean * mean * mean);
    gradient = b * adjugate_of_a / determinant;
    inverse = adjugate_of_a / (determinant * scale);
    residual = (sums[1] - gradient.cwiseProduct(b).sum()) * scale;
  }
};

}  // namespace

void Physics::build_total_lagrangian() {
  std::vector<Term> deformation{Term::deformation}, forces{Term::bond_force};
  bool contact = false, viscous = false;
  for (std::size_t g = 0; g < scene_->groups.size(); ++g) {
    contact = contact || groups_.body[g] != groups_.body[0];
    viscous = viscous || (scene_->groups[g].kind == GroupKind::solid && groups_.viscosity[g] > 0);
  }
  if (contact) {
    deformation.push_back(Term::body_contact_energy);
    forces.push_back(Term::body_contact);
  }
  if (viscous) forces.push_back(Term::bond_viscosity);
  fields_ |= FieldSet{Field::displacement, Field::bonds, Field::bond_stress, Field::strain_energy};
  add_sums("deformation", deformation, Rows::all);
  add_update("stress", {Field::density, Field::stress, Field::pressure, Field::bond_stress},
             [this](Particles& p, const RowRanges& ranges, const GlobalState& global) {
               for (const RowRange& r : ranges)
                 p.dim() == 2 ? update_bonds<2>(p, r.first, r.last, global)
                              : update_bonds<3>(p, r.first, r.last, global);
             });
  plan_.start = plan_.sums;  // what bonds there are is known only from the start, and output wants the stress
  add_sums("forces", forces);
}

template <int D>
void Physics::update_bonds(Particles& p, std::size_t first, std::size_t last,
                           const GlobalState& global) const {
  constexpr std::size_t n = D * (D + 1) / 2, sums = 2 + n + D * D;
  const auto* group = p.data<Field::group>();
  const double* mass = p.data<Field::mass>();
  const double* contact = p.data<Field::contact_energy>();
  for (std::size_t i = first; i < last; ++i) {
    Eigen::Map<Tensor<D>> bond_stress(p.data<Field::bond_stress>() + i * D * D);
    double* stress = p.data<Field::stress>() + i * n;
    double& energy = p.data<Field::strain_energy>()[i];
    energy = contact != nullptr ? contact[i] : 0.0;
    const Group& own = scene_->groups[group[i]];
    if (own.kind == GroupKind::wall && own.clamps < 0) {  // rigid
      bond_stress.setZero();
      continue;
    }
    const Group& g = scene_->groups[static_cast<std::size_t>(groups_.body[group[i]])];
    const BondSums<D> bonds(p.data<Field::deformation>() + i * sums,
                            gradient_factor_ * scene_->smoothing_length);
    check_bonds(p, i, bonds.count, bonds.shape, global);
    const ElasticState<D> state = neo_hooke<D>(bonds.gradient, g.bulk_modulus, g.shear_modulus);
    const double hourglass = constants_.hourglass * groups_.modulus[group[i]];
    bond_stress = state.first_piola * bonds.inverse - hourglass * bonds.gradient;
    const double volume = mass[i] / own.density, ratio = 1 + state.volume_change;
    if (!(ratio > 0)) find_fault(p, i, global, "is turned inside out: the body is beyond elasticity");
    energy += volume * (state.energy + 0.5 * hourglass * bonds.residual);

    // For output: Cauchy stress P F^T / J; out of the plane mu (1/J - 1) + lambda' (J - 1).
    const Tensor<D> cauchy = (state.first_piola + state.first_piola * bonds.gradient.transpose()) / ratio;
    const double out_of_plane = (g.bulk_modulus + g.shear_modulus / 3) * state.volume_change -
                                g.shear_modulus * (state.volume_change / ratio);
    const double pressure = -(cauchy.trace() + (D == 2 ? out_of_plane : 0.0)) / 3;
    p.data<Field::pressure>()[i] = pressure;
    p.data<Field::density>()[i] = own.density / ratio;
    for (int a = 0; a < D; ++a)
      for (int b = a; b < D; ++b)
        stress[symmetric_index(a, b, D)] = 0.5 * (cauchy(a, b) + cauchy(b, a)) + (a == b ? pressure : 0.0);
  }
}

// A bond is lost when its particles are further apart than the lists reach. The number is exact: the
// reference state does not change. 0 is that of a particle not looked at yet.
void Physics::check_bonds(Particles& p, std::size_t i, double count, double shape,
                          const GlobalState& global) const {
  std::uint32_t& bonds = p.data<Field::bonds>()[i];
  const auto found = static_cast<std::uint32_t>(count);
  if (bonds == 0) {
    if (!(shape > least_shape))
      find_fault(p, i, global,
                 "has its " + std::to_string(found) +
                     " neighbours in one line or plane: a total-Lagrangian body must be at least two "
                     "particles across; refine start.spacing");
    bonds = found;
  }
  if (bonds != found)
    find_fault(
        p, i, global,
        "finds " + std::to_string(found) + " of its " + std::to_string(bonds) +
            " neighbours: the body is stretched beyond terms.largest_stretch; raise it or reduce time.dt");
}

void Physics::find_fault(const Particles& p, std::size_t i, const GlobalState& global,
                         const std::string& what) const {
  const std::uint64_t id = p.data<Field::id>()[i];
  findings_.add(id, [&] {
    std::vector<double> at;
    for (std::size_t a = 0; a < static_cast<std::size_t>(p.dim()); ++a)
      at.push_back(scale_.metres(p.data<Field::position>()[i * static_cast<std::size_t>(p.dim()) + a]));
    return step_text(global.step) + "particle " + std::to_string(id) + " of \"" +
           scene_->groups[p.data<Field::group>()[i]].name + "\" " + place_text(at) + " " + what;
  });
}

}  // namespace sph

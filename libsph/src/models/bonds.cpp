// Total-Lagrangian solids: sums over bonds, the stress of each particle, forces. The
// scheme is a Hamiltonian system (terms/bonds.hpp): stress is a function of the positions alone, and nothing
// is integrated in time but position and velocity.
#include "sph/terms/bonds.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <numeric>
#include <optional>
#include <string>
#include <vector>

#include "models/clamps.hpp"
#include "sph/laws/neo_hooke.hpp"
#include "sph/models/faults.hpp"
#include "sph/models/models.hpp"
#include "sph/terms/body_contact.hpp"
#include "sph/terms/crack.hpp"

namespace sph {
namespace {

/// Least determinant of A over that of the isotropic tensor of the same trace: below it is a thread.
constexpr double least_shape = 1e-3;
/// ... and so is what a crack has left, where bonds are less than some ten degrees off a line or plane.
constexpr double least_cracked_shape = 0.1;

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
  double count, shape;
  Tensor<D> inverse;   ///< A^-1
  Tensor<D> gradient;  ///< H = B A^-1
  double residual;     ///< sum w |u - H X|^2
  /// `round`: so much of an isotropic tensor is added to A.
  BondSums(const double* sums, double scale, double round = 0) : count(sums[0]) {
    constexpr int n = D * (D + 1) / 2;
    double a[n];
    std::copy_n(sums + 2, n, a);
    if (round > 0) {
      const double more = round * std::accumulate(a, a + D, 0.0);
      for (int k = 0; k < D; ++k) a[k] += more;
    }
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
  void set_free() {
    inverse.setZero();
    gradient.setZero();
    residual = 0;
  }
};

// Beyond half a spacing rows of particles find their way through each other. `energy` is half that of the contacts of
// what may be the softer side, and tells.
void check_contact(const SphConstants& k, const FaultView& p, std::size_t i, double energy,
                   const Step& step) {
  constexpr double deepest = 0.75;
  const double overlap = deepest * k.terms.contact.range;
  const double most =
      k.terms.contact.energy * k.groups.bodies.modulus[p.get<Field::group>()[i]] * overlap * overlap;
  if (most > 0 && energy > most)
    find_fault(k, p, i, step,
               "is touched by a body that has come into it by more than half of the spacing: contacts are as "
               "stiff as the "
               "softer side; raise its bulk_modulus or sound_speed, of a wall too");
}

/// By group: whether its body loses bonds as others of it, or itself, fail.
std::vector<bool> bodies_crack(const SphConstants& k) {
  const std::vector<Group>& groups = k.scene->groups;
  const auto& number = k.groups.bodies.number;
  std::vector<bool> cracks(groups.size());
  for (std::size_t g = 0; g < groups.size(); ++g)
    for (std::size_t of = 0; of < groups.size(); ++of)
      cracks[g] = cracks[g] || (number[of] == number[g] && can_fail(groups[of]));
  return cracks;
}

struct Stresses {
  static constexpr FieldSet reads =
      RangeView::reads | FieldSet{Field::contact_energy, Field::deformation, Field::prestress};
  static constexpr FieldSet writes{Field::bond_stress, Field::stress,  Field::strain_energy,
                                   Field::bonds,       Field::density, Field::pressure};
  const SphConstants* constants;
  std::vector<bool> cracks;  ///< by group

  void operator()(const View<reads, writes>& p, const Step& step) const {
    for (const RowRange& r : step.ranges)
      p.dim() == 2 ? update<2>(p, r.first, r.last, step) : update<3>(p, r.first, r.last, step);
  }

  template <int D>
  void update(const View<reads, writes>& p, std::size_t first, std::size_t last, const Step& step) const {
    constexpr std::size_t n = D * (D + 1) / 2, sums = 2 + n + D * D;
    const auto* group = p.get<Field::group>();
    const double* mass = p.get<Field::mass>();
    const double* contact = p.get<Field::contact_energy>();
    const double* prestress = p.get<Field::prestress>();
    for (std::size_t i = first; i < last; ++i) {
      Eigen::Map<Tensor<D>> bond_stress(p.get<Field::bond_stress>() + i * D * D);
      double* stress = p.get<Field::stress>() + i * n;
      double& energy = p.get<Field::strain_energy>()[i];
      const Group& own = constants->scene->groups[group[i]];
      energy = contact != nullptr && own.kind != GroupKind::fluid ? contact[i] : 0.0;
      check_contact(*constants, p, i, energy, step);
      if (is_rigid(own)) p.get<Field::pressure>()[i] = 0;
      if (!is_bonded(own)) {
        bond_stress.setZero();
        continue;
      }
      BondSums<D> bonds(p.get<Field::deformation>() + i * sums, constants->bond_factor);
      if (cracks[group[i]])
        check_cracked(p, i, bonds, step);
      else
        check(p, i, bonds.count, bonds.shape, step);
      const double before = prestress != nullptr ? prestress[i] : 0.0;
      const ElasticState<D> state =
          neo_hooke<D>(bonds.gradient, own.eos.bulk_modulus, own.solid.shear_modulus, before);
      const double hourglass = constants->groups.bodies.hourglass[group[i]];
      bond_stress = state.first_piola * bonds.inverse - hourglass * bonds.gradient;
      const double volume = mass[i] / own.density, ratio = 1 + state.volume_change;
      if (!(ratio > 0))
        find_fault(*constants, p, i, step, "is turned inside out: the body is beyond elasticity");
      energy += volume * (state.energy + 0.5 * hourglass * bonds.residual);

      // For output: Cauchy stress P F^T / J; out of the plane mu (1/J - 1) + lambda' (J - 1).
      const Tensor<D> cauchy = (state.first_piola + state.first_piola * bonds.gradient.transpose()) / ratio;
      const double out_of_plane = (own.eos.bulk_modulus + own.solid.shear_modulus / 3) * state.volume_change -
                                  own.solid.shear_modulus * (state.volume_change / ratio) - before;
      const double pressure = -(cauchy.trace() + (D == 2 ? out_of_plane : 0.0)) / 3;
      p.get<Field::pressure>()[i] = pressure;
      p.get<Field::density>()[i] = own.density / ratio;
      for (int a = 0; a < D; ++a)
        for (int b = a; b < D; ++b)
          stress[symmetric_index(a, b, D)] = 0.5 * (cauchy(a, b) + cauchy(b, a)) + (a == b ? pressure : 0.0);
      find_out_of_range(*constants, p, i, i + 1, step);
    }
  }

  // A bond is lost when its particles are further apart than the lists reach. The number is exact: the
  // reference state does not change. 0 is that of a particle not looked at yet.
  void check(const View<reads, writes>& p, std::size_t i, double count, double shape,
             const Step& step) const {
    std::uint32_t& bonds = p.get<Field::bonds>()[i];
    const auto found = static_cast<std::uint32_t>(count);
    if (bonds == 0) {
      if (!(shape > least_shape)) find_thin(p, i, count, step);
      bonds = found;
    }
    if (bonds != found)
      find_fault(
          *constants, p, i, step,
          "finds " + std::to_string(found) + " of its " + std::to_string(bonds) +
              " neighbours: the body is stretched beyond terms.largest_stretch; raise it or reduce time.dt");
  }

  // What a crack has left without bonds that span the space fails next (models/failure.cpp), with 1 for their number. Until
  // then they are as those of a thread, which bears nothing across.
  template <int D>
  void check_cracked(const View<reads, writes>& p, std::size_t i, BondSums<D>& bonds,
                     const Step& step) const {
    std::uint32_t& number = p.get<Field::bonds>()[i];
    const bool loose = !(bonds.shape > least_cracked_shape);
    if (loose && number == 0) find_thin(p, i, bonds.count, step);
    number = loose ? 1 : static_cast<std::uint32_t>(bonds.count);
    if (!loose) return;
    constexpr std::size_t sums = 2 + D * (D + 1) / 2 + D * D;
    if (bonds.count > 0)
      bonds = BondSums<D>(p.get<Field::deformation>() + i * sums, constants->bond_factor, 0.01);
    else
      bonds.set_free();
  }

  void find_thin(const View<reads, writes>& p, std::size_t i, double count, const Step& step) const {
    find_fault(*constants, p, i, step,
               fmt::format(
                   "has its {} neighbours in one line or plane: a total-Lagrangian body must be at least two "
                   "particles across; refine start.spacing",
                   static_cast<std::uint32_t>(count)));
  }
};

/// Sums of forces of the fluid stand where those of bonds stood before.
struct KeepBondForces {
  static constexpr FieldSet reads{Field::force};
  static constexpr FieldSet writes{Field::bond_force};

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const auto d = static_cast<std::size_t>(p.dim());
    const double* force = p.get<Field::force>();
    double* kept = p.get<Field::bond_force>();
    for (RowClass c : {RowClass::interior_movers, RowClass::boundary_movers}) {
      const RowRange& r = range_of(step.ranges, c);
      std::copy(force + r.first * d, force + r.last * d, kept + r.first * d);
    }
  }
};

}  // namespace

namespace {

/// Of bodies of which none deforms: they touch each other and walls.
struct Contacts {
  static constexpr FieldSet reads = FaultView::reads | FieldSet{Field::contact_energy};
  static constexpr FieldSet writes{Field::strain_energy, Field::pressure};
  const SphConstants* constants;

  void operator()(const View<reads, writes>& p, const Step& step) const {
    const double* contact = p.get<Field::contact_energy>();
    const auto* group = p.get<Field::group>();
    for (const RowRange& r : step.ranges)
      for (std::size_t i = r.first; i < r.last; ++i) {
        const Group& g = constants->scene->groups[group[i]];
        double& energy = p.get<Field::strain_energy>()[i];
        energy = contact != nullptr && g.kind != GroupKind::fluid ? contact[i] : 0.0;
        check_contact(*constants, p, i, energy, step);
        if (is_rigid(g)) p.get<Field::pressure>()[i] = 0;
      }
  }
};

void add_contacts(Builder& b) {
  const Scene& s = b.scene();
  const bool wet = has_wet_bodies(s), touch = has_body_contacts(s);
  b.add_fields({Field::strain_energy});
  // Dry bodies that touch nothing have forces too, of 0.
  if (touch || !wet)
    b.add_sums(wet ? "contacts" : "forces", {term<BodyContact>, term<BodyContactEnergy>}, Builder::Rows::all);
  b.add_update("energies of contacts", Contacts{&b.constants()});
  b.begin_with_these();
  if (!wet || !touch) return;
  b.add_fields({Field::bond_force});
  b.add_update("contacts' part of the forces", KeepBondForces{});
}

}  // namespace

void add_bodies(Builder& b) {
  const Scene& s = b.scene();
  if (!has_bonds(s)) return add_contacts(b);
  const SphConstants& k = b.constants();
  const bool cracks = has_failure(s);
  std::vector<Term> deformation{cracks ? term<CrackedDeformation> : term<Deformation>};
  std::vector<Term> forces{cracks ? term<CrackedBondForce> : term<BondForce>};
  bool contact = false, viscous = false;
  double first = -1;
  for (std::size_t g = 0; g < s.groups.size(); ++g) {
    if (s.groups[g].kind == GroupKind::fluid) continue;
    contact = contact || (first >= 0 && k.groups.bodies.number[g] != first);
    first = k.groups.bodies.number[g];
    viscous = viscous || (s.groups[g].kind == GroupKind::solid && k.groups.viscosity[g] > 0);
  }
  if (contact || cracks) {
    deformation.push_back(cracks ? term<CrackedBodyContactEnergy> : term<BodyContactEnergy>);
    forces.push_back(cracks ? term<CrackedBodyContact> : term<BodyContact>);
  }
  if (viscous) forces.push_back(cracks ? term<CrackedBondViscosity> : term<BondViscosity>);
  if (cracks) {
    deformation.push_back(term<CrackSums>);
    b.add_fields({Field::overload, Field::crack, Field::crack_distance, Field::crack_planes,
                  Field::crack_closing, Field::failing});
  }
  std::optional<Clamps> clamps;
  if (std::ranges::any_of(s.groups, [](const Group& g) { return g.wall.clamps >= 0; })) clamps.emplace(s);
  b.add_fields({Field::displacement, Field::bonds, Field::bond_stress, Field::strain_energy});
  if (clamps) clamps->add_shifts(b);
  // Of walls only how contacts strain them.
  b.add_sums("deformation", deformation, contact ? Builder::Rows::all : Builder::Rows::movers);
  b.add_update("stress", Stresses{&k, bodies_crack(k)});
  b.begin_with_these();  // what bonds there are is known only from the start, and output wants the stress
  b.add_sums(has_wet_bodies(s) ? "bond forces" : "forces", forces);
  if (clamps) clamps->add_reactions(b);
  if (!has_wet_bodies(s)) return;
  b.add_fields({Field::bond_force});
  b.add_update("bonds' part of the forces", KeepBondForces{});
}

}  // namespace sph

#include "shuffled_start.hpp"

#include <algorithm>
#include <fstream>
#include <numeric>
#include <span>
#include <stdexcept>

#include "factors.hpp"

namespace equivalence {

bool write_shuffled_start(const std::filesystem::path& path, const sph::Simulation& s, std::uint64_t seed) {
  const sph::Particles& p = s.particles();
  const auto d = static_cast<std::size_t>(p.dim());
  const std::span<const std::int64_t> x(p.data<sph::Field::position>(), p.owned() * d);
  if (std::any_of(x.begin(), x.end(),
                  [&](std::int64_t q) { return s.scale().quanta(s.scale().metres(q)) != q; }))
    return false;
  std::vector<std::size_t> order(p.owned());
  std::iota(order.begin(), order.end(), std::size_t{0});
  for (std::size_t n = order.size(); n > 1; --n)
    std::swap(order[n - 1], order[draw(seed, "line" + std::to_string(n)) % n]);

  const double *gas = p.data<sph::Field::gas_content>(), *radius = p.data<sph::Field::radius>();
  const double *energy = p.data<sph::Field::specific_energy>(), *mass = p.data<sph::Field::mass>();
  std::ofstream out(path);
  out.precision(17);
  out << (d == 2 ? "id,x,y,vx,vy,group," : "id,x,y,z,vx,vy,vz,group,")
      << (radius != nullptr ? "radius" : "rho") << (gas != nullptr ? ",m" : "")
      << (energy != nullptr ? ",u,mass" : "");
  for (const std::size_t i : order) {
    out << '\n' << p.data<sph::Field::id>()[i];
    for (std::size_t a = 0; a < d; ++a) out << ',' << s.scale().metres(x[i * d + a]);
    for (std::size_t a = 0; a < d; ++a) out << ',' << p.data<sph::Field::velocity>()[i * d + a];
    out << ',' << s.scene().groups[p.data<sph::Field::group>()[i]].name << ','
        << (radius != nullptr ? radius[i] : p.data<sph::Field::density>()[i]);
    if (gas != nullptr) out << ',' << gas[i];
    if (energy != nullptr) out << ',' << energy[i] << ',' << mass[i];
  }
  out << '\n';
  if (!out.flush()) throw std::runtime_error("cannot write " + path.string());
  return true;
}

}  // namespace equivalence

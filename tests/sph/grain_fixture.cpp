#include "grain_fixture.hpp"

#include <cstdlib>
#include <filesystem>
#include <fstream>

#include "sph/checkpoint/checkpoint.hpp"

namespace sph::test {

StartFile::StartFile(const decomp::Comm& comm, const std::vector<StartGrain>& grains)
    : mine_(comm.rank() == 0) {
  std::string folder = (std::filesystem::temp_directory_path() / "grains_XXXXXX").string();
  if (mine_) {
    if (mkdtemp(folder.data()) == nullptr) throw std::runtime_error("cannot make " + folder);
    std::ofstream out(folder + "/start.csv");
    out.precision(17);
    out << "id,x,y,z,vx,vy,vz,wx,wy,wz,group,radius\n";
    for (std::size_t k = 0; k < grains.size(); ++k) {
      const StartGrain& g = grains[k];
      out << k;
      for (const Double3* values : {&g.x, &g.v, &g.w})
        for (const double value : *values) out << ',' << value;
      out << ',' << g.group << ',' << g.radius << '\n';
    }
  }
  path_ = comm.broadcast(folder, 0) + "/start.csv";
}

StartFile::~StartFile() {
  std::error_code ignored;
  if (mine_) std::filesystem::remove_all(std::filesystem::path(path_).parent_path(), ignored);
}

GrainNow grain(const Simulation& s, std::uint64_t id) {
  constexpr double none = -1e300;  // below every value that a test looks at
  std::array<double, 9> all;
  all.fill(none);
  const Particles& p = s.particles();
  for (std::size_t row = 0; row < p.owned(); ++row) {
    if (p.data<Field::id>()[row] != id) continue;
    for (std::size_t a = 0; a < 3; ++a) {
      all[a] = s.scale().metres(s.wrap()(static_cast<int>(a), p.data<Field::position>()[row * 3 + a]));
      all[3 + a] = p.data<Field::velocity>()[row * 3 + a];
      all[6 + a] = p.has(Field::spin) ? p.data<Field::spin>()[row * 3 + a] : 0.0;
    }
  }
  s.comm().max(all);
  return {{all[0], all[1], all[2]}, {all[3], all[4], all[5]}, {all[6], all[7], all[8]}};
}

std::unique_ptr<Simulation> through_a_checkpoint(const Simulation& s, const std::filesystem::path& folder) {
  const decomp::Payload contacts = s.contacts();
  std::vector<std::string> groups;
  for (const Group& g : s.scene().groups) groups.push_back(g.name);
  write_checkpoint(s.comm(), folder, s.particles(), &contacts, {s.global(), s.scale(), "", "{}"}, s.wrap(),
                   {"", s.fingerprint(), groups}, 1);
  return std::make_unique<Simulation>(s.comm(), s.scene(), find_checkpoint(s.comm(), folder));
}

}  // namespace sph::test

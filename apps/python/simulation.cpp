// The module behind peperite.Simulation (peperite/simulation.py says what it offers): a scene that Python steps. Python's
// mpi4py owns MPI.
#include "sph/step/simulation.hpp"

#include <pybind11/numpy.h>
#include <pybind11/pybind11.h>
#include <pybind11/stl.h>

#include <algorithm>
#include <optional>

#include "sph/core/error.hpp"
#include "sph/output/monitors.hpp"
#include "sph/output/snapshot.hpp"
#include "sph/run/self_check.hpp"
#include "sph/scene/scene.hpp"

namespace py = pybind11;

namespace {

class Running {
 public:
  /// `communicator`: the address of an MPI_Comm, as mpi4py gives it.
  Running(const sph::Scene& scene, std::uintptr_t communicator)
      : comm_(*reinterpret_cast<const MPI_Comm*>(communicator)),  // NOLINT: that is how mpi4py hands it on
        simulation_(comm_, scene),
        monitors_(simulation_) {}

  void step(std::int64_t steps) {
    look();
    whole_ = false;  // until all of it is done: a step that throws leaves half of one behind
    for (std::int64_t k = 0; k < steps; ++k) simulation_.step(0, accelerate_);
    whole_ = true;
  }
  /// `ask(time)` returns an array [particle][component], or raises on all ranks.
  void accelerate(const std::optional<py::function>& ask) {
    look();
    accelerate_ = {};
    if (!ask) return;
    sph::refuse_stillness(simulation_.scene());
    accelerate_ = [ask = *ask](double time, std::span<double> accelerations) {
      const py::gil_scoped_acquire held;
      const auto given = py::cast<py::array_t<double, py::array::c_style | py::array::forcecast>>(ask(time));
      std::copy_n(given.data(), accelerations.size(), accelerations.begin());
    };
  }
  /// Arrays of one length.
  void exchange(const std::vector<std::uint64_t>& gone, const std::string& group,
                const std::vector<double>& radius, const std::vector<sph::Double3>& position,
                const std::vector<sph::Double3>& velocity) {
    look();
    std::vector<sph::GivenGrain> come;
    for (std::size_t k = 0; k < radius.size(); ++k)
      come.push_back({group_of(group), radius[k], position[k], velocity[k]});
    try {
      simulation_.exchange_grains(gone, come);
    } catch (const sph::GuardError&) {  // bad input leaves all as it was
      whole_ = false;
      throw;
    }
  }
  [[nodiscard]] const sph::GlobalState& global() const { return simulation_.global(); }
  [[nodiscard]] std::string scene() const { return to_toml(simulation_.scene()); }
  [[nodiscard]] std::string fingerprint() const {
    look();
    return simulation_.fingerprint();
  }
  void save(const std::string& path) {
    look();
    write_snapshot(simulation_, path);
  }
  [[nodiscard]] std::vector<double> monitors() {
    look();
    return monitors_.values(simulation_);
  }
  [[nodiscard]] const std::vector<std::string>& monitor_names() const { return monitors_.names(); }
  [[nodiscard]] const std::vector<std::string>& monitor_units() const { return monitors_.units(); }
  [[nodiscard]] std::pair<std::size_t, int> shape() const {  ///< of a field of vectors
    return {simulation_.particles().owned(), simulation_.particles().dim()};
  }

  [[nodiscard]] std::vector<std::string_view> fields() const {
    std::vector<std::string_view> names;
    for (const sph::Field f : lasting(simulation_.particles())) names.push_back(sph::info(f).name);
    return names;
  }

  /// A copy of the owned rows: the next step may move them.
  [[nodiscard]] py::array field(const std::string& name) const {
    const sph::Particles& p = simulation_.particles();
    for (const sph::Field f : lasting(p)) {
      if (sph::info(f).name != name) continue;
      if (f == sph::Field::position) return metres(p);
      switch (sph::info(f).type) {
        case sph::Type::f64:
          return rows<double>(p, f);
        case sph::Type::i64:
          return rows<std::int64_t>(p, f);
        case sph::Type::u64:
          return rows<std::uint64_t>(p, f);
        case sph::Type::u32:
          return rows<std::uint32_t>(p, f);
      }
    }
    throw sph::InputError("no field \"" + name + "\" in this scene");
  }

 private:
  /// What rows have wherever they are.
  static std::vector<sph::Field> lasting(const sph::Particles& p) {
    return p.fields().without(sph::passing_sums).list();
  }

  static std::vector<py::ssize_t> shape(const sph::Particles& p, sph::Field f) {
    std::vector<py::ssize_t> shape{static_cast<py::ssize_t>(p.owned())};
    if (sph::info(f).shape != sph::Shape::scalar) shape.push_back(components(sph::info(f).shape, p.dim()));
    return shape;
  }

  template <class T>
  static py::array rows(const sph::Particles& p, sph::Field f) {
    py::array_t<T> out(shape(p, f), p.table().as<T>(p.column(f)));
    constexpr std::size_t six = 6;  // in the order of snapshots: xx yy zz xy yz xz
    if (sph::info(f).shape == sph::Shape::symmetric && p.dim() == 3)
      for (T* row = out.mutable_data(); row != out.data() + six * p.owned(); row += six)
        std::swap(row[4], row[5]);
    return out;
  }

  /// Within the periods.
  [[nodiscard]] py::array metres(const sph::Particles& p) const {
    py::array_t<double> out(shape(p, sph::Field::position));
    double* to = out.mutable_data();
    const std::int64_t* from = p.data<sph::Field::position>();
    const auto d = static_cast<std::size_t>(p.dim());
    for (std::size_t k = 0; k < p.owned() * d; ++k)
      to[k] = simulation_.scale().metres(simulation_.wrap()(static_cast<int>(k % d), from[k]));
    return out;
  }

  [[nodiscard]] std::uint32_t group_of(const std::string& name) const {
    const std::vector<sph::Group>& groups = simulation_.scene().groups;
    const auto found = std::ranges::find(groups, name, &sph::Group::name);
    if (found == groups.end()) throw sph::InputError("add: no group \"" + name + "\" in this scene");
    return static_cast<std::uint32_t>(found - groups.begin());
  }

  void look() const {
    if (!whole_) throw sph::GuardError("this simulation ended in the middle of a step; begin another");
  }

  bool whole_ = true;
  sph::Accelerate accelerate_;
  decomp::Comm comm_;
  sph::Simulation simulation_;
  sph::Monitors monitors_;
};

/// Errors of the library as those of the package, one line each.
void translate(std::exception_ptr thrown) {
  const auto raise = [](const char* name, const std::exception& error) {
    PyErr_SetString(py::module_::import("peperite.errors").attr(name).ptr(), error.what());
  };
  try {
    if (thrown) std::rethrow_exception(thrown);
  } catch (const sph::InputError& error) {
    raise("InputError", error);
  } catch (const sph::GuardError& error) {
    raise("GuardError", error);
  } catch (const sph::OutputError& error) {
    raise("OutputError", error);
  }
}

}  // namespace

PYBIND11_MODULE(peperite_simulation, m) {
  sph::self_check();
  py::register_exception_translator(&translate);
  using Released = py::call_guard<py::gil_scoped_release>;
  py::class_<sph::Scene>(m, "Scene").def_property_readonly("record", [](const sph::Scene& s) {
    return s.decomposition.record;
  });
  m.def("read_scene", [](const std::string& path, const std::vector<std::string>& set) {
    return sph::read_scene(path, set);
  });
  m.def("parse_scene",
        [](const std::string& text, const std::string& name, const std::vector<std::string>& set) {
          return sph::parse_scene(text, name, set, {}, true);
        });
  py::class_<Running>(m, "Simulation")
      .def(py::init<const sph::Scene&, std::uintptr_t>(), Released())
      .def("step", &Running::step, Released())
      .def("accelerate", &Running::accelerate)
      .def("exchange", &Running::exchange, Released())
      .def("save", &Running::save, Released())
      .def("fingerprint", &Running::fingerprint, Released())
      .def("monitors", &Running::monitors, Released())
      .def("monitor_names", &Running::monitor_names)
      .def("monitor_units", &Running::monitor_units)
      .def_property_readonly("shape", [](const Running& r) { return r.shape(); })
      .def("fields", &Running::fields)
      .def("field", &Running::field)
      .def_property_readonly("scene", &Running::scene)
      .def_property_readonly("time", [](const Running& r) { return r.global().time; })
      .def_property_readonly("steps", [](const Running& r) { return r.global().step; })
      .def_property_readonly("dt", [](const Running& r) { return r.global().dt; });
}

// What a local update sees of the particles: exactly the fields that it declares, those that it writes for
// writing.
#pragma once

#include <cstddef>
#include <utility>

#include "sph/core/particles.hpp"

namespace sph {

template <FieldSet Reads, FieldSet Writes>
class View {
 public:
  static constexpr FieldSet reads = Reads, writes = Writes;

  explicit View(Particles& particles) : particles_(&particles) {}
  /// Of an update that declares more.
  template <FieldSet R, FieldSet W>
  requires(Writes.without(W).empty() && Reads.without(R | W).empty()) View(const View<R, W>& other)
      : particles_(other.particles_) {}

  /// Pointer to row 0; nullptr if the scene does not have the field.
  template <Field F>
  [[nodiscard]] auto* get() const {
    static_assert((Reads | Writes).has(F), "the update does not declare this field");
    if constexpr (Writes.has(F))
      return particles_->template data<F>();
    else
      return std::as_const(*particles_).template data<F>();
  }
  [[nodiscard]] int dim() const { return particles_->dim(); }
  [[nodiscard]] std::size_t owned() const { return particles_->owned(); }

 private:
  template <FieldSet R, FieldSet W>
  friend class View;
  Particles* particles_;
};

/// The view that an update declares.
template <class Update>
using ViewOf = View<Update::reads, Update::writes>;

}  // namespace sph

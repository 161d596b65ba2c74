// What the models of a scene of fluids and solids add to it: fields, the stages of its plan.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "sph/models/body_forces.hpp"
#include "sph/models/materials.hpp"
#include "sph/models/sph_constants.hpp"
#include "sph/plan/plan.hpp"

namespace sph {

class Builder {
 public:
  /// Rows that a sum over pairs is taken for.
  enum class Rows : std::uint8_t { movers, walls, all };

  Builder(const SphConstants& constants, const Materials& materials, const BodyForces& body_forces)
      : constants_(&constants), materials_(&materials), body_forces_(&body_forces) {}

  // What updates may hold on to: it stays as long as the plan.
  [[nodiscard]] const SphConstants& constants() const { return *constants_; }
  [[nodiscard]] const Materials& materials() const { return *materials_; }
  [[nodiscard]] const BodyForces& body_forces() const { return *body_forces_; }
  [[nodiscard]] const Scene& scene() const { return *constants_->scene; }
  [[nodiscard]] FieldSet fields() const { return fields_; }
  [[nodiscard]] const Plan& plan() const { return plan_; }
  /// No sum of rows of walls wants walls as partners, nor do averages in snapshots.
  [[nodiscard]] bool walls_look_at_movers() const {
    return walls_look_at_movers_ && !scene().output.average_space;
  }

  void add_fields(FieldSet fields) { fields_ |= fields; }
  /// In the precision of the scene, or another.
  [[nodiscard]] Stage sums_over_pairs(std::string name, const std::vector<Term>& terms,
                                      Rows rows = Rows::movers, std::optional<Precision> precision = {});
  void add_sums(std::string name, const std::vector<Term>& terms, Rows rows = Rows::movers) {
    append(plan_.sums, sums_over_pairs(std::move(name), terms, rows));
  }
  void add_loop(Entry loop) { plan_.sums.push_back(std::move(loop)); }
  /// What follows from the sums before it for a particle alone.
  template <class Update>
  void add_update(std::string name, Update update) {
    append(plan_.sums, local_stage(std::move(name), std::move(update)));
  }
  template <class Update>
  void add_drift(std::string name, Update update, std::function<double(const GlobalState&)> moves) {
    append(plan_.drift, local_stage(std::move(name), std::move(update)));
    plan_.drift.back().stages.front().moves = std::move(moves);
  }
  void add_kick(Stage stage) { append(plan_.kick, std::move(stage)); }
  template <class Update>
  void add_kick(std::string name, Update update, std::function<double(const GlobalState&)> moves = {}) {
    append(plan_.kick, local_stage(std::move(name), std::move(update)));
    plan_.kick.back().stages.front().moves = std::move(moves);
  }
  /// The stages so far are what the first step wants done (Plan::start, Plan::settle).
  void begin_with_these() { plan_.start = plan_.sums; }
  void settle_with_these(std::shared_ptr<Settling> settling = {}) {
    plan_.settle = plan_.sums;
    plan_.settling = std::move(settling);
  }
  void begin_with_half_a_kick() { plan_.half_kick = true; }

 private:
  const SphConstants* constants_;
  const Materials* materials_;
  const BodyForces* body_forces_;
  FieldSet fields_;
  bool walls_look_at_movers_ = true;
  Plan plan_;
};

}  // namespace sph

// A pair term of the consumer's own: neighbours brake each other, a_i = s sum_j V_j (-W'/r h) (v_j - v_i).
#pragma once

#include "sph/terms/added_term.hpp"

struct FlowFriction {
  static constexpr std::string_view name = "FlowFriction", word = "flow_friction";
  static constexpr double most = 100;
  static constexpr std::string_view sentence = "Brakes every flow.";
  static constexpr sph::Effect effect = sph::Effect::acceleration;
  static constexpr sph::ValueSet reads{sph::Value::velocity, sph::Value::volume};
  static constexpr sph::Field writes = sph::Field::added;
  template <class Kernel, class P, class C, class S>
  static void add(const P& p, const C&, S& sums) {
    using sph::Value;
    const auto share = -(p.template j<Value::volume>() * p.f);
    for (int a = 0; a < P::dim; ++a)
      sums.template add<sph::Field::added>(
          a, share * (p.template j<Value::velocity>(a) - p.template i<Value::velocity>(a)));
  }
};

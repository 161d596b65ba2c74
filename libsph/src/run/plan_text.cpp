#include "run/plan_text.hpp"

#include <fmt/format.h>

#include "run/cost.hpp"
#include "sph/pairs/fusions.hpp"

namespace sph {
namespace {

std::string names_of(FieldSet fields) {
  std::string out;
  for (Field f : fields.list()) out += (out.empty() ? "" : ", ") + std::string(info(f).name);
  return out.empty() ? "nothing" : out;
}

std::string terms_of(const Stage& stage) {
  if (stage.fusion == nullptr) return {};
  std::string out;
  for (Term term : stage.fusion->terms) out += (out.empty() ? ": " : " + ") + std::string(term.name);
  return out;
}

/// "fluid: ", "cells: " and "grains: " where a scene has two of them.
std::string name_of(const Parts& parts, std::size_t set) {
  if (parts.sets.size() == 1) return {};
  if (parts.sets[set].owners) return "cells: ";
  return parts.sets[set].fields.has(Field::radius) ? "grains: " : "fluid: ";
}

std::string text_of(const Scheduled& s, const Parts& parts, int dim) {
  const Stage& stage = *s.stage;
  const auto reads = [&](FieldSet refresh, std::size_t set, FieldSet sends) {
    return fmt::format("    {}reads of neighbours {}; sends before it {} ({} bytes)\n", name_of(parts, set),
                       names_of(refresh & parts.sets[set].fields), names_of(sends), bytes_of(sends, dim));
  };
  std::string out = fmt::format("  {}{}{}\n", name_of(parts, stage.set), stage.name, terms_of(stage));
  if (!stage.refresh.empty()) out += reads(stage.refresh, stage.set, s.sends);
  if (stage.other) out += reads(stage.other->refresh, stage.other->set, s.other_sends);
  if (s.entry->solver)
    out += fmt::format("    repeated until its solver is content; sends each time {} ({} bytes)\n",
                       names_of(s.again), bytes_of(s.again, dim));
  if (const FieldSet writes = stage.writes & parts.sets[stage.set].fields; !writes.empty())
    out += fmt::format("    writes {}\n", names_of(writes));
  if (stage.moves) out += "    moves particles\n";
  return out;
}

}  // namespace

std::string plan_text(const Scene& scene, const Parts& parts) {
  std::string out = "plan of a step:\n";
  std::vector<FieldSet> fields;
  for (const Parts::Set& set : parts.sets) fields.push_back(set.fields);
  std::size_t sent = 0;
  for (const Scheduled& s : schedule_of(parts.plan, fields)) {
    if (s.entry == parts.plan.sums.data()) out += "  (lists are made anew here when they must be)\n";
    out += text_of(s, parts, scene.dim);
    sent += bytes_of(s.sends, scene.dim) + bytes_of(s.other_sends, scene.dim);
  }
  return out + fmt::format("  sent in all: {} bytes a halo particle{}\n", sent,
                           parts.sets.size() == 1 ? "" : " of each set");
}

}  // namespace sph

#include "run/plan_text.hpp"

#include <fmt/format.h>

#include "run/cost.hpp"
#include "sph/fusions.hpp"

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

std::string text_of(const Scheduled& s, FieldSet fields, int dim) {
  std::string out = fmt::format("  {}{}\n", s.stage->name, terms_of(*s.stage));
  if (!s.stage->refresh.empty())
    out += fmt::format("    reads of neighbours {}; sends before it {} ({} bytes)\n",
                       names_of(s.stage->refresh & fields), names_of(s.sends), bytes_of(s.sends, dim));
  if (s.entry->solver)
    out += fmt::format("    repeated until its solver is content; sends each time {} ({} bytes)\n",
                       names_of(s.again), bytes_of(s.again, dim));
  if (const FieldSet writes = s.stage->writes & fields; !writes.empty())
    out += fmt::format("    writes {}\n", names_of(writes));
  if (s.stage->moves) out += "    moves particles\n";
  return out;
}

}  // namespace

std::string plan_text(const Scene& scene, const Plan& plan, FieldSet fields) {
  std::string out = "plan of a step:\n";
  std::size_t sent = 0;
  for (const Scheduled& s : schedule_of(plan, fields)) {
    if (s.entry == plan.sums.data()) out += "  (lists are made anew here when they must be)\n";
    out += text_of(s, fields, scene.dim);
    sent += bytes_of(s.sends, scene.dim);
  }
  return out + fmt::format("  sent in all: {} bytes a halo particle\n", sent);
}

}  // namespace sph

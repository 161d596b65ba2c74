#include "sph/plan/plan.hpp"

#include <utility>

namespace sph {

std::vector<const Entry*> entries_of(const Plan& plan) {
  std::vector<const Entry*> out;
  for (const auto* part : {&plan.drift, &plan.sums, &plan.kick})
    for (const Entry& e : *part) out.push_back(&e);
  return out;
}

double longest_move(const Plan& plan, std::size_t set, const GlobalState& global) {
  return longest_move(plan.drift, set, global) + longest_move(plan.sums, set, global) +
         longest_move(plan.kick, set, global);
}

double longest_move(const std::vector<Entry>& entries, std::size_t set, const GlobalState& global) {
  double way = 0;
  for (const Entry& e : entries)
    for (const Stage& s : e.stages)
      if (s.moves && s.set == set) way += s.moves(global);
  return way;
}

void append(Plan& plan, Plan more, std::size_t set) {
  for (auto part : {&Plan::drift, &Plan::sums, &Plan::kick, &Plan::start, &Plan::settle, &Plan::output})
    for (Entry& e : more.*part) {
      for (Stage& s : e.stages) s.set = set;
      (plan.*part).push_back(std::move(e));
    }
}

std::vector<Scheduled> schedule_of(const Plan& plan, FieldSet fields) {
  std::vector<Scheduled> out;
  Freshness halo;
  // What a rebuild of lists brings up to date and no stage changes.
  halo.sent(FieldSet{Field::id});
  for (int round = 0; round < 2; ++round) {  // what the first leaves is what later ones find
    out.clear();
    for (const Entry* e : entries_of(plan)) {
      const std::size_t first = out.size();
      for (int iteration = 0; iteration < (e->solver ? 2 : 1); ++iteration) {
        for (std::size_t k = 0; k < e->stages.size(); ++k) {
          const Stage& s = e->stages[k];
          const FieldSet sends = halo.missing(s.refresh & fields);
          if (iteration == 0)
            out.push_back({e, &s, sends, {}});
          else
            out[first + k].again = sends;
          halo.sent(sends);
          halo.changed(s.writes);
        }
        if (e->solver) halo.changed(e->improves);
      }
    }
  }
  return out;
}

}  // namespace sph

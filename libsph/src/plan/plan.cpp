#include "sph/plan/plan.hpp"

#include <algorithm>
#include <array>
#include <utility>

namespace sph {

std::vector<const Entry*> entries_of(const Plan& plan) {
  std::vector<const Entry*> out;
  for (const auto* part : {&plan.drift, &plan.sums, &plan.kick})
    for (const Entry& e : *part) out.push_back(&e);
  return out;
}

std::vector<Entry>::const_iterator first_that_writes(const std::vector<Entry>& entries, Field field) {
  return std::ranges::find_if(entries, [&](const Entry& e) {
    return std::ranges::any_of(e.stages, [&](const Stage& s) { return s.writes.has(field); });
  });
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

namespace {
constexpr std::array parts{&Plan::drift, &Plan::sums, &Plan::kick, &Plan::start, &Plan::settle};
}

bool may_drift(const Plan& plan) {
  return std::ranges::any_of(plan.drift, [](const Entry& e) {
    return std::ranges::any_of(e.stages, [](const Stage& s) { return bool{s.moves}; });
  });
}

void append(Plan& plan, Plan more) {
  for (auto part : parts)
    for (Entry& e : more.*part) (plan.*part).push_back(std::move(e));
  if (more.settling) plan.settling = std::move(more.settling);
  plan.half_kick = plan.half_kick || more.half_kick;
}

void append(Plan& plan, Plan more, std::size_t set) {
  for (auto part : parts)
    for (Entry& e : more.*part)
      for (Stage& s : e.stages) s.set = set;
  append(plan, std::move(more));
}

std::vector<Scheduled> schedule_of(const Plan& plan, std::span<const FieldSet> fields) {
  std::vector<Scheduled> out;
  std::vector<Freshness> halos(fields.size());
  // What a rebuild of lists brings up to date and no stage changes.
  for (Freshness& halo : halos) halo.sent(FieldSet{Field::id});
  const auto sent = [&](std::size_t set, FieldSet refresh) {
    const FieldSet missing = halos[set].missing(refresh & fields[set]);
    halos[set].sent(missing);
    return missing;
  };
  for (int round = 0; round < 2; ++round) {  // what the first leaves is what later ones find
    out.clear();
    for (const Entry* e : entries_of(plan)) {
      const std::size_t first = out.size();
      for (int iteration = 0; iteration < (e->solver ? 2 : 1); ++iteration) {
        for (std::size_t k = 0; k < e->stages.size(); ++k) {
          const Stage& s = e->stages[k];
          const FieldSet sends = sent(s.set, s.refresh);
          if (iteration == 0)
            out.push_back({e, &s, sends, {}, s.other ? sent(s.other->set, s.other->refresh) : FieldSet{}});
          else
            out[first + k].again = sends;
          halos[s.set].changed(s.writes);
        }
        if (e->solver) halos[e->stages.front().set].changed(e->improves);
      }
    }
  }
  return out;
}

}  // namespace sph

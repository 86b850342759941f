// The assignment as one provider sees it.
#include "policies/algorithms/assignment/provider_assignment.hpp"

#include "policies/algorithms/assignment/queueing.hpp"
#include "policies/algorithms/chains/leaning.hpp"

#include <algorithm>

namespace sofof::policies::assignment {

namespace {

constexpr int here = 0;

/// @returns what of this provider's workers may be in use.
double room_here(const central_context& context, duration wait) {
  double longest_s = 0;
  const auto see = [&](const auto& view) {
    longest_s = std::max(
        longest_s, computing_s(view.utilisation, view.task, context.workers));
  };
  for (const auto& request : context.requests)
    see(request);
  double in_use = 0;
  for (const auto& session : context.sessions) {
    see(session);
    in_use += session.utilisation;
  }
  // Utilisation is a share of all workers: together they count as one.
  return std::max(in_use, utilisation_cap(1, from_seconds(longest_s), wait));
}

/// Says who leans on whom. Alone, one counts here as if its vehicle told
/// nothing, and elsewhere for nothing.
void lean(problem& p, const central_context& context, double price) {
  const auto leaning = leaning_of(context);
  const auto leans = [](const auto& on) { return on.has_value(); };
  if (std::ranges::none_of(leaning, leans))
    return;
  for (const auto& on : leaning)
    p.leans_on.push_back(on ? std::optional{static_cast<int>(*on)}
                            : std::nullopt);
  p.lost_alone = p.gains.max(0);
  for (int v = 0; v < p.vehicles(); ++v)
    p.lost_alone(v, here) -= local_gain(
        {}, context.self, p.resources.front().demand(v, here), price);
}

} // namespace

void assignment_options::visit_options(option_visitor& s) {
  central_options::visit_options(s);
  s.field("wait", wait, duration{1});
}

central_problem problem_of(const central_context& context,
                           const assignment_options& options) {
  const auto others = others_told(context);
  const auto requests = static_cast<int>(context.requests.size());
  const auto vehicles = requests + static_cast<int>(context.sessions.size());
  const auto providers = 1 + static_cast<int>(others.size());
  central_problem all{{pair_table::Zero(vehicles, providers),
                       pair_flags::Constant(vehicles, providers, false),
                       {{pair_table::Zero(vehicles, providers),
                         {room_here(context, options.wait)}}},
                       std::vector<choice>(vehicles, local),
                       options.price},
                      {context.self}};
  auto& p = all.what;
  auto& needs = p.resources.front();
  for (const auto& other : others) {
    needs.capacity.push_back(1 - other.utilisation);
    all.providers.push_back(other.id);
  }
  const auto fill = [&](int vehicle, const auto& view) {
    needs.demand.row(vehicle) = view.utilisation;
    p.eligible(vehicle, here) = true;
    p.gains(vehicle, here) = local_gain(view.candidates, context.self,
                                        view.utilisation, options.price);
  };
  int vehicle = 0;
  for (const auto& request : context.requests) {
    fill(vehicle, request);
    for (int i = 1; i < providers; ++i)
      if (const auto gain = told_gain(request.candidates, all.providers[i])) {
        p.eligible(vehicle, i) = true;
        p.gains(vehicle, i) = *gain;
      }
    ++vehicle;
  }
  for (const auto& session : context.sessions) {
    fill(vehicle, session);
    p.present[vehicle++] = here;
  }
  lean(p, context, options.price);
  return all;
}

void fill_room(const problem& p, std::vector<choice>& choices) {
  for (int v = p.vehicles() - 1; v >= 0; --v) { // who is served comes last
    if (choices[v])
      continue;
    choices[v] = here;
    if (!feasible(p, choices))
      choices[v] = local;
  }
}

std::vector<central_decision> decisions_of(const central_context& context,
                                           const central_problem& asked,
                                           const solution& found) {
  std::vector<central_decision> all;
  for (int v = 0; v < asked.what.vehicles(); ++v) {
    const auto c = found.choices[v];
    const auto asks = all.size() < context.requests.size();
    if (c == here)
      all.push_back({accepted{}, asks ? "best here" : "stays"});
    else if (!c)
      all.push_back(
          {refused{}, asks ? "no room" : "others win more by its room"});
    else
      all.push_back({refused{asked.providers[*c]}, "better elsewhere"});
  }
  return all;
}

} // namespace sofof::policies::assignment

// A scenario with faults: its town, its vehicles, what they run and decide.
#include "experiments/torture/draw.hpp"

#include "experiments/torture/draw_chain.hpp"
#include "experiments/torture/draw_faults.hpp"
#include "experiments/torture/lottery.hpp"
#include "experiments/torture/lying_planning.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace sofof::experiments::torture {

namespace {

using weighted = std::pair<std::string_view, double>;

/// Vehicle hours are dear with al_ilqr: so many runs have it, which is more
/// than half of the hours.
constexpr double share_of_al_ilqr = 0.6;

drawn_town draw_town(lottery of) {
  drawn_town town;
  town.columns = of.whole(2, 4);
  town.rows = of.whole(2, 3);
  town.block_m = of.number(80, 200, 0);
  town.length_s = of.number(60, 150, 0);
  return town;
}

std::string text_of(const drawn_town& town, lottery of) {
  return fmt::format("\n[street_grid]\ncolumns = {}\nrows = {}\n"
                     "block_m = {:.1f}\nlimit_mps = {:.1f}\n",
                     town.columns, town.rows, town.block_m,
                     of.number(8, 16, 1));
}

/// Their computers die some time.
std::string draw_dead_cars(const drawn_town& town, lottery& of) {
  return fmt::format("fails_at = \"{:.1f}s\"\n",
                     of.number(3, town.length_s - 3, 1));
}

/// One vehicle a block at most, and then some on tours; who comes later waits
/// until its place is free.
std::string draw_fleets(const drawn_town& town, lottery of) {
  const auto blocks = (town.columns - 1) * (town.rows - 1);
  std::string text =
      fmt::format("\n[[fleet]]\ncount = {}\nroutes = [\"block *\"]\n"
                  "start_m = {:.1f}\n",
                  of.whole(1, std::min<std::int64_t>(blocks, 4)),
                  of.number(0, town.block_m, 0));
  if (of.happens(0.2))
    text += fmt::format("compute = {{ clock_ghz = {:.1f} }}\n",
                        of.number(0.5, 4, 1));
  if (of.happens(0.08))
    text += draw_dead_cars(town, of);
  if (of.happens(0.5)) {
    text += fmt::format("\n[[fleet]]\ncount = {}\nfirst_station = 201\n"
                        "routes = [\"tour *\"]\nappears_at = \"{}s\"\n"
                        "appear_every = \"{}s\"\n",
                        of.whole(1, 2), of.whole(1, 10), of.whole(1, 10));
    if (of.happens(0.15))
      text += "connected = false\n";
    if (of.happens(0.3))
      text += draw_dead_cars(town, of);
  }
  return text;
}

std::string draw_v2x(lottery of) {
  std::string text;
  if (of.happens(0.3))
    text += "cam = \"fixed_10hz\"\n";
  if (of.happens(0.5))
    text += "cpm = \"off\"\n";
  else if (of.happens(0.2))
    text += "cpm_version = \"ts103324\"\n";
  return text.empty() ? text : "\n[v2x]\n" + text;
}

/// The dear planner plans for half of its usual horizon, and less often: what
/// is tortured is what happens between vehicle and provider.
std::string draw_planning(const drawn_chain& chain, lottery of) {
  const auto is_dear = of.happens(share_of_al_ilqr);
  std::string text = "\n[[service]]\nname = \"trajectory_planning\"\n";
  const auto period_ms = of.happens(is_dear ? 0.85 : 0.6) ? 100 : 50;
  if (period_ms == 100) // else a single loss would end an episode
    text += "period = \"100ms\"\nmax_interarrival = \"200ms\"\n";
  else if (of.happens(0.5))
    text += fmt::format("max_interarrival = \"{}ms\"\n", of.whole(6, 20) * 10);
  if (of.happens(0.2))
    text += fmt::format("max_latency = \"{}ms\"\n", of.whole(3, 10) * 10);
  if (of.happens(0.15))
    text += fmt::format("max_input_age = \"{}ms\"\n", of.whole(2, 6) * 100);
  if (of.happens(0.15) && !chain.is_there())
    text += "per_input = true\n";
  if (of.happens(0.15) || chain.plans_each_scene)
    text += "input_period = \"50ms\"\n";
  text += fmt::format("[service.planner]\nname = \"{}\"\n",
                      is_dear ? "al_ilqr" : "lane_follow");
  if (is_dear)
    text += fmt::format("[service.planner.provider]\nhorizon_m = {:.1f}\n"
                        "step_m = {:.1f}\ncandidates = {}\nalternations = 1\n",
                        of.number(80, 100, 0), of.number(0.8, 1, 1),
                        of.whole(1, 2));
  return text;
}

/// Services that nobody drives by.
struct drawn_others {
  std::string text;
  std::vector<std::string_view> names;
};

drawn_others draw_others(lottery of) {
  drawn_others all;
  if (of.happens(0.3)) {
    all.text += "\n[[service]]\nname = \"cabin_climate\"\n";
    all.names.push_back("cabin_climate");
  }
  if (of.happens(0.2)) {
    all.text += fmt::format("\n[[service]]\nname = \"synthetic_load\"\n"
                            "[service.compute]\ninput_octets = {}\n",
                            of.whole(1, 20) * 1000);
    all.names.push_back("synthetic_load");
  }
  return all;
}

/// Providers that lie, in some runs: all but the one about crossings, which
/// need a service of their own.
std::string draw_lies(lottery of) {
  if (!of.happens(0.12))
    return {};
  const auto last = static_cast<std::int64_t>(lie_names.size()) - 2;
  const auto which = static_cast<std::size_t>(of.whole(0, last));
  return fmt::format("\n[lies]\nwhat = \"{}\"\nafter = \"{}s\"\n",
                     lie_names[which], of.whole(1, 20));
}

std::string draw_hostile(lottery of) {
  return of.happens(0.15) ? fmt::format("\n[hostile]\nevery = \"{}ms\"\n",
                                        of.whole(1, 20) * 50)
                          : "";
}

/// Policies that offload as often as they can, mostly.
std::string draw_policies(lottery of) {
  static constexpr std::array<weighted, 12> lodms{{{"always", 6},
                                                   {"location", 1},
                                                   {"nearest", 2},
                                                   {"least_loaded", 2},
                                                   {"random", 1},
                                                   {"alto", 1},
                                                   {"ucb1", 1},
                                                   {"greedy_gain", 1},
                                                   {"drift_plus_penalty", 0.5},
                                                   {"best_response", 0.5},
                                                   {"q_learning", 0.5},
                                                   {"oracle", 0.5}}};
  static constexpr std::array<weighted, 7> codms{{{"always", 6},
                                                  {"location", 1},
                                                  {"capacity", 2},
                                                  {"edf", 2},
                                                  {"assignment", 1},
                                                  {"best_response", 1},
                                                  {"cross_entropy", 0.5}}};
  const auto lodm = of.one_of<std::string_view>(lodms);
  std::string text = fmt::format("\n[policies]\ncodm = \"{}\"\n",
                                 of.one_of<std::string_view>(codms));
  std::string govern;
  const auto add = [&](const std::string& governor) {
    govern += (govern.empty() ? "" : ", ") + governor;
  };
  if (of.happens(0.3))
    add(of.happens(0.3)
            ? "{ name = \"redundancy\" }"
            : fmt::format("{{ name = \"redundancy\", hedge_after = \"{}ms\" }}",
                          of.whole(2, 9) * 5));
  if (of.happens(0.15))
    add("{ name = \"hysteresis\" }");
  if (of.happens(0.1))
    add("{ name = \"predictive_gate\" }");
  return text
         + (govern.empty()
                ? fmt::format("lodm = \"{}\"\n", lodm)
                : fmt::format("lodm = {{ name = \"{}\", govern = [{}] }}\n",
                              lodm, govern));
}

} // namespace

std::string name_of(std::uint64_t seed) {
  return fmt::format("torture_{}", seed);
}

std::string draw(std::uint64_t seed) {
  const lottery all{random_stream{seed, "torture"}};
  const auto town = draw_town(all.part("town"));
  const auto links = all.part("chain");
  const auto chain = draw_chain(links);
  const auto others = draw_others(all.part("others"));
  const auto offer = [&](std::int64_t provider) {
    return draw_offered(
        chain, others.names,
        links.part(static_cast<std::uint64_t>(provider)).part("offered"));
  };
  return fmt::format("name = \"{}\"\nduration = \"{:.0f}s\"\nseed = {}\n",
                     name_of(seed), town.length_s, seed)
         + text_of(town, all.part("streets"))
         + draw_fleets(town, all.part("fleets"))
         + draw_providers(town, offer, all.part("providers"))
         + draw_v2x(all.part("v2x")) + draw_network(town, all.part("network"))
         + chain.services + draw_planning(chain, all.part("planning"))
         + others.text + draw_policies(all.part("policies"))
         + draw_lies(all.part("lies")) + draw_hostile(all.part("hostile"))
         + "\n[record]\ntracks = false\n";
}

} // namespace sofof::experiments::torture

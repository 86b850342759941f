// What goes wrong in a scenario that is made up: its providers, and the air.
#include "experiments/torture/draw_faults.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::experiments::torture {

namespace {

using weighted = std::pair<std::string_view, double>;

constexpr std::array<weighted, 8> profiles{{{"paper_sim", 3},
                                            {"paper_sim_correlated", 1},
                                            {"paper_sim_stalls", 1},
                                            {"paper_5g", 3},
                                            {"cicv5g_n8", 1},
                                            {"cicv5g_n78", 1},
                                            {"spiky_5g", 1},
                                            {"ideal", 1}}};

std::string_view draw_direction(lottery& of) {
  return of.happens(0.5) ? ", direction = \"up\"" : ", direction = \"down\"";
}

/// At least one time in which nothing gets through, in one direction or both.
std::string draw_outage_list(const drawn_town& town, lottery& of) {
  std::string list;
  auto at_s = of.number(1, 20, 1);
  while (at_s < town.length_s - 2) {
    const auto end_s = at_s + of.spread(0.1, 8, 2);
    list += fmt::format("{}{{ from = \"{:.2f}s\", to = \"{:.2f}s\"{} }}",
                        list.empty() ? "" : ", ", at_s, end_s,
                        of.happens(0.4) ? draw_direction(of) : "");
    at_s = end_s + of.spread(4, 60, 1);
  }
  return fmt::format("outage = [{}]", list);
}

std::string draw_death(const drawn_town& town, lottery& of) {
  const auto at_s = of.number(3, town.length_s - 5, 1);
  auto text = fmt::format("fails_at = \"{:.1f}s\"\n", at_s);
  if (of.happens(0.8))
    text +=
        fmt::format("returns_at = \"{:.1f}s\"\n",
                    std::min(at_s + of.spread(0.2, 20, 1), town.length_s - 1));
  return text;
}

std::string draw_provider(const drawn_town& town, std::int64_t number,
                          const std::string& offer, lottery of) {
  const auto east_m = static_cast<double>(town.columns - 1) * town.block_m;
  const auto north_m = static_cast<double>(town.rows - 1) * town.block_m;
  // Vehicles shall offload: mostly the area is all of the town.
  const auto radius_m = of.happens(0.6) ? 1.5 * (east_m + north_m)
                                        : of.number(0.5, 1.2, 2) * town.block_m;
  auto text = fmt::format(
      "\n[[provider]]\nname = \"p{}\"\nposition_m = [{:.1f}, {:.1f}]\n"
      "area_radius_m = {:.1f}\n",
      number, of.number(0, east_m, 0), of.number(0, north_m, 0), radius_m);
  text += offer;
  if (of.happens(0.2))
    text += fmt::format("radio = \"r{}\"\n", number);
  if (of.happens(0.3)) // it alone is cut off for a while
    text += fmt::format("network = {{ profile = \"{}\", {} }}\n",
                        of.one_of<std::string_view>(profiles),
                        draw_outage_list(town, of));
  if (of.happens(0.4))
    text += draw_death(town, of);
  if (of.happens(0.05))
    text += "map = \"none\"\n";
  if (of.happens(0.2))
    text +=
        fmt::format("compute = {{ workers = {}, more_computing = \"{}ms\" }}\n",
                    of.whole(1, 4), of.whole(0, 25));
  if (of.happens(0.15))
    text += fmt::format("[[provider.sensor]]\nposition_m = [{:.1f}, {:.1f}]\n",
                        of.number(0, east_m, 0), of.number(0, north_m, 0));
  return text;
}

/// Each makes a table or a key of [network].
std::string draw_loss(const drawn_town&, lottery& of) {
  return fmt::format("loss = {}\n", of.spread(0.002, 0.1, 4));
}

std::string draw_burst_loss(const drawn_town&, lottery& of) {
  return fmt::format("burst_loss = {{ mean_good = \"{}s\", mean_bad = "
                     "\"{}ms\", loss_bad = {} }}\n",
                     of.whole(3, 20), of.whole(1, 30) * 50,
                     of.number(0.5, 1, 2));
}

std::string draw_stalls(const drawn_town&, lottery& of) {
  const auto shortest_ms = of.whole(2, 30) * 10;
  return fmt::format("stalls = {{ rate_hz = {}, shortest = \"{}ms\", longest "
                     "= \"{}ms\" }}\n",
                     of.spread(0.02, 0.3, 3), shortest_ms,
                     shortest_ms + of.whole(0, 80) * 10);
}

std::string draw_spikes(const drawn_town&, lottery& of) {
  return fmt::format("spikes = {{ probability = {}, shortest = \"5ms\", "
                     "longest = \"{}ms\" }}\n",
                     of.spread(0.001, 0.05, 4), of.whole(2, 30) * 10);
}

std::string draw_drift(const drawn_town&, lottery& of) {
  return fmt::format("drift = {{ sd = {}, period = \"{}s\" }}\n",
                     of.number(0.2, 0.8, 2), of.whole(3, 20));
}

std::string draw_delay(const drawn_town&, lottery& of) {
  return fmt::format("more_delay = \"{}ms\"\n", of.whole(1, 25));
}

std::string draw_cell(const drawn_town&, lottery& of) {
  return fmt::format("cell_mbps = {}\n", of.spread(0.3, 20, 2));
}

std::string draw_disorder(const drawn_town&, lottery& of) {
  return fmt::format("disorder = {{ copied = {}, overtaken = {}, longest = "
                     "\"{}ms\" }}\n",
                     of.spread(0.001, 0.1, 4), of.spread(0.001, 0.1, 4),
                     of.whole(1, 50) * 10);
}

std::string draw_outages(const drawn_town& town, lottery& of) {
  return draw_outage_list(town, of) + '\n';
}

using draw_fault = std::string (*)(const drawn_town&, lottery&);
constexpr std::array<std::pair<draw_fault, double>, 9> faults{
    {{draw_loss, 0.4},
     {draw_burst_loss, 0.2},
     {draw_stalls, 0.2},
     {draw_spikes, 0.15},
     {draw_drift, 0.1},
     {draw_delay, 0.1},
     {draw_cell, 0.1},
     {draw_outages, 0.35},
     {draw_disorder, 0.25}}};

} // namespace

std::string draw_providers(const drawn_town& town, const draw_offer& offer,
                           lottery of) {
  std::string text;
  const auto count = of.whole(1, 3);
  for (std::int64_t k = 1; k <= count; ++k)
    text += draw_provider(town, k, offer(k),
                          of.part(static_cast<std::uint64_t>(k)));
  return text;
}

std::string draw_network(const drawn_town& town, lottery of) {
  auto text = fmt::format("\n[network]\nprofile = \"{}\"\n",
                          of.one_of<std::string_view>(profiles));
  for (std::uint64_t k = 0; k < faults.size(); ++k) {
    auto own = of.part(k);
    if (own.happens(faults[k].second))
      text += faults[k].first(town, own);
  }
  return text;
}

} // namespace sofof::experiments::torture

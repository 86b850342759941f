// The services before planning, and what of the chain each provider offers.
#include "experiments/torture/draw_chain.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <array>
#include <vector>

namespace sofof::experiments::torture {

namespace {

constexpr double share_of_chains = 0.35;
/// Of a chain's providers: they offer all of it.
constexpr double share_of_whole_chains = 0.3;

constexpr std::array<std::string_view, 3> links{"tracking", "environment_model",
                                                "trajectory_planning"};

std::string draw_link(std::string_view name, lottery of) {
  auto text = fmt::format("\n[[service]]\nname = \"{}\"\n", name);
  if (of.happens(0.3))
    text += fmt::format("max_interarrival = \"{}ms\"\n", of.whole(15, 60) * 10);
  if (of.happens(0.2))
    text += fmt::format("max_latency = \"{}ms\"\n", of.whole(3, 15) * 10);
  if (of.happens(0.2))
    text += fmt::format("max_input_age = \"{}ms\"\n", of.whole(2, 6) * 100);
  if (of.happens(0.15))
    text += "per_input = false\n";
  if (of.happens(0.15)) {
    const auto mean_ms = of.whole(1, 20);
    text += fmt::format("compute = {{ run_time_mean = \"{}ms\", run_time_max = "
                        "\"{}ms\" }}\n",
                        mean_ms, 2 * mean_ms);
  }
  return text;
}

} // namespace

drawn_chain draw_chain(lottery of) {
  drawn_chain chain;
  if (!of.happens(share_of_chains))
    return chain;
  chain.services =
      draw_link(links[0], of.part(1)) + draw_link(links[1], of.part(2));
  chain.plans_each_scene = of.happens(0.8);
  return chain;
}

std::string draw_offered(const drawn_chain& chain,
                         std::span<const std::string_view> others, lottery of) {
  if (!chain.is_there() || of.happens(share_of_whole_chains))
    return {};
  const auto which = of.whole(1, (1 << links.size()) - 1); // a bit for each
  std::vector<std::string> offered;
  for (std::size_t k = 0; k < links.size(); ++k)
    if ((which >> k & 1) != 0)
      offered.push_back(fmt::format("\"{}\"", links[k]));
  for (const auto other : others)
    offered.push_back(fmt::format("\"{}\"", other));
  return fmt::format("services = [{}]\n", fmt::join(offered, ", "));
}

} // namespace sofof::experiments::torture

// Reads routes and departures of SUMO.
#include <fmt/format.h>

#include "maps/split_words.hpp"
#include "maps/sumo_net.hpp"
#include <algorithm>
#include <string>
#include <unordered_map>

namespace sofof::maps {

namespace {

class route_reader {
public:
  route_reader(const xml_file& file, source_map& to) : file_{file}, to_{to} {}

  void read() {
    for (const auto route : file_.root().children("route"))
      if (!numbers_.emplace(file_.text(route, "id"), add(route)).second)
        file_.refuse(route, fmt::format("there are two routes \"{}\".",
                                        file_.text(route, "id")));
    for (const auto vehicle : file_.root().children("vehicle"))
      read_vehicle(vehicle);
    for (const auto* kind : {"trip", "flow"}) {
      const auto all = file_.root().children(kind);
      if (const auto count = std::distance(all.begin(), all.end()); count > 0)
        to_.left_out[fmt::format("{}s", kind)] +=
            static_cast<std::size_t>(count);
    }
    start_at_zero();
  }

private:
  /// @returns the number of a route with these edges.
  std::size_t add(pugi::xml_node route) {
    const std::string edges{file_.text(route, "edges")};
    if (const auto known = by_edges_.find(edges); known != by_edges_.end())
      return known->second;
    const auto number = to_.routes.size();
    by_edges_.emplace(edges, number);
    const auto words = split_words(edges);
    source_route made{fmt::format("route {}", number + 1),
                      {words.begin(), words.end()}};
    if (route.attribute("id"))
      made.name = file_.text(route, "id");
    to_.routes.push_back(std::move(made));
    return number;
  }

  void read_vehicle(pugi::xml_node vehicle) {
    departure d{.vehicle = std::string{file_.text(vehicle, "id")}};
    const std::string_view depart = file_.text(vehicle, "depart");
    if (depart == "triggered" || depart == "containerTriggered") {
      ++to_.left_out["vehicles that wait for persons"];
      return;
    }
    d.at_s = file_.number(vehicle, "depart", 0, 1e9);
    if (const auto own = vehicle.child("route")) {
      d.route = add(own);
    } else {
      const std::string name{file_.text(vehicle, "route")};
      const auto found = numbers_.find(name);
      if (found == numbers_.end())
        file_.refuse(vehicle, fmt::format("there is no route \"{}\".", name));
      d.route = found->second;
    }
    to_.departures.push_back(std::move(d));
  }

  /// Demand of a day begins in the morning; runs begin with the first.
  void start_at_zero() {
    auto& all = to_.departures;
    std::ranges::stable_sort(all, {}, &departure::at_s);
    if (all.empty())
      return;
    const auto first_s = all.front().at_s;
    for (auto& d : all)
      d.at_s -= first_s;
  }

  const xml_file& file_;
  source_map& to_;
  std::unordered_map<std::string, std::size_t> numbers_, by_edges_;
};

} // namespace

void read_sumo_routes(const xml_file& routes, source_map& to) {
  if (std::string_view{routes.root().name()} != "routes")
    routes.refuse(routes.root(),
                  "these are no routes of SUMO: <routes> is missing.");
  route_reader{routes, to}.read();
}

} // namespace sofof::maps

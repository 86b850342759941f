// What goes wrong in a scenario that is made up: its providers, and the air.
#pragma once

#include "experiments/torture/lottery.hpp"

#include <cstdint>
#include <functional>
#include <string>

namespace sofof::experiments::torture {

/// Where everything takes place.
struct drawn_town {
  std::int64_t columns = 2, rows = 2; ///< Junctions.
  double block_m = 100;
  double length_s = 60; ///< Of the run.
};

/// What some provider offers: a key of its table, or nothing.
using draw_offer = std::function<std::string(std::int64_t number)>;

/// @returns one to three tables [[provider]]; some die, and some of these
/// come back.
std::string draw_providers(const drawn_town& town, const draw_offer& offer,
                           lottery of);

/// @returns the tables [network] and [compute], with one to four kinds of
/// faults.
std::string draw_network(const drawn_town& town, lottery of);

} // namespace sofof::experiments::torture

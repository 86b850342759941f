// The services before planning, and what of the chain each provider offers.
#pragma once

#include "experiments/torture/lottery.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <string_view>

namespace sofof::experiments::torture {

/// What is drawn of the chain of services: its text in a scenario.
struct drawn_chain {
  std::string services; ///< Those before planning; empty: planning is alone.
  bool plans_each_scene = false; ///< Its inputs may follow each other soon.

  bool is_there() const { return !services.empty(); }
};

/// @returns tables [[service]] of tracking and the environment model, in some
/// runs.
drawn_chain draw_chain(lottery of);

/// @param others  Services that are no part of the chain: all offer them.
/// @returns the key `services` of a provider: any of the three; empty: all.
std::string draw_offered(const drawn_chain& chain,
                         std::span<const std::string_view> others, lottery of);

} // namespace sofof::experiments::torture

// What both sides say of each session, and when their link was in trouble.
#pragma once

#include "experiments/torture/promises.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sofof::experiments::torture {

/// A time, s since the start.
struct time_span {
  double from_s = 0, to_s = 0;
};

/// When nothing got through between a provider and a station, or what was sent
/// was held back or fell into a burst of losses; in order, apart. A message
/// that is lost by chance is no trouble: the protocol repeats what counts.
using troubles =
    std::map<std::pair<std::string, std::uint64_t>, std::vector<time_span>>;
troubles troubles_of(const finished_run& run);

/// @param troubled  In order, apart.
/// @returns how long there was no trouble between these two.
double calm_within(const std::vector<time_span>& troubled, double from_s,
                   double to_s);

/// One session, as either side has closed it; once each, if all is well.
struct two_sides {
  report::session_key of;
  std::vector<const report::episode_line*> requester, provider;
};

/// @returns all sessions, in the order of their keys.
std::vector<two_sides> sessions_of(const finished_run& run);

/// @param x  Both sides have closed it.
/// @returns for how long the link carried, and one side had closed the session
/// and the other had not; less what messages waited meanwhile at most for a
/// full cell.
double late_s(const finished_run& run, const two_sides& x,
              const troubles& known);

/// @returns the channel of a provider by its name.
const channel::channel_profile&
channel_to(const scenario::scenario_definition& s, const std::string& provider);

} // namespace sofof::experiments::torture

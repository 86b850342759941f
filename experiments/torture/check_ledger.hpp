// What both sides say of each session, and when their link was in trouble.
#pragma once

#include "experiments/torture/promises.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace sofof::experiments::torture {

/// When a message between a provider and a station was lost or held back, s, in
/// order.
using troubles =
    std::map<std::pair<std::string, std::uint64_t>, std::vector<double>>;
troubles troubles_of(const finished_run& run);

/// @param troubled  In order, s.
/// @returns the longest time between these two in which there was no trouble.
double calm_within(const std::vector<double>& troubled, double from_s,
                   double to_s);

/// One session, as either side has closed it; once each, if all is well.
struct two_sides {
  report::session_key of;
  std::vector<const report::episode_line*> requester, provider;
};

/// @returns all sessions, in the order of their keys.
std::vector<two_sides> sessions_of(const finished_run& run);

/// @param x  Both sides have closed it.
/// @returns the longest time for which the link carried, and one side had
/// closed the session and the other had not; less what messages waited at most
/// for a full cell.
double late_s(const finished_run& run, const two_sides& x,
              const troubles& known);

} // namespace sofof::experiments::torture

// How busy providers and their radio cells were: what load.csv, octets.csv and
// disturbed.csv hold, and what of it stands in the summary.
#pragma once

#include "base/time.hpp"
#include "channel/load_meter.hpp"
#include "channel/octet_ledger.hpp"

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::recording {

/// Above this share of what servers can do in half a second they count as full.
/// A queue's mean wait grows as 1 / (1 - share): tenfold here.
inline constexpr auto full_share = channel::load_figures::full_share;

/// The workers of a provider, or its radio cell in one direction.
struct server_load {
  std::string provider;  ///< Its name.
  std::string_view what; ///< "workers", "uplink" or "downlink".
  channel::load_figures of;
  double busy_w = 0; ///< What a busy one takes beyond an idle one, W.
};

/// What a provider's cell was given in one direction.
struct cell_octets {
  std::string provider;
  std::string_view direction; ///< "up" or "down".
  std::vector<channel::octet_line> lines;
  std::vector<channel::disturbed_line> disturbed = {};
};

/// Messages of one cell that were disturbed.
struct disturbed_messages {
  std::string provider;       ///< Its name.
  std::string_view direction; ///< "up" or "down".
  channel::disturbed_line x;
};

/// All that was measured in a run.
struct load_table {
  std::vector<server_load> servers; ///< Those that had work.
  std::vector<cell_octets> cells;   ///< Those that were given anything.
  bool tells_slow = true; ///< Older versions did not record what was slow.
};

/// What servers did in a run. Shares are of all their time.
struct load_summary {
  std::uint64_t jobs = 0;
  double busy_share = 0;  ///< In [0, 1].
  double asked_share = 0; ///< Work that arrived; above 1 it piles up.
  double peak_share = 0;  ///< The same in the half second of the most work.
  double full_s = 0; ///< Of half seconds in which it was above `full_share`.
  std::optional<double> mean_wait_ms;
  std::optional<double> p99_wait_ms;
  std::optional<double> max_wait_ms;
};

/// @param length  Of the run, of which whole tenths of a second count; for the
///                peak, and for `full_s`, whole half seconds.
load_summary summary_of(const channel::load_figures& x, duration length);

/// @param length  Of the run.
/// @returns what a service took at all providers, J: power by busy time. The
/// linear model of Fan, Weber & Barroso, ISCA 2007, without what a server takes
/// for being there. nullopt if no worker had anything to do.
std::optional<double> server_energy_j(const load_table& table, duration length,
                                      std::string_view service);

/// Servers that were full for half a second or more.
struct full_servers {
  const server_load* of; ///< In the table.
  load_summary sum;
};

/// @returns them all, the one of the highest peak first.
std::vector<full_servers> full_ones(const load_table& table, duration length);

/// @returns for how many seconds of a run of that length a line of load.csv and
/// octets.csv stands.
double seconds_of_line(double length_s);

/// @returns load.csv: a line for each second and server; for each 2, 4, 8 … s
/// of a run of more than half an hour.
std::string load_csv(const load_table& table, duration length);

/// @returns octets.csv: a line for each second, cell, direction and purpose;
/// for each 2, 4, 8 … s of a run of more than half an hour.
std::string octets_csv(const load_table& table);

/// Whose messages.
struct message_path {
  std::string_view provider;  ///< Its name.
  std::string_view direction; ///< "up" or "down".
  station_id station = 0;
  std::string_view what; ///< A service, say.
};

/// A time in a run, since its start, without its beginning.
struct time_window {
  duration after{};
  duration until{};
};

/// @param last_sent   When the last result that came was sent.
/// @param sent_after  How long after the one before, if one came before.
/// @param ended       When the gap had become too long.
/// @returns when the next result was sent, which did not come: one that is
/// disturbed later did not make the gap.
time_window due_next(duration last_sent, std::optional<duration> sent_after,
                     duration ended);

/// @returns what disturbed the first of the messages that were disturbed of
/// those sent in a window (most of them, where several were sent at once); none
/// where no one was; nullopt where no modelled cell tells.
std::optional<channel::disturbance> disturbance_of(const load_table& table,
                                                   const message_path& path,
                                                   const time_window& sent);

} // namespace sofof::recording

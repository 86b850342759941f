// Load, second by second.
#include "recording/load_table.hpp"

#include "base/text/csv.hpp"

#include <algorithm>
#include <chrono>

namespace sofof::recording {

namespace {

using bin = channel::load_figures::bin;

constexpr duration one_second = std::chrono::seconds{1};
constexpr auto peak_length = channel::load_figures::peak_length;
constexpr int places_of_share = 6;

/// @returns a length as far as bins fill it, so that none counts that the end
/// of the run cuts.
duration whole_bins(duration length) {
  return length - length % channel::load_figures::width;
}

double share(duration used, unsigned servers, duration of) {
  const auto all_s = to_seconds(of) * servers;
  return all_s > 0 ? to_seconds(used) / all_s : 0;
}

struct load_row {
  const server_load& x;
  duration from; ///< Since the start.
  bin in;
  duration length; ///< Of this row.
};

/// @returns in whole seconds.
std::uint64_t seconds_at(duration t) {
  return static_cast<std::uint64_t>(t / one_second);
}

constexpr csv_column<load_row> of_load[]{
    {"t_s", [](const auto& r) { return seconds_at(r.from); }},
    {"provider", [](const auto& r) { return std::string_view{r.x.provider}; }},
    {"what", [](const auto& r) { return r.x.what; }},
    {"jobs", [](const auto& r) { return r.in.jobs; }},
    {"asked_share",
     [](const auto& r) {
       return rounded(share(r.in.asked, r.x.of.servers, r.length),
                      places_of_share);
     }},
    {"busy_share",
     [](const auto& r) {
       return rounded(share(r.in.busy, r.x.of.servers, r.length),
                      places_of_share);
     }},
    {"mean_wait_ms",
     [](const auto& r) {
       return r.in.jobs == 0
                  ? decimal{}
                  : milliseconds(r.in.waited
                                 / static_cast<duration::rep>(r.in.jobs));
     }},
    {"max_wait_ms",
     [](const auto& r) {
       return r.in.jobs == 0 ? decimal{} : milliseconds(r.in.longest_wait);
     }},
};

struct octet_row {
  duration from; ///< Since the start.
  const cell_octets& cell;
  std::string_view what;
  const channel::octet_fates& x;
};

constexpr csv_column<octet_row> of_octets[]{
    {"t_s", [](const auto& r) { return seconds_at(r.from); }},
    {"provider",
     [](const auto& r) { return std::string_view{r.cell.provider}; }},
    {"direction", [](const auto& r) { return r.cell.direction; }},
    {"what", [](const auto& r) { return r.what; }},
    {"messages", [](const auto& r) { return r.x.sent.messages; }},
    {"sent", [](const auto& r) { return r.x.sent.octets; }},
    {"delivered", [](const auto& r) { return r.x.delivered.octets; }},
    {"lost", [](const auto& r) { return r.x.lost.octets; }},
    {"under_way", [](const auto& r) { return r.x.under_way.octets; }},
};

template <class Row>
void append_line(std::string& out, csv_columns<Row> columns, const Row& row) {
  append_fields(out, columns, row);
  out += '\n';
}

} // namespace

load_summary summary_of(const channel::load_figures& x, duration length) {
  length = whole_bins(length);
  const auto all = x.between(duration{0}, length);
  load_summary sum{.jobs = all.jobs,
                   .busy_share = share(all.busy, x.servers, length),
                   .asked_share = share(all.asked, x.servers, length),
                   .peak_share = share(x.most_asked, x.servers, peak_length),
                   .full_s = to_seconds(x.full),
                   .mean_wait_ms = x.waits.ms().mean(),
                   .p99_wait_ms = x.waits.quantile_ms(0.99),
                   .max_wait_ms = x.waits.ms().max()};
  const auto asked_from = [&x](duration t) {
    return x.between(t, t + peak_length).asked;
  };
  for (auto t = x.bins_from; t + peak_length <= length; t += x.width)
    sum.peak_share =
        std::max(sum.peak_share, share(asked_from(t), x.servers, peak_length));
  for (auto t = x.bins_from; t + peak_length <= length; t += peak_length)
    if (x.is_full(asked_from(t)))
      sum.full_s += to_seconds(peak_length);
  return sum;
}

std::optional<double> server_energy_j(const load_table& table, duration length,
                                      std::string_view service) {
  std::optional<double> sum_j;
  for (const auto& x : table.servers)
    if (!x.of.busy_by.empty()) {
      const auto busy_s = to_seconds(x.of.busy_for(service, length));
      sum_j = sum_j.value_or(0) + x.busy_w * busy_s;
    }
  return sum_j;
}

std::vector<full_servers> full_ones(const load_table& table, duration length) {
  std::vector<full_servers> all;
  for (const auto& x : table.servers)
    if (const auto of = summary_of(x.of, length); of.full_s > 0)
      all.push_back({&x, of});
  std::ranges::stable_sort(all, std::ranges::greater{},
                           [](const auto& x) { return x.sum.peak_share; });
  return all;
}

double seconds_of_line(double length_s) {
  return to_seconds(channel::length_of_rows(from_seconds(length_s)));
}

std::string load_csv(const load_table& table, duration length) {
  std::string text;
  append_names<load_row>(text, of_load);
  text += '\n';
  length = whole_bins(length);
  for (const auto& x : table.servers) {
    const auto row =
        std::max(x.of.rows.length(), channel::length_of_rows(length));
    for (duration t{}; t < length; t += row) {
      const auto end = std::min(t + row, length);
      append_line<load_row>(text, of_load,
                            {x, t, x.of.between(t, end), end - t});
    }
  }
  return text;
}

std::string octets_csv(const load_table& table) {
  std::string text;
  append_names<octet_row>(text, of_octets);
  text += '\n';
  for (const auto& cell : table.cells)
    for (const auto& line : cell.lines)
      for (duration t{}; const auto& x : line.rows.sums()) {
        if (x.sent.messages > 0)
          append_line<octet_row>(text, of_octets, {t, cell, line.what, x});
        t += line.rows.length();
      }
  return text;
}

time_window due_next(duration last_sent, std::optional<duration> sent_after,
                     duration ended) {
  // Computing and the one before that may have been lost move it.
  constexpr int most_periods = 3;
  return {last_sent,
          sent_after ? std::min(ended, last_sent + most_periods * *sent_after)
                     : ended};
}

std::optional<channel::disturbance> disturbance_of(const load_table& table,
                                                   const message_path& path,
                                                   const time_window& sent) {
  const auto cell = std::ranges::find_if(table.cells, [&path](const auto& x) {
    return x.provider == path.provider && x.direction == path.direction;
  });
  if (cell == table.cells.end())
    return std::nullopt;
  const channel::disturbed_line* first = nullptr;
  for (const auto& x : cell->disturbed)
    if (x.at > sent.after && x.at <= sent.until && x.station == path.station
        && x.what == path.what && x.count.most() != channel::disturbance::none
        && (!first || x.at < first->at))
      first = &x;
  return first ? first->count.most() : channel::disturbance::none;
}

} // namespace sofof::recording

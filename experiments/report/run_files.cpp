// One function per file.
#include "experiments/report/run_files.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "base/text/csv_reader.hpp"
#include "messages/protocol/record.hpp"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string_view>
#include <utility>

namespace sofof::experiments::report {

namespace {

namespace fs = std::filesystem;
using nlohmann::json;
using columns = std::string_view[];

/// Reads the five columns that name an offloading, from `first` on.
session_key name_at(const csv_reader& row, std::size_t first) {
  return {.provider = row.text(first),
          .service = row.text(first + 1),
          .provider_id = row.whole(first + 2),
          .station = row.whole(first + 3),
          .counter = row.whole(first + 4)};
}

bool one_of(const csv_reader& row, std::size_t column, std::string_view yes,
            std::string_view no) {
  if (row.text(column) != yes && row.text(column) != no)
    row.refuse(column, fmt::format("is neither {} nor {}", yes, no));
  return row.text(column) == yes;
}

bool was_killed(const fs::path& folder) {
  return !fs::exists(folder / "summary.json");
}

csv_reader::ending ending_of(const fs::path& folder) {
  return was_killed(folder) ? csv_reader::ending::killed
                            : csv_reader::ending::whole;
}

/// @param levels  Of objects in objects; deeper ones are none of ours.
void collect(const json& from, const std::string& prefix, int levels,
             std::map<std::string, double>& to) {
  for (const auto& [name, value] : from.items())
    if (value.is_number())
      to[prefix + name] = value.get<double>();
    else if (value.is_object() && levels > 0)
      collect(value, prefix + name + '.', levels - 1, to);
}

std::string text_of(const json& summary, const char* name) {
  if (!summary.is_object())
    return {};
  const auto found = summary.find(name);
  return found != summary.end() && found->is_string()
             ? found->get<std::string>()
             : std::string{};
}

/// A line of events.jsonl and its place.
class event_reader {
public:
  event_reader(std::string_view text, std::string place)
      : place_{std::move(place)}, line_(json::parse(text, nullptr, false)) {
    if (!line_.is_object())
      refuse("this is no JSON object");
  }

  double seconds(const char* name) const {
    const auto& x = member(name);
    if (!x.is_number() || !std::isfinite(x.get<double>()))
      refuse(fmt::format("\"{}\" should be a number", name));
    return x.get<double>();
  }

  std::uint64_t whole(const char* name) const {
    const auto& x = member(name);
    if (!x.is_number_unsigned())
      refuse(fmt::format("\"{}\" should be a whole number", name));
    return x.get<std::uint64_t>();
  }

  std::string text(const char* name) const {
    const auto& x = member(name);
    if (!x.is_string())
      refuse(fmt::format("\"{}\" should be a text", name));
    return x.get<std::string>();
  }

private:
  const json& member(const char* name) const {
    const auto found = line_.find(name);
    if (found == line_.end())
      refuse(fmt::format("\"{}\" is missing", name));
    return *found;
  }

  [[noreturn]] void refuse(std::string_view why) const {
    throw input_error{fmt::format("{}: {}.", place_, why)};
  }

  std::string place_;
  json line_;
};

} // namespace

bool episode_line::is_cut_off() const {
  return reason == messages::name_of(messages::end_reason::shutdown)
         && because != messages::told_by_provider;
}

std::vector<episode_line> read_episodes(const fs::path& folder) {
  static constexpr columns names{"provider",   "service",      "provider_id",
                                 "station",    "counter",      "side",
                                 "accepted_s", "first_data_s", "ended_s",
                                 "t_off_s",    "reason",       "fallback"};
  static constexpr columns newer{"because"};
  enum { side = 5, accepted, first_data, ended, t_off, reason, fallback };
  constexpr auto because = fallback + 1;
  csv_reader row{folder / "episodes.csv", names, ending_of(folder), newer};
  const auto is_read = [](const std::string& name) {
    return std::ranges::find(names, name) != std::end(names)
           || std::ranges::find(newer, name) != std::end(newer);
  };
  std::vector<episode_line> all;
  while (row.next()) {
    all.push_back({.of = name_at(row, 0),
                   .by_requester = one_of(row, side, "requester", "provider"),
                   .accepted_s = row.number(accepted),
                   .first_data_s = row.number_if_any(first_data),
                   .ended_s = row.number(ended),
                   .t_off_s = row.number_if_any(t_off),
                   .reason = row.text(reason),
                   .fallback = row.flag(fallback),
                   .because = row.has(because) ? row.text(because) : ""});
    for (std::size_t i = 0; i < row.header().size(); ++i)
      if (!is_read(row.header()[i]))
        all.back().others.emplace_back(row.header()[i], row.field(i));
  }
  return all;
}

namespace of_cycles {

constexpr columns names{
    "provider", "service",    "provider_id", "station", "counter",
    "cycle",    "received_s", "latency_ms",  "used",    "interarrival_ms"};
constexpr columns newer{"input_age_ms",     "uplink_wait_ms", "uplink_ms",
                        "rest_ms",          "queue_ms",       "computing_ms",
                        "downlink_wait_ms", "downlink_ms"};
enum { cycle = 5, received, latency, used, interarrival, input_age, parts };
constexpr std::size_t part_count = 7;

} // namespace of_cycles

cycle_file::cycle_file(const fs::path& folder) {
  const auto file = folder / "cycles.csv";
  if (!fs::exists(file))
    return;
  rows_.emplace(file, of_cycles::names, ending_of(folder), of_cycles::newer);
  has_parts_ = true;
  for (std::size_t k = 0; k < of_cycles::part_count; ++k)
    has_parts_ = has_parts_ && rows_->has(of_cycles::parts + k);
}

std::optional<cycle_line> cycle_file::next() {
  using namespace of_cycles;
  if (!rows_ || !rows_->next())
    return std::nullopt;
  const auto& row = *rows_;
  const auto part = [&row](std::size_t k) { return row.number(parts + k); };
  cycle_line line;
  line.of = name_at(row, 0);
  line.cycle = row.whole(cycle);
  line.received_s = row.number(received);
  line.latency_ms = row.number(latency);
  line.used = row.flag(used);
  line.interarrival_ms = row.number_if_any(interarrival);
  if (row.has(input_age))
    line.input_age_ms = row.number_if_any(input_age);
  if (has_parts_)
    line.parts = {part(0), part(1), part(2), part(3),
                  part(4), part(5), part(6)};
  return line;
}

std::optional<std::vector<cycle_line>>
read_cycles(const fs::path& folder,
            const std::function<bool(const session_key&)>& wanted) {
  cycle_file rows{folder};
  if (!rows.is_there())
    return std::nullopt;
  std::vector<cycle_line> all;
  while (auto line = rows.next())
    if (!wanted || wanted(line->of))
      all.push_back(std::move(*line));
  return all;
}

std::vector<load_line> read_load(const fs::path& folder) {
  static constexpr columns names{"t_s", "provider", "what", "asked_share"};
  static constexpr columns newer{"mean_wait_ms", "max_wait_ms"};
  enum { mean_wait = 4, max_wait = 5 };
  const auto file = folder / "load.csv";
  std::vector<load_line> all;
  if (!fs::exists(file))
    return all;
  csv_reader row{file, names, ending_of(folder), newer};
  const auto wait = [&row](std::size_t column) {
    return row.has(column) ? row.number_if_any(column) : std::nullopt;
  };
  while (row.next())
    all.push_back({row.number(0), row.text(1), row.text(2), row.number(3),
                   wait(mean_wait), wait(max_wait)});
  return all;
}

std::vector<octets_line> read_octets(const fs::path& folder) {
  static constexpr columns names{"provider", "direction", "what", "messages",
                                 "sent",     "delivered", "lost", "under_way"};
  static constexpr columns newer{"t_s"};
  enum { time = 8 };
  const auto file = folder / "octets.csv";
  std::vector<octets_line> all;
  if (!fs::exists(file))
    return all;
  csv_reader row{file, names, ending_of(folder), newer};
  while (row.next())
    all.push_back(
        {row.has(time) ? std::optional{row.number(time)} : std::nullopt,
         row.text(0), row.text(1), row.text(2), row.whole(3), row.whole(4),
         row.whole(5), row.whole(6), row.whole(7)});
  return all;
}

std::vector<claim_line> read_claims(const fs::path& folder) {
  static constexpr columns names{"station",  "lane",     "claimed_s", "bound_s",
                                 "enters_s", "leaves_s", "kept"};
  enum { station, lane, claimed, bound, enters, leaves, kept };
  const auto file = folder / "claims.csv";
  std::vector<claim_line> all;
  if (!fs::exists(file))
    return all;
  csv_reader row{file, names, ending_of(folder)};
  while (row.next())
    all.push_back({row.whole(station), row.text(lane), row.number(claimed),
                   row.number_if_any(bound), row.number(enters),
                   row.number(leaves), row.whole(kept) != 0});
  return all;
}

std::vector<response_line> read_responses(const fs::path& folder) {
  static constexpr columns names{"station", "t_s", "response_ms"};
  enum { station, t, response };
  const auto file = folder / "responses.csv";
  std::vector<response_line> all;
  if (!fs::exists(file))
    return all;
  csv_reader row{file, names, ending_of(folder)};
  while (row.next())
    all.push_back({row.whole(station), row.number(t), row.number(response)});
  return all;
}

std::vector<scene_line> read_scene(const fs::path& folder) {
  static constexpr columns names{"station", "t_s", "service", "safe_ms"};
  enum { station, t, service, safe };
  const auto file = folder / "scene.csv";
  std::vector<scene_line> all;
  if (!fs::exists(file))
    return all;
  csv_reader row{file, names, ending_of(folder)};
  while (row.next())
    all.push_back({row.whole(station), row.number(t), row.text(service),
                   row.number(safe)});
  return all;
}

std::optional<recording::load_table> read_disturbed(const fs::path& folder) {
  static constexpr columns names{"t_s",  "provider", "direction", "station",
                                 "what", "lost",     "outage",    "stall"};
  static constexpr columns newer{"slow", "copied", "overtaken"};
  constexpr std::size_t slow = 8, copied = 9, overtaken = 10;
  const auto file = folder / "disturbed.csv";
  if (!fs::exists(file))
    return std::nullopt;
  recording::load_table all;
  csv_reader row{file, names, ending_of(folder), newer};
  all.tells_slow = row.has(slow);
  const auto if_any = [&row](std::size_t column) {
    return row.has(column) ? row.whole(column) : 0;
  };
  while (row.next()) {
    const auto& provider = row.text(1);
    const auto* direction = row.text(2) == "up" ? "up" : "down";
    if (row.text(2) != direction)
      row.refuse(2, "is neither up nor down");
    if (std::abs(row.number(0)) > to_seconds(longest_time))
      row.refuse(0, "is no time in a run");
    if (row.whole(3) > std::numeric_limits<station_id::rep>::max())
      row.refuse(3, "is no station");
    auto cell = std::ranges::find_if(all.cells, [&](const auto& x) {
      return x.provider == provider && x.direction == direction;
    });
    if (cell == all.cells.end())
      cell = all.cells.insert(cell, {provider, direction, {}, {}});
    cell->disturbed.push_back(
        {from_seconds(row.number(0)),
         static_cast<station_id::rep>(row.whole(3)),
         row.text(4),
         {row.whole(5), row.whole(6), row.whole(7), if_any(slow),
          if_any(copied), if_any(overtaken)}});
  }
  return all;
}

std::optional<std::vector<track_line>> read_tracks(const fs::path& folder) {
  static constexpr columns names{"station",     "t_s",       "x_m",   "y_m",
                                 "heading_rad", "speed_mps", "source"};
  enum { station, t, x, y, heading, speed, source };
  const auto file = folder / "tracks.csv";
  if (!fs::exists(file))
    return std::nullopt;
  csv_reader row{file, names, ending_of(folder)};
  std::vector<track_line> all;
  while (row.next())
    all.push_back({.station = row.whole(station),
                   .t_s = row.number(t),
                   .x_m = row.number(x),
                   .y_m = row.number(y),
                   .heading_rad = row.number(heading),
                   .speed_mps = row.number(speed),
                   .remote = one_of(row, source, "remote", "local")});
  return all;
}

std::optional<run_summary> read_summary(const fs::path& folder) {
  const auto file = folder / "summary.json";
  if (!fs::exists(file))
    return std::nullopt;
  constexpr auto no_exceptions = false;
  const auto text = read_text(file).value_or("");
  const auto all = json::parse(text, nullptr, no_exceptions);
  if (!all.is_object())
    throw input_error{fmt::format(
        "{}: this is no JSON object, which every run writes.", file.string())};
  run_summary summary;
  constexpr int levels = 4;
  collect(all, "", levels, summary.figures);
  summary.version = text_of(all, "version");
  summary.clock = text_of(all, "clock");
  summary.interrupted = all.value("interrupted", json{}) == true;
  if (const auto said = all.find("headline"); said != all.end())
    for (const auto* name : {"offloading", "safety", "load"})
      if (auto text = text_of(*said, name); !text.empty())
        summary.headline.push_back(std::move(text));
  return summary;
}

event_file::event_file(const fs::path& folder)
    : name_{(folder / "events.jsonl").string()}, lines_{name_},
      was_killed_{was_killed(folder)} {}

std::optional<event_line> event_file::next() {
  const auto text = lines_.next();
  if (!text || (!lines_.has_end() && was_killed_))
    return std::nullopt;
  const auto place = fmt::format("{}:{}", name_, lines_.number());
  if (!lines_.has_end())
    throw input_error{fmt::format("{}: this line is cut off.", place)};
  const event_reader line{*text, place};
  return event_line{.t_s = line.seconds("t_s"),
                    .what = line.text("what"),
                    .of = {.provider = line.text("provider"),
                           .service = line.text("service"),
                           .provider_id = line.whole("provider_id"),
                           .station = line.whole("station"),
                           .counter = line.whole("counter")},
                    .detail = line.text("detail")};
}

std::vector<event_line> read_events(const fs::path& folder) {
  std::vector<event_line> all;
  event_file events{folder};
  while (auto one = events.next())
    all.push_back(std::move(*one));
  return all;
}

} // namespace sofof::experiments::report

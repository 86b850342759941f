// One row, one step.
#include "experiments/conformance/trace_file.hpp"

#include "actors/services/service_type.hpp"
#include "base/input_error.hpp"
#include "base/text/csv_reader.hpp"
#include "experiments/report/run_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <chrono>
#include <limits>
#include <string>
#include <string_view>

namespace sofof::experiments::conformance {

namespace {

/// On the wall's clock, where a timer waits for its actor's turn. A process
/// that stood still for longer is late by more.
constexpr duration usual_slack = std::chrono::milliseconds{250};

enum column : std::size_t {
  t_s,
  by,
  step,
  what,
  provider_id_,
  station_,
  number,
  services,
  detail
};
constexpr std::string_view columns[]{"t_s",    "by",          "step",
                                     "what",   "provider_id", "station",
                                     "number", "services",    "detail"};

/// @returns the value that has this name.
template <class Value>
Value named(const csv_reader& row, column of, const auto& names) {
  const auto i = std::ranges::find(names, row.text(of));
  if (i == names.end())
    row.refuse(of, "is no such name");
  return static_cast<Value>(i - names.begin());
}

/// Reads "one#7".
messages::traced_service service_of(const csv_reader& row,
                                    std::string_view text) {
  messages::traced_service made;
  const auto mark = text.rfind('#');
  if (mark == text.npos || mark > messages::service_name::max_size)
    row.refuse(services, "names no services with counters");
  made.name = text.substr(0, mark);
  const auto digits = text.substr(mark + 1);
  const auto* end = digits.data() + digits.size();
  if (const auto read = std::from_chars(digits.data(), end, made.counter);
      read.ec != std::errc{} || read.ptr != end)
    row.refuse(services, "names no services with counters");
  return made;
}

messages::trace_record step_of(const csv_reader& row) {
  messages::trace_record x{
      .at = time_point{from_seconds(row.number(t_s))},
      .by = named<messages::trace_part>(row, by, messages::trace_part_names),
      .step = row.whole(step),
      .what =
          named<messages::trace_step>(row, what, messages::trace_step_names),
      .provider = row.whole(provider_id_),
      .station = static_cast<std::uint32_t>(row.whole(station_)),
      .number = row.whole(number),
      .detail = row.text(detail)};
  std::string_view rest = row.text(services);
  while (!rest.empty()) {
    const auto end = std::min(rest.find(' '), rest.size());
    x.services.push_back(service_of(row, rest.substr(0, end)));
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
  if (!trace_checker::is_well_formed(x))
    row.refuse(services, "do not fit this step");
  return x;
}

} // namespace

std::filesystem::path trace_file_of(const std::filesystem::path& folder) {
  return folder / "protocol_trace.csv";
}

duration slack_of(const std::filesystem::path& folder) {
  const auto summary = report::read_summary(folder);
  return summary && summary->clock == "virtual" ? duration{0} : usual_slack;
}

services_before chain_of_services() {
  services_before chain;
  for (const auto name : actors::service_type_names())
    if (const auto before = actors::make_service_type(name)->follows();
        !before.empty())
      chain.emplace(name, before);
  return chain;
}

void read_trace(const std::filesystem::path& folder, std::size_t trace,
                trace_checker& to) {
  const auto file = trace_file_of(folder);
  if (!std::filesystem::exists(file))
    throw input_error{fmt::format(
        "{}: there is no such file; run with --set record.trace=true.",
        file.string())};
  const auto end = report::read_summary(folder) ? csv_reader::ending::whole
                                                : csv_reader::ending::killed;
  csv_reader row{file, columns, end};
  while (row.next())
    to.add(step_of(row), {trace, row.line()});
}

} // namespace sofof::experiments::conformance

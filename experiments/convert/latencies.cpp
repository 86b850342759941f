// The latencies of a run as a trace that channels can replay.
#include "base/input_error.hpp"
#include "experiments/convert/formats.hpp"

#include <fmt/format.h>

namespace sofof::experiments::convert {

namespace {

constexpr std::string_view cycle_columns[]{"service", "received_s",
                                           "latency_ms"};

} // namespace

void write_latencies(const recorded_drive& drive, const sink& put) {
  const auto file = drive.folder / "cycles.csv";
  if (!std::filesystem::exists(file))
    throw input_error{fmt::format("{} is not there: the run was told not to "
                                  "write cycles.",
                                  file.string())};
  csv_reader rows{file, cycle_columns, ending_of(drive.folder)};
  put("time_s,delay_ms\n");
  enum { service, received, latency };
  while (rows.next())
    if (rows.text(service) == "trajectory_planning")
      put(fmt::format("{:.3f},{:.3f}\n", rows.number(received),
                      rows.number(latency)));
}

} // namespace sofof::experiments::convert

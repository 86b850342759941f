// The command-line arguments of processes that talk to others.
#pragma once

#include "apps/signals.hpp"
#include "base/input_error.hpp"
#include "base/options/units.hpp"
#include "scenario/hosts.hpp"

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include <charconv>
#include <string>

namespace sofof::apps {

struct host_arguments {
  bool own_map = false;
  std::string keys;
  // For tests; not shown.
  std::string clock;
  std::uint32_t protocol = messages::remote_protocol;

  void add_to(CLI::App& command) {
    command.add_flag("--own-map", own_map,
                     "The other side may have another map, in the same frame; "
                     "both sides have to say so");
    command
        .add_option("--keys", keys,
                    "Folder of the own certificate, see `sofof keys`")
        ->type_name("DIR");
    command.add_option("--test-clock", clock)->group("");
    command.add_option("--test-protocol", protocol)->group("");
  }

  /// @param to  Gets them.
  void give(scenario::host_options& to) const {
    to.own_map = own_map;
    to.keys = keys;
    if (!keys.empty()) {
      to.keys_have_changed = &keys_have_changed;
      catch_hang_up();
    }
    to.clock = clock_error_of(clock);
    to.protocol = protocol;
  }

private:
  /// SHIFT,DRIFT: e.g. "500ms,50", the drift in ppm.
  static actors::clock_error clock_error_of(const std::string& text) {
    if (text.empty())
      return {};
    const auto late = text.starts_with('-');
    const auto comma = text.find(',');
    const auto shift = parse_duration(text.substr(late, comma - late));
    double ppm = 0;
    if (comma != std::string::npos)
      std::from_chars(text.data() + comma + 1, text.data() + text.size(), ppm);
    if (!shift)
      throw input_error("--test-clock takes a shift and a drift in ppm, like "
                        "500ms,50");
    constexpr double per_ppm = 1e-6;
    return {late ? -*shift : *shift, per_ppm * ppm, {}};
  }
};

} // namespace sofof::apps

// What a scenario says of how vehicles foresee results by place.
#pragma once

#include "base/options/option_helpers.hpp"
#include "policies/algorithms/forecast/quality_map.hpp"

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::scenario {

/// A line of a file of what was learned where.
struct known_place {
  std::uint32_t provider = 0; ///< Its place in the scenario's file.
  std::string service;
  point at; ///< Middle of the cell, m.
  policies::cell_quality known;
};

/// Where forecasts of results by place come from.
struct forecast_options {
  /// "none"; "learned": of what vehicles see in the run; "file": of what is
  /// in `file` alone; "oracle": of the channel's areas.
  std::string source = "none";
  double cell_m = 10; ///< Edge of the cells of what is learned.
  /// Whether all vehicles of a process learn into one map, at once, as if a
  /// service in the cloud told each what the others see; else each for itself.
  bool shared = false;
  /// What was learned in an earlier run (quality.csv), relative to the scenario
  /// file: "learned" begins with it, "file" goes by it.
  std::string file;

  std::string text;                ///< What the file says; empty for none.
  std::vector<known_place> places; ///< The same, read.

  bool learns() const { return source == "learned"; }

  void visit_options(option_visitor& s) {
    constexpr std::array<std::string_view, 4> sources{"file", "learned", "none",
                                                      "oracle"};
    visit_word(s, "source", source, "source of forecasts", sources);
    s.field("cell_m", cell_m, {1, 1000});
    s.field("shared", shared);
    if (shared && !learns())
      s.refuse("shared", "has no effect unless source is \"learned\".");
    if (s.has("file", !file.empty())) {
      s.field("file", file);
      if (file.empty())
        s.refuse("file", "must name a file.");
      if (source != "file" && !learns())
        s.refuse("file", "has no effect unless source is \"file\" or "
                         "\"learned\".");
    } else if (source == "file") {
      s.refuse("source", "needs a file: add file = \"FILE\", the quality.csv "
                         "of an earlier run.");
    }
  }
};

} // namespace sofof::scenario

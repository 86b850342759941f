// When vehicles send what.
#pragma once

#include "messages/v2x/generation_rules.hpp"
#include "world/settings.hpp"

#include <algorithm>
#include <array>
#include <string>
#include <string_view>

namespace sofof {

/// What a scenario says of the messages of its vehicles.
struct v2x_options {
  /// "triggered": by the rules of ETSI, 1 to 10 a second; "fixed_10hz".
  std::string cam = "triggered";
  /// Likewise, or "off": none.
  std::string cpm = "triggered";
  /// "tr103562", which everybody reads, or "ts103324", its successor.
  std::string cpm_version = "tr103562";

  generation_rule cam_rule() const { return rule_of(cam); }
  generation_rule cpm_rule() const { return rule_of(cpm); }
  bool sends_cpms() const { return cpm != "off"; }
  bool is_release_2() const { return cpm_version == "ts103324"; }

  void fields(settings& s) {
    word(s, "cam", cam, std::array{"triggered", "fixed_10hz"});
    word(s, "cpm", cpm, std::array{"triggered", "fixed_10hz", "off"});
    word(s, "cpm_version", cpm_version, std::array{"tr103562", "ts103324"});
  }

private:
  static generation_rule rule_of(std::string_view name) {
    return name == "fixed_10hz" ? generation_rule::fixed_10hz
                                : generation_rule::triggered;
  }

  static void word(settings& s, std::string_view key, std::string& value,
                   const auto& known) {
    s.field(key, value);
    if (std::ranges::find(known, value) != known.end())
      return;
    std::string choice;
    for (const std::string_view name : known)
      (choice += choice.empty() ? "" : ", ").append(name);
    s.refuse(key, "'" + value + "' is not known; choose one of " + choice);
  }
};

} // namespace sofof

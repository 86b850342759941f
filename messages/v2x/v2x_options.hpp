// When vehicles send what.
#pragma once

#include "base/options/option_visitor.hpp"
#include "base/options/spelling.hpp"
#include "messages/v2x/generation_rules.hpp"

#include <algorithm>
#include <array>
#include <span>
#include <string>
#include <string_view>

namespace sofof::messages {

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

  void visit_options(option_visitor& s) {
    using namespace std::string_view_literals;
    constexpr std::array cam_rules{"triggered"sv, "fixed_10hz"sv};
    constexpr std::array cpm_rules{"triggered"sv, "fixed_10hz"sv, "off"sv};
    constexpr std::array cpm_versions{"tr103562"sv, "ts103324"sv};
    word(s, "cam", cam, "rule for CAMs", cam_rules);
    word(s, "cpm", cpm, "rule for CPMs", cpm_rules);
    word(s, "cpm_version", cpm_version, "version of the CPM", cpm_versions);
  }

private:
  static generation_rule rule_of(std::string_view name) {
    return name == "fixed_10hz" ? generation_rule::fixed_10hz
                                : generation_rule::triggered;
  }

  static void word(option_visitor& s, std::string_view key, std::string& value,
                   std::string_view what,
                   std::span<const std::string_view> known) {
    s.field(key, value);
    if (std::ranges::find(known, value) == known.end())
      s.refuse(key, unknown_word(what, value, known));
  }
};

} // namespace sofof::messages

// sofof policies: what decides, and by what.
#include "apps/annotated_options.hpp"
#include "apps/command.hpp"
#include "apps/terminal.hpp"
#include "base/input_error.hpp"
#include "base/options/spelling.hpp"
#include "base/text/wrapped.hpp"
#include "policies/registry.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <unistd.h>
#include <vector>

namespace sofof::apps {

namespace {

/// Everything of one sort that a scenario can name.
struct role {
  std::string_view key; ///< In `[policies]`.
  std::string_view what;
  std::vector<policies::policy_info> all;
  /// Lists the options of one.
  std::function<void(option_visitor&, std::string_view name)> options;
  bool several = false; ///< A list of them.
};

/// @param make  From a name to what has options.
template <class Make>
auto options_by(Make make) {
  return [make](option_visitor& s, std::string_view name) {
    make(name)->visit_options(s);
  };
}

std::vector<role> roles() {
  return {
      {"lodm", "in the vehicle: which provider to ask", policies::lodm_notes(),
       options_by(policies::make_lodm)},
      {"codm", "at the provider: which requests to accept",
       policies::codm_notes(), options_by(policies::make_codm)},
      {"lodm.filter", "before it: which providers may be asked",
       policies::local_filter_notes(), options_by(policies::make_local_filter)},
      {"codm.filter", "before it: which requests may be accepted",
       policies::central_filter_notes(),
       options_by(policies::make_central_filter)},
      {"lodm.govern", "after it, one or several: the last word",
       policies::governor_notes(), options_by(policies::make_governor), true}};
}

/// A line, or several where a terminal is too narrow for it: below each other.
/// @param first  ASCII.
std::string hanging(const std::string& first, std::string_view text) {
  const auto line = fmt::format("{}{}\n", first, text);
  const auto width = terminal_width(STDOUT_FILENO);
  return width ? wrapped(line, *width, first.size()) : line;
}

std::string list(const role& one) {
  auto text = fmt::format("{}, {}\n", one.key, one.what);
  for (const auto& notes : one.all)
    text += hanging(fmt::format("  {:<18} ", notes.name), notes.summary);
  return text;
}

std::string describe(const role& sort, const policies::policy_info& one) {
  const auto header = sort.several ? fmt::format("[[policies.{}]]", sort.key)
                                   : fmt::format("[policies.{}]", sort.key);
  const auto options = [&](option_visitor& s) {
    std::string name{one.name};
    s.field("name", name);
    sort.options(s, name);
  };
  return hanging(fmt::format("{} as {}: ", one.name, sort.key), one.summary)
         + hanging("  decides by: ", one.rule)
         + hanging("  sees:       ", one.sees)
         + hanging("  source:     ", one.source) + "\n"
         + print_documented(header, options, one.parameters);
}

std::string describe(std::string_view name) {
  std::string text;
  std::vector<std::string_view> known;
  for (const auto& sort : roles())
    for (const auto& one : sort.all) {
      if (std::ranges::find(known, one.name) == known.end())
        known.push_back(one.name);
      if (one.name == name)
        text += (text.empty() ? "" : "\n") + describe(sort, one);
    }
  if (text.empty())
    throw input_error{unknown_word("policy", name, known)};
  return text + "\nThese are the defaults. docs/policies.md tells more.\n";
}

std::string list() {
  std::string text;
  for (const auto& sort : roles())
    text += list(sort);
  return text + "\nsofof policies NAME describes one.\n";
}

} // namespace

void add_policies(CLI::App& app, int&) {
  auto* command = app.add_subcommand(
      "policies", "List the policies that decide, or describe one");
  auto name = std::make_shared<std::string>();
  command->add_option("NAME", *name, "Of a policy")->type_name(" ");
  command->footer("Example:\n  sofof policies least_loaded");
  command->callback([name] {
    if (name->empty())
      std::cout << list();
    else
      std::cout << describe(*name);
  });
}

} // namespace sofof::apps

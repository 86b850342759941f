// sofof policies: what decides, and by what.
#include "apps/command.hpp"
#include "policies/registry.hpp"
#include "scenario/input_error.hpp"
#include "scenario/settings_printer.hpp"
#include "world/spelling.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <functional>
#include <iostream>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace sofof {

namespace {

std::string list(std::string_view title, const std::vector<policy_notes>& all) {
  auto text = fmt::format("{}\n", title);
  for (const auto& one : all)
    text += fmt::format("  {:<14} {}\n", one.name, one.summary);
  return text;
}

/// @param key      Of the policy in a scenario: lodm or codm.
/// @param options  Lists those of the policy.
std::string describe(const policy_notes& one, std::string_view key,
                     const std::function<void(settings&)>& options) {
  std::string name{one.name};
  const auto table = print_settings([&](settings& all) {
    all.table("policies", [&](settings& policies) {
      policies.table(key, [&](settings& s) {
        s.field("name", name);
        options(s);
      });
    });
  });
  return fmt::format("{} as {}: {}\n"
                     "  decides by: {}\n"
                     "  sees:       {}\n"
                     "  source:     {}\n\n"
                     "In a scenario, with its defaults:\n{}",
                     one.name, key, one.summary, one.rule, one.sees, one.source,
                     table);
}

template <class Make>
void describe_if_known(std::string& text, std::string_view name,
                       std::string_view key,
                       const std::vector<policy_notes>& all, Make make) {
  const auto found = std::ranges::find(all, name, &policy_notes::name);
  if (found == all.end())
    return;
  const auto policy = make(name);
  if (!text.empty())
    text += '\n';
  text += describe(*found, key, [&](settings& s) { policy->fields(s); });
}

std::string describe(std::string_view name) {
  std::string text;
  describe_if_known(text, name, "lodm", lodm_notes(), make_lodm);
  describe_if_known(text, name, "codm", codm_notes(), make_codm);
  if (!text.empty())
    return text;
  auto known = lodm_names();
  for (const auto other : codm_names())
    if (std::ranges::find(known, other) == known.end())
      known.push_back(other);
  throw input_error{unknown_word("policy", name, known)};
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
      std::cout << list("lodm, in the vehicle: whom to ask", lodm_notes())
                << list("codm, at the provider: whom to accept", codm_notes());
    else
      std::cout << describe(*name);
  });
}

} // namespace sofof

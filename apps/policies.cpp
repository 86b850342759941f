// sofof policies: what decides, and by what.
#include "apps/command.hpp"
#include "policies/govern/governors.hpp"
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

/// Everything of one sort that a scenario can name.
struct part {
  std::string_view key; ///< In `[policies]`.
  std::string_view what;
  std::vector<policy_notes> all;
  /// Lists where it stands in a scenario, with its options.
  std::function<void(settings&, std::string_view name)> show;
};

void show_table(settings& s, std::string_view key, std::string_view name,
                const std::function<void(settings&)>& options) {
  s.table(key, [&](settings& t) {
    std::string text{name};
    t.field("name", text);
    options(t);
  });
}

/// @returns how to show what `make` makes.
template <class Make>
auto shown_by(std::string_view key, Make make) {
  return [key, make](settings& s, std::string_view name) {
    show_table(s, key, name, [&](settings& t) { make(name)->fields(t); });
  };
}

template <class Make>
auto shown_inside(std::string_view side, Make make) {
  return [side, make](settings& s, std::string_view name) {
    s.table(side, [&](settings& t) { shown_by("filter", make)(t, name); });
  };
}

void show_governor(settings& s, std::string_view name) {
  s.table("lodm", [name](settings& lodm) {
    lodm.tables("govern", 1, [name](std::size_t, settings& t) {
      std::string text{name};
      t.field("name", text);
      make_governor(name)->fields(t);
    });
  });
}

std::vector<part> parts() {
  return {{"lodm", "in the vehicle: whom to ask", lodm_notes(),
           shown_by("lodm", make_lodm)},
          {"codm", "at the provider: whom to accept", codm_notes(),
           shown_by("codm", make_codm)},
          {"lodm.filter", "before it: who comes into question",
           local_filter_notes(), shown_inside("lodm", make_local_filter)},
          {"codm.filter", "before it: who comes into question",
           central_filter_notes(), shown_inside("codm", make_central_filter)},
          {"lodm.govern", "after it, one or several: the last word",
           governor_notes(), show_governor}};
}

std::string list(const part& one) {
  auto text = fmt::format("{}, {}\n", one.key, one.what);
  for (const auto& notes : one.all)
    text += fmt::format("  {:<18} {}\n", notes.name, notes.summary);
  return text;
}

std::string list_parameters(const std::vector<parameter_note>& all) {
  std::string text;
  for (const auto& one : all)
    text += fmt::format("  {:<17} {}{}{}\n", one.name, one.meaning,
                        one.unit == "1" ? "" : ", ",
                        one.unit == "1" ? "" : one.unit);
  return text.empty() ? text : "\nOptions:\n" + text;
}

std::string describe(const part& sort, const policy_notes& one) {
  const auto table = print_settings([&](settings& all) {
    all.table("policies",
              [&](settings& policies) { sort.show(policies, one.name); });
  });
  return fmt::format("{} as {}: {}\n"
                     "  decides by: {}\n"
                     "  sees:       {}\n"
                     "  source:     {}\n"
                     "{}\n"
                     "In a scenario, with its defaults:\n{}",
                     one.name, sort.key, one.summary, one.rule, one.sees,
                     one.source, list_parameters(one.parameters), table);
}

std::string describe(std::string_view name) {
  std::string text;
  std::vector<std::string_view> known;
  for (const auto& sort : parts())
    for (const auto& one : sort.all) {
      if (std::ranges::find(known, one.name) == known.end())
        known.push_back(one.name);
      if (one.name == name)
        text += (text.empty() ? "" : "\n") + describe(sort, one);
    }
  if (text.empty())
    throw input_error{unknown_word("policy", name, known)};
  return text;
}

std::string list() {
  std::string text;
  for (const auto& sort : parts())
    text += list(sort);
  return text;
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

} // namespace sofof

// From a sweep file to its points.
#include "experiments/sweep/plan.hpp"

#include "base/input_error.hpp"
#include "base/options/toml_file.hpp"
#include "base/options/toml_nodes.hpp"
#include "base/options/toml_options.hpp"
#include "base/options/toml_text.hpp"
#include "base/random.hpp"
#include "experiments/sweep/plan_keys.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cassert>
#include <iterator>
#include <numeric>
#include <ranges>

namespace sofof::experiments {

namespace {

/// Reads one sweep file; every mistake is thrown with its place.
class sweep_reader {
public:
  sweep_reader(std::string_view text, const std::filesystem::path& file)
      : file_{file.string()}, root_{parse_toml(text, file_)} {}

  sweep_plan read(std::span<const std::string> overrides) {
    known(root_, sweep_keys);
    sweep_plan plan;
    plan.name = text_of(root_, "name");
    if (plan.name.find_first_of("/\\") != plan.name.npos)
      fail(*root_.get("name"), "name is part of a file's name: no slashes.");
    plan.scenario =
        std::filesystem::path{file_}.parent_path() / text_of(root_, "scenario");
    read_seeds(plan.seeds);
    if (const auto* set = root_.get("set"))
      plan.given = assignments(*set);
    plan.given.insert(plan.given.end(), overrides.begin(), overrides.end());
    if (const auto* axes = root_.get("axis"))
      for (const auto* axis : tables_of(*axes, "axis"))
        plan.axes.push_back(axis_of(*axis));
    if (const auto* draws = root_.get("draw"))
      for (const auto* draw : tables_of(*draws, "draw"))
        plan.draws.push_back(draw_of(*draw));
    check_axes(plan);
    read_most_seeds(plan);
    if (plan.size() > most_sweep_points)
      fail(root_, fmt::format("these are {} runs; {} are the most.",
                              plan.size(), most_sweep_points));
    return plan;
  }

private:
  [[noreturn]] void fail(const toml::node& at, std::string_view why) const {
    throw input_error{fmt::format("{}: {}", place_of(at.source(), file_), why)};
  }

  void known(const toml::table& table,
             std::span<const sweep_key> allowed) const {
    const auto names = allowed | std::views::transform(&sweep_key::name);
    for (const auto& [key, value] : table)
      if (std::ranges::find(names, key.str()) == names.end())
        fail(value, fmt::format("there is no option \"{}\"; these are: {}.",
                                key.str(), fmt::join(names, ", ")));
  }

  std::string text_of(const toml::table& table, std::string_view key) const {
    const auto* node = table.get(key);
    if (!node)
      fail(table, fmt::format("{} is missing.", key));
    const auto text = node->value_exact<std::string>();
    if (!text || text->empty())
      fail(*node, fmt::format("{} must be a text.", key));
    return *text;
  }

  std::vector<const toml::table*> tables_of(const toml::node& node,
                                            std::string_view key) const {
    const auto* list = node.as_array();
    if (!list || list->empty() || !list->is_homogeneous<toml::table>())
      fail(node, fmt::format("{0} must be a list of tables, [[{0}]].", key));
    std::vector<const toml::table*> tables;
    for (const auto& entry : *list)
      tables.push_back(entry.as_table());
    return tables;
  }

  void read_seeds(std::vector<std::int64_t>& seeds) const {
    const auto* node = root_.get("seeds");
    if (!node)
      return;
    if (const auto count = node->value_exact<std::int64_t>()) {
      if (*count < 1 || *count > std::int64_t{most_sweep_points})
        fail(*node, fmt::format("a number of seeds must be from 1 to {}.",
                                most_sweep_points));
      seeds.resize(static_cast<std::size_t>(*count));
      std::iota(seeds.begin(), seeds.end(), 1);
      return;
    }
    seeds.clear();
    if (const auto* list = node->as_array())
      for (const auto& entry : *list) {
        const auto seed = entry.value_exact<std::int64_t>();
        if (!seed)
          fail(entry, "a seed must be an integer.");
        if (std::ranges::find(seeds, *seed) != seeds.end())
          fail(entry, fmt::format("seed {} stands here twice.", *seed));
        seeds.push_back(*seed);
      }
    if (seeds.empty())
      fail(*node, "seeds must be how many, or a list of integers.");
  }

  void read_most_seeds(sweep_plan& plan) const {
    const auto* node = root_.get("most_seeds");
    if (!node)
      return;
    const auto* list = node->as_array();
    if (!list) {
      plan.most_seeds = {seeds_at_most(*node, plan.seeds.size())};
      return;
    }
    for (const auto& entry : *list)
      plan.most_seeds.push_back(seeds_at_most(entry, plan.seeds.size()));
    const auto values = plan.axes.empty() ? 0 : plan.axes[0].values.size();
    if (values == 0 || plan.most_seeds.size() != values)
      fail(*node, fmt::format("most_seeds must be a number, or a list of one "
                              "for each of the {} values of the first axis.",
                              values));
  }

  std::size_t seeds_at_most(const toml::node& node, std::size_t seeds) const {
    const auto count = node.value_exact<std::int64_t>();
    if (!count || *count < static_cast<std::int64_t>(seeds)
        || *count > std::int64_t{most_sweep_points})
      fail(node, fmt::format("most_seeds must be a whole number from {}, the "
                             "number of seeds, to {}.",
                             seeds, most_sweep_points));
    return static_cast<std::size_t>(*count);
  }

  /// @returns "KEY=VALUE" with the value as TOML.
  static std::string assignment(std::string_view key, const toml::node& value) {
    return fmt::format("{}={}", key, value_text(value));
  }

  std::vector<std::string> assignments(const toml::node& node) const {
    const auto* table = node.as_table();
    if (!table)
      fail(node, "set must be a table, { \"KEY\" = VALUE }.");
    std::vector<std::string> all;
    add_assignments(all, "", *table);
    return all;
  }

  /// Tables in it are parts of keys: a.b = 1 is { a = { b = 1 } }.
  static void add_assignments(std::vector<std::string>& all,
                              const std::string& prefix,
                              const toml::table& table) {
    for (const auto& [key, value] : table) {
      const auto whole = prefix + std::string{key.str()};
      if (const auto* inner = value.as_table())
        add_assignments(all, whole + '.', *inner);
      else
        all.push_back(assignment(whole, value));
    }
  }

  static std::string label_of(const toml::node& value) {
    if (const auto text = value.value_exact<std::string>())
      return *text;
    return assignment("", value).substr(1);
  }

  sweep_axis axis_of(const toml::table& table) const {
    sweep_axis axis;
    if (table.contains("value")) {
      known(table, wide_axis_keys);
      axis.name = text_of(table, "name");
      for (const auto* value : tables_of(*table.get("value"), "axis.value")) {
        known(*value, wide_value_keys);
        const auto* set = value->get("set");
        if (!set)
          fail(*value, "set is missing: what this value changes.");
        axis.values.push_back({text_of(*value, "name"), assignments(*set)});
      }
    } else {
      known(table, axis_keys);
      const auto key = text_of(table, "key");
      axis.name = table.contains("name") ? text_of(table, "name") : key;
      const auto* node = table.get("values");
      const auto* list = node ? node->as_array() : nullptr;
      if (!list || list->empty())
        fail(node ? *node : table,
             "values must be a list of at least one value, [1, 2, 3].");
      for (const auto& value : *list)
        axis.values.push_back({label_of(value), {assignment(key, value)}});
    }
    check_labels(axis, table);
    return axis;
  }

  double number_of(const toml::table& table, std::string_view key) const {
    const auto* node = table.get(key);
    if (!node)
      fail(table, fmt::format("{} is missing.", key));
    const auto number = node->value<double>();
    if (!number)
      fail(*node, fmt::format("{} must be a number.", key));
    return *number;
  }

  drawn_option draw_of(const toml::table& table) const {
    drawn_option draw;
    draw.key = text_of(table, "key");
    if (const auto* values = table.get("values")) {
      known(table, drawn_value_keys);
      const auto* list = values->as_array();
      if (!list || list->empty())
        fail(*values, "values must be a list of at least one value, [1, 2].");
      for (const auto& value : *list)
        draw.choices.push_back(assignment(draw.key, value));
      return draw;
    }
    known(table, drawn_number_keys);
    draw.from = number_of(table, "from");
    draw.to = number_of(table, "to");
    if (!(draw.from < draw.to))
      fail(*table.get("to"), "to must be more than from.");
    return draw;
  }

  void check_labels(const sweep_axis& axis, const toml::table& at) const {
    std::vector<std::string_view> labels;
    for (const auto& value : axis.values)
      labels.push_back(value.label);
    std::ranges::sort(labels);
    const auto twice = std::ranges::adjacent_find(labels);
    if (twice != labels.end())
      fail(at, fmt::format("the value {} of {} stands here twice.", *twice,
                           axis.name));
  }

  void check_axes(const sweep_plan& plan) const {
    std::vector<std::string_view> names{"point", "seed", "status", "run"};
    for (const auto& axis : plan.axes) {
      if (axis.name.find_first_of(",\"\n") != axis.name.npos)
        fail(root_, fmt::format("the name of an axis, {}, has a comma, a quote "
                                "or a line end in it; choose another one.",
                                quoted_toml(axis.name)));
      if (std::ranges::find(names, axis.name) != names.end())
        fail(root_, fmt::format("two columns of the results would be called "
                                "\"{}\"; give an axis another name, and vary "
                                "each option once.",
                                axis.name));
      names.push_back(axis.name);
    }
  }

  std::string file_;
  toml::table root_;
};

} // namespace

std::string drawn_option::given(std::int64_t seed) const {
  const auto noise =
      random_stream{static_cast<std::uint64_t>(seed), "sweep"}.part(key);
  if (choices.empty())
    return fmt::format("{}={:.3f}", key, noise.uniform(from, to, 0));
  const auto count = static_cast<double>(choices.size());
  return choices[static_cast<std::size_t>(noise.uniform(0) * count)];
}

std::size_t sweep_plan::combinations() const {
  std::size_t all = 1;
  for (const auto& axis : axes)
    all = std::min(all * axis.values.size(), most_sweep_points + 1);
  return all;
}

std::size_t sweep_plan::most_seeds_of(std::size_t combination) const {
  assert(combination < combinations());
  if (most_seeds.empty())
    return seeds.size();
  const auto of_one_value = combinations() / most_seeds.size();
  return most_seeds[combination / of_one_value];
}

std::size_t sweep_plan::size() const {
  const auto all = seeds_of.empty()
                       ? combinations() * seeds.size()
                       : std::reduce(seeds_of.begin(), seeds_of.end());
  return std::min(all, most_sweep_points + 1);
}

sweep_plan parse_sweep(std::string_view text, const std::filesystem::path& file,
                       std::span<const std::string> overrides) {
  return sweep_reader{text, file}.read(overrides);
}

sweep_plan load_sweep(const std::filesystem::path& file,
                      std::span<const std::string> overrides) {
  return parse_sweep(require_text(file), file, overrides);
}

std::vector<sweep_point> points_of(const sweep_plan& plan) {
  std::vector<sweep_point> points{{{}, 0, plan.given}};
  for (const auto& axis : plan.axes) {
    std::vector<sweep_point> more;
    for (const auto& point : points)
      for (const auto& value : axis.values) {
        auto& next = more.emplace_back(point);
        next.labels.push_back(value.label);
        std::ranges::copy(value.given, std::back_inserter(next.given));
      }
    points = std::move(more);
  }
  assert(plan.seeds_of.empty() || plan.seeds_of.size() == points.size());
  const auto last = *std::ranges::max_element(plan.seeds);
  std::vector<sweep_point> seeded;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const auto count =
        plan.seeds_of.empty() ? plan.seeds.size() : plan.seeds_of[i];
    for (std::size_t k = 0; k < count; ++k) {
      auto& next = seeded.emplace_back(points[i]);
      next.seed =
          k < plan.seeds.size()
              ? plan.seeds[k]
              : last + static_cast<std::int64_t>(k + 1 - plan.seeds.size());
      for (const auto& draw : plan.draws)
        next.given.push_back(draw.given(next.seed));
      next.given.push_back(fmt::format("seed={}", next.seed));
    }
  }
  return seeded;
}

void check_given_once(const sweep_plan& plan, const sweep_point& point,
                      std::string_view base) {
  toml_file file{base, plan.scenario.string()};
  std::vector<std::string> keys;
  for (const auto& given : point.given) {
    keys.push_back(file.numbered(given.substr(0, given.find('='))) + '.');
    file.set(given);
  }
  for (std::size_t i = plan.given.size(); i < keys.size(); ++i)
    for (std::size_t k = 0; k < i; ++k)
      if (keys[i].starts_with(keys[k]) || keys[k].starts_with(keys[i]))
        throw input_error{fmt::format(
            "{} and {} give the same option of {} twice; a sweep varies each "
            "option in one place, seeds in `seeds`.",
            point.given[k], point.given[i], plan.scenario.string())};
}

std::string describe(const sweep_plan& plan, const sweep_point& point) {
  std::string text;
  for (std::size_t i = 0; i < plan.axes.size(); ++i)
    text += fmt::format("{}={}, ", plan.axes[i].name, point.labels[i]);
  return text + fmt::format("seed={}", point.seed);
}

} // namespace sofof::experiments

// Loads options from a table of a TOML file.
#include "base/options/toml_options.hpp"

#include "base/input_error.hpp"
#include "base/options/moved_option.hpp"
#include "base/options/spelling.hpp"
#include "base/options/toml_text.hpp"
#include "base/options/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace sofof {

namespace {

/// Coordinates lie this near the origin, m: UTM's farthest northing.
constexpr auto farthest_m = 1e7;

/// @returns what a value is, for "but is ...".
std::string describe(const toml::node& n) {
  switch (n.type()) {
    case toml::node_type::string:
      return quoted_toml(**n.as_string());
    case toml::node_type::integer:
      return fmt::format("{}", **n.as_integer());
    case toml::node_type::floating_point:
      return number_text(**n.as_floating_point());
    case toml::node_type::boolean:
      return **n.as_boolean() ? "true" : "false";
    case toml::node_type::array:
      return "a list";
    case toml::node_type::table:
      return "a table";
    default:
      return "a date or time";
  }
}

std::string describe(option_visitor::range r) {
  constexpr option_visitor::range all;
  if (r.max == all.max)
    return r.min == all.min ? "finite" : fmt::format("at least {}", r.min);
  if (r.min == all.min)
    return fmt::format("at most {}", r.max);
  return fmt::format("from {} to {}", r.min, r.max);
}

} // namespace

std::string place_of(const toml::source_region& region, std::string_view file) {
  if (!region.path || region.begin.line == 0)
    return std::string{file};
  if (region.path->starts_with(command_line_prefix))
    return *region.path;
  return fmt::format("{}:{}:{}", *region.path, region.begin.line,
                     region.begin.column);
}

toml_options::toml_options(toml::node& node, std::string_view file,
                           std::vector<option_note>& notes)
    : node_{node}, file_{file}, notes_{notes} {}

void toml_options::field(std::string_view key, bool& value) {
  if (const auto* n = find(key)) {
    if (!n->is_boolean())
      fail(*n, key, "must be true or false");
    value = **n->as_boolean();
  }
}

void toml_options::field(std::string_view key, double& value, range r) {
  if (const auto* n = find(key)) {
    value = read_number(*n, key);
    check(*n, key, value, r);
  }
}

void toml_options::field(std::string_view key, std::int64_t& value, range r) {
  if (const auto* n = find(key)) {
    if (!n->is_integer())
      fail(*n, key, "must be a whole number");
    value = **n->as_integer();
    check(*n, key, static_cast<double>(value), r);
  }
}

void toml_options::field(std::string_view key, std::string& value) {
  if (const auto* n = find(key))
    value = read_string(*n, key);
}

void toml_options::field(std::string_view key, duration& value, duration min) {
  const auto* n = find(key);
  if (!n)
    return;
  const auto* text = n->as_string();
  const auto read = text ? parse_duration(**text) : std::nullopt;
  if (!read)
    fail(*n, key, R"(must be a duration with its unit, like "50ms" or "1.5s")");
  if (*read < min)
    fail(*n, key,
         min == duration{1}
             ? "must be more than \"0s\""
             : fmt::format("must be at least \"{}\"", print_duration(min)));
  value = *read;
}

void toml_options::field(std::string_view key,
                         std::vector<std::string>& value) {
  if (const auto* n = find(key)) {
    value.clear();
    for (const auto& element : read_list(*n, key, "a list of texts"))
      value.push_back(read_string(element, key));
  }
}

void toml_options::field(std::string_view key, point& value) {
  if (const auto* n = find(key))
    value = read_point(*n, key);
}

void toml_options::field(std::string_view key, std::vector<point>& value) {
  if (const auto* n = find(key)) {
    value.clear();
    for (const auto& element : read_list(*n, key, "a list of points [x, y]"))
      value.push_back(read_point(element, key));
  }
}

void toml_options::table(std::string_view key,
                         const std::function<void(option_visitor&)>& list) {
  toml::table absent;
  auto* n = find(key);
  if (n && !n->is_table() && !n->is_string())
    fail(*n, key, "must be a table");
  toml_options reader{n ? *n : absent, file_, notes_};
  list(reader);
  reader.finish();
}

void toml_options::tables(
    std::string_view key, std::size_t,
    const std::function<void(std::size_t, option_visitor&)>& list) {
  auto* n = find(key);
  if (!n)
    return;
  std::size_t i = 0;
  read_list(*n, key, fmt::format("a list of tables [[{}]]", key));
  for (auto& element : *n->as_array()) {
    if (!element.is_table() && !element.is_string())
      fail(element, key, "must be a list of tables");
    toml_options reader{element, file_, notes_};
    list(i++, reader);
    reader.finish();
  }
}

bool toml_options::has(std::string_view key, bool) {
  return find(key) != nullptr;
}

bool toml_options::word(std::string_view key, std::string_view what,
                        bool says) {
  const auto* n = find(key);
  if (!n)
    return says;
  const auto* text = n->as_string();
  return text && **text == what;
}

bool toml_options::moved(std::string_view from, std::string_view to) {
  auto* table = node_.as_table();
  const auto found =
      table ? move_option(*table, from, to, file_) : std::nullopt;
  if (!found)
    return false;
  notes_.push_back(
      {found->place,
       fmt::format("{} is {} now; {}.", from, to,
                   found->counts ? "the old place still counts"
                                 : "what --set says there counts instead")});
  return found->counts;
}

void toml_options::note(std::string_view key, const std::string& what) {
  const auto* n = find(key);
  notes_.push_back({place_of((n ? *n : node_).source(), file_), what});
}

void toml_options::refuse(std::string_view key, const std::string& why) {
  const auto* n = find(key);
  throw input_error{fmt::format("{}: {}: {}{}",
                                place_of((n ? *n : node_).source(), file_), key,
                                why, why.ends_with('.') ? "" : ".")};
}

void toml_options::finish() const {
  const auto* table = node_.as_table();
  if (!table && std::ranges::find(asked_, "name") == asked_.end())
    fail(node_, "this", "must be a table");
  if (!table)
    return;
  for (const auto& [key, value] : *table) {
    if (std::ranges::find(asked_, key.str()) != asked_.end())
      continue;
    const auto& source = key.source().path ? key.source() : value.source();
    const std::vector<std::string_view> known{asked_.begin(), asked_.end()};
    throw input_error{fmt::format("{}: {}", place_of(source, file_),
                                  unknown_word("option here", key, known))};
  }
}

toml::node* toml_options::find(std::string_view key) {
  if (std::ranges::find(asked_, key) == asked_.end())
    asked_.emplace_back(key);
  if (auto* table = node_.as_table())
    return table->get(key);
  return key == "name" ? &node_ : nullptr;
}

void toml_options::fail(const toml::node& at, std::string_view key,
                        std::string_view why) const {
  throw input_error{fmt::format("{}: {} {}, but is {}.",
                                place_of(at.source(), file_), key, why,
                                describe(at))};
}

void toml_options::check(const toml::node& at, std::string_view key,
                         double value, range r) const {
  if (!(value >= r.min && value <= r.max))
    fail(at, key, fmt::format("must be {}", describe(r)));
}

double toml_options::read_number(const toml::node& n,
                                 std::string_view key) const {
  if (!n.is_number())
    fail(n, key, "must be a number");
  return n.is_integer() ? static_cast<double>(**n.as_integer())
                        : **n.as_floating_point();
}

std::string toml_options::read_string(const toml::node& n,
                                      std::string_view key) const {
  if (!n.is_string())
    fail(n, key, "must be text in quotes");
  return **n.as_string();
}

point toml_options::read_point(const toml::node& n,
                               std::string_view key) const {
  const auto* list = n.as_array();
  if (!list || list->size() != 2)
    fail(n, key, "must be a point [x, y] in m");
  const point p{read_number((*list)[0], key), read_number((*list)[1], key)};
  for (const auto& [i, value] : {std::pair{0, p.x_m}, std::pair{1, p.y_m}})
    check((*list)[i], key, value, {-farthest_m, farthest_m});
  return p;
}

const toml::array& toml_options::read_list(const toml::node& n,
                                           std::string_view key,
                                           std::string_view wanted) const {
  if (!n.is_array())
    fail(n, key, fmt::format("must be {}", wanted));
  return *n.as_array();
}

} // namespace sofof

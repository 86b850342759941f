// Options as a scenario has them, with what they mean beside.
#include "apps/documented.hpp"

#include "scenario/toml_text.hpp"
#include "scenario/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sofof {

namespace {

std::string text_of(settings::range r) {
  constexpr settings::range any;
  if (r.min > any.min && r.max < any.max)
    return fmt::format("{} to {}", r.min, r.max);
  if (r.min > any.min)
    return fmt::format("from {}", r.min);
  return r.max < any.max ? fmt::format("to {}", r.max) : "";
}

/// Notes the options of one table.
class lines final : public settings {
public:
  struct line {
    std::string key, value, range;
  };
  std::vector<line> all;

  void field(std::string_view key, bool& value) override {
    put(key, value ? "true" : "false");
  }
  void field(std::string_view key, double& value, range r) override {
    put(key, number_text(value), text_of(r));
  }
  void field(std::string_view key, std::int64_t& value, range r) override {
    put(key, fmt::format("{}", value), text_of(r));
  }
  void field(std::string_view key, std::string& value) override {
    put(key, quoted_toml(value));
  }
  void field(std::string_view key, duration& value, duration min) override {
    put(key, quoted_toml(print_duration(value)),
        fmt::format("from \"{}\"", print_duration(min)));
  }
  // No policy has any of these.
  void field(std::string_view, std::vector<std::string>&) override {}
  void field(std::string_view, point&) override {}
  void field(std::string_view, std::vector<point>&) override {}
  void table(std::string_view key,
             const std::function<void(settings&)>& list) override {
    lines part;
    list(part);
    const auto name = std::ranges::find(part.all, "name", &line::key);
    if (name != part.all.end())
      put(key, name->value);
  }
  void tables(std::string_view, std::size_t,
              const std::function<void(std::size_t, settings&)>&) override {}
  void refuse(std::string_view, const std::string&) override {}

private:
  void put(std::string_view key, std::string value, std::string range = {}) {
    all.push_back({std::string{key}, std::move(value), std::move(range)});
  }
};

/// @returns "unit, range: meaning", as far as there is each; a time has its
/// unit in its range.
std::string comment_of(const parameter_note& note, const std::string& range) {
  std::string text;
  if (note.unit != "1" && note.unit != "time")
    text = note.unit;
  if (!range.empty())
    text += (text.empty() ? "" : ", ") + range;
  return fmt::format("{}{}{}", text, text.empty() ? "" : ": ", note.meaning);
}

} // namespace

std::string print_documented(std::string_view header,
                             const std::function<void(settings&)>& list,
                             const std::vector<parameter_note>& notes) {
  lines options;
  list(options);
  std::size_t width = 0;
  for (const auto& x : options.all)
    width = std::max(width, x.key.size() + x.value.size());
  auto text = fmt::format("{}\n", header);
  for (const auto& x : options.all) {
    const auto note = std::ranges::find(notes, x.key, &parameter_note::name);
    text += fmt::format("{} = {}", x.key, x.value);
    if (note != notes.end())
      text +=
          fmt::format("{:{}}  # {}", "", width - x.key.size() - x.value.size(),
                      comment_of(*note, x.range));
    text += '\n';
  }
  return text;
}

} // namespace sofof

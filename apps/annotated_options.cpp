// Options as a scenario has them, with what they mean beside.
#include "apps/annotated_options.hpp"

#include "base/options/option_printer.hpp"
#include "base/options/units.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace sofof::apps {

namespace {

std::string text_of(option_visitor::range r) {
  constexpr option_visitor::range any;
  if (r.min > any.min && r.max < any.max)
    return fmt::format("{} to {}", r.min, r.max);
  if (r.min > any.min)
    return fmt::format("from {}", r.min);
  return r.max < any.max ? fmt::format("to {}", r.max) : "";
}

/// Notes the options of one table.
class lines final : public option_visitor {
public:
  struct line {
    std::string key, value, range;
  };
  std::vector<line> all;

  void field(std::string_view key, bool& value) override {
    put(key, "", value);
  }
  void field(std::string_view key, double& value, range r) override {
    put(key, text_of(r), value, r);
  }
  void field(std::string_view key, std::int64_t& value, range r) override {
    put(key, text_of(r), value, r);
  }
  void field(std::string_view key, std::string& value) override {
    put(key, "", value);
  }
  void field(std::string_view key, duration& value, duration min) override {
    put(key, fmt::format("from \"{}\"", print_duration(min)), value, min);
  }
  void field(std::string_view key, std::vector<std::string>& value) override {
    put(key, "", value);
  }
  void field(std::string_view key, point& value) override {
    put(key, "", value);
  }
  void field(std::string_view key, std::vector<point>& value) override {
    put(key, "", value);
  }
  void table(std::string_view key,
             const std::function<void(option_visitor&)>& list) override {
    lines part;
    list(part);
    const auto name = std::ranges::find(part.all, "name", &line::key);
    if (name != part.all.end())
      all.push_back({std::string{key}, name->value, {}});
  }
  void
  tables(std::string_view, std::size_t,
         const std::function<void(std::size_t, option_visitor&)>&) override {}
  void refuse(std::string_view, const std::string&) override {}

private:
  // The value as a file has it.
  template <class... Value>
  void put(std::string_view key, std::string range, Value&... value) {
    auto text =
        print_options([&](option_visitor& s) { s.field(key, value...); });
    text.erase(0, key.size() + std::string_view{" = "}.size());
    text.pop_back(); // the end of the line
    all.push_back({std::string{key}, std::move(text), std::move(range)});
  }
};

/// @returns "unit, range: meaning", as far as there is each; a time has its
/// unit in its range.
std::string comment_of(const policies::option_info& note,
                       const std::string& range) {
  std::string text;
  if (note.unit != "1" && note.unit != "time")
    text = note.unit;
  if (!range.empty())
    text += (text.empty() ? "" : ", ") + range;
  return fmt::format("{}{}{}", text, text.empty() ? "" : ": ", note.meaning);
}

} // namespace

std::string print_documented(std::string_view header,
                             const std::function<void(option_visitor&)>& list,
                             const std::vector<policies::option_info>& notes) {
  lines options;
  list(options);
  std::size_t width = 0;
  for (const auto& x : options.all)
    width = std::max(width, x.key.size() + x.value.size());
  auto text = fmt::format("{}\n", header);
  for (const auto& x : options.all) {
    const auto note =
        std::ranges::find(notes, x.key, &policies::option_info::name);
    text += fmt::format("{} = {}", x.key, x.value);
    if (note != notes.end())
      text +=
          fmt::format("{:{}}  # {}", "", width - x.key.size() - x.value.size(),
                      comment_of(*note, x.range));
    text += '\n';
  }
  return text;
}

} // namespace sofof::apps

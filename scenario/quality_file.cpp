// What vehicles learned of places, as a file.
#include "scenario/quality_file.hpp"

#include "base/options/spelling.hpp"
#include "base/text/csv.hpp"
#include "base/text/csv_reader.hpp"

#include <algorithm>
#include <array>
#include <iterator>

namespace sofof::scenario {

namespace {

/// A cell, and the name of its provider.
struct quality_row {
  std::string_view provider;
  const policies::quality_map::entry& of;
};

constexpr int quality_places = 6;

decimal quality_number(double x) {
  return rounded(x, quality_places);
}

constexpr std::array<csv_column<quality_row>, 7> quality_columns{{
    {"provider", [](const quality_row& x) { return x.provider; }},
    {"service",
     [](const quality_row& x) { return std::string_view{x.of.service}; }},
    {"x_m", [](const quality_row& x) { return quality_number(x.of.at.x_m); }},
    {"y_m", [](const quality_row& x) { return quality_number(x.of.at.y_m); }},
    {"visits",
     [](const quality_row& x) { return quality_number(x.of.known.visits); }},
    {"late",
     [](const quality_row& x) { return quality_number(x.of.known.late); }},
    {"latency_s",
     [](const quality_row& x) { return quality_number(x.of.known.latency_s); }},
}};

} // namespace

std::vector<known_place> read_quality(const std::filesystem::path& file,
                                      const scenario_definition& s) {
  static constexpr std::array<std::string_view, 7> names{
      "provider", "service", "x_m", "y_m", "visits", "late", "latency_s"};
  enum { provider, service, x, y, visits, late, latency };
  std::vector<std::string_view> providers, services;
  for (const auto& p : s.providers)
    providers.push_back(p.name);
  for (const auto& type : s.services)
    services.push_back(type->name());
  csv_reader row{file, names};
  const auto known = [&row](std::size_t column, std::string_view what,
                            const std::vector<std::string_view>& all) {
    const auto i = std::ranges::find(all, row.text(column));
    if (i == all.end())
      row.refuse(column, unknown_word(what, row.text(column), all));
    return static_cast<std::uint32_t>(i - all.begin());
  };
  const auto number = [&row](std::size_t column) {
    const auto value = row.number(column);
    if (value < 0)
      row.refuse(column, "must not be negative");
    return value;
  };
  std::vector<known_place> all;
  while (row.next()) {
    known(service, "service of the scenario", services);
    all.push_back({known(provider, "provider of the scenario", providers),
                   row.text(service),
                   {row.number(x), row.number(y)},
                   {number(visits), number(late), number(latency)}});
    if (all.back().known.late > all.back().known.visits)
      row.refuse(late, "must not be more than visits");
  }
  return all;
}

std::string quality_csv(const policies::quality_map& learned,
                        const scenario_definition& s) {
  std::string text;
  append_names<quality_row>(text, quality_columns);
  text += '\n';
  for (const auto& x : learned.entries()) {
    const auto place = place_of(x.provider).value();
    if (place == 0 || place > s.providers.size())
      continue;
    append_fields<quality_row>(text, quality_columns,
                               {s.providers[place - 1].name, x});
    text += '\n';
  }
  return text;
}

} // namespace sofof::scenario

// energy.csv: a line for each service of each vehicle in each split.
#include "base/text/csv.hpp"
#include "recording/energy_table.hpp"

#include <string_view>

namespace sofof::recording {

namespace {

constexpr int csv_places_of_nj = 9;
constexpr int csv_places_of_way = 3;

struct energy_line {
  const energy_row& x;
  const std::string& chain;
  const std::string& where;
};

constexpr decimal exact_joules(std::int64_t nj) {
  return {nj, csv_places_of_nj};
}

std::string_view place_name(const std::string& place) {
  return place.empty() ? std::string_view{"vehicle"} : place;
}

constexpr csv_column<energy_line> of_energy[]{
    {"station",
     [](const auto& r) {
       return r.x.station ? decimal{std::int64_t{r.x.station->value()}}
                          : decimal{};
     }},
    {"chain", [](const auto& r) { return std::string_view{r.chain}; }},
    {"split", [](const auto& r) { return std::string_view{r.where}; }},
    {"service", [](const auto& r) { return std::string_view{r.x.service}; }},
    {"place", [](const auto& r) { return place_name(r.x.place); }},
    {"driven_s", [](const auto& r) { return seconds(r.x.driven); }},
    {"distance_m",
     [](const auto& r) { return rounded(r.x.distance_m, csv_places_of_way); }},
    {"own_results", [](const auto& r) { return r.x.use.computed; }},
    {"computing_s", [](const auto& r) { return seconds(r.x.use.computing); }},
    {"resting_s",
     [](const auto& r) { return rounded(r.x.resting_s, csv_places_of_nj); }},
    {"octets_up", [](const auto& r) { return r.x.use.octets_up; }},
    {"octets_down", [](const auto& r) { return r.x.use.octets_down; }},
    {"results", [](const auto& r) { return r.x.use.results; }},
    {"served_s", [](const auto& r) { return seconds(r.x.served()); }},
    {"computing_j",
     [](const auto& r) { return exact_joules(r.x.spent.computing_nj); }},
    {"resting_j",
     [](const auto& r) { return exact_joules(r.x.spent.resting_nj); }},
    {"framework_j",
     [](const auto& r) { return exact_joules(r.x.spent.framework_nj); }},
    {"sending_j",
     [](const auto& r) { return exact_joules(r.x.spent.sending_nj); }},
    {"receiving_j",
     [](const auto& r) { return exact_joules(r.x.spent.receiving_nj); }},
    {"server_busy_j",
     [](const auto& r) { return exact_joules(r.x.spent.server_busy_nj); }},
    {"server_idle_j",
     [](const auto& r) { return exact_joules(r.x.spent.server_idle_nj); }},
    {"home_j", [](const auto& r) { return exact_joules(r.x.home_nj); }},
};

} // namespace

std::string name_of(const split& where) {
  std::string name;
  for (const auto& place : where) {
    if (!name.empty())
      name += '>';
    name += place_name(place);
  }
  return name;
}

std::string to_csv(const energy_table& table, const energy_terms& terms) {
  std::string text;
  append_names<energy_line>(text, of_energy);
  text += '\n';
  for (const auto& row : table.rows) {
    const auto where = name_of(row.where);
    append_fields<energy_line>(text, of_energy,
                               {row, terms.chains[row.chain].back(), where});
    text += '\n';
  }
  return text;
}

} // namespace sofof::recording

// How often results were late where: a map of square cells.
#pragma once

#include "base/geometry.hpp"
#include "base/ids.hpp"

#include <compare>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace sofof::policies {

/// A cell of the plane, by its place from west to east and south to north.
struct map_cell {
  std::int64_t column = 0;
  std::int64_t row = 0;

  friend auto operator<=>(const map_cell&, const map_cell&) = default;
};

/// What is known of one cell. A visit is one trial, however many results came:
/// the first one that is late ends the session, so that late results would be
/// too few among all that come.
struct cell_quality {
  double visits = 0;    ///< ≥ 0, with fading weights.
  double late = 0;      ///< Of them, in [0, visits]: those with a late result.
  double latency_s = 0; ///< Mean of results that came, ≥ 0; 0: none did.

  friend bool operator==(const cell_quality&, const cell_quality&) = default;
};

struct quality_map_options {
  double cell_m = 10; ///< Edge of a cell, m, > 0.
  /// What is thought of a place where nobody was: as of so many visits,
  double prior_visits = 2;
  double prior_late = 0.02; ///< with this share of late ones, in [0, 1].
  /// So many visits are remembered, > 0: of more, the former count for less.
  double memory = 20;
};

/// Learns, for each service and provider, at which places results are late. The
/// share of visits with a late result has a beta distribution as its prior, and
/// what is told is its mean. Any thread may call it: vehicles may share it.
class quality_map {
public:
  /// What was learned of one cell.
  struct entry {
    std::string service;
    provider_id provider = 0;
    point at; ///< Its middle, m.
    cell_quality known;
  };

  explicit quality_map(const quality_map_options& options = {});

  map_cell cell_of(point at) const;

  /// @param known      Of how many visits, of how many with a late result, and
  ///                   their mean latency; 0 for one that nothing is known of.
  void add(std::string_view service, provider_id provider, map_cell cell,
           const cell_quality& known);

  /// @returns P(a result is late during a visit to the cell), in [0, 1].
  double late(std::string_view service, provider_id provider,
              map_cell cell) const;

  /// @returns what was learned there; nothing but zeros where nobody was.
  cell_quality at(std::string_view service, provider_id provider,
                  map_cell cell) const;

  /// @returns all that was learned: by service and provider, cells in order.
  std::vector<entry> entries() const;

  /// Takes up all that another map has learned, as if it had been here.
  void add(const quality_map& other);

  double cell_m() const { return options_.cell_m; }

private:
  using key = std::pair<std::string, provider_id>;

  quality_map_options options_;
  mutable std::mutex mutex_;
  std::map<key, std::map<map_cell, cell_quality>> cells_;
};

} // namespace sofof::policies

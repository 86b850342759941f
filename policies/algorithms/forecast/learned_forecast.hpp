// A forecast of quality by place, of what vehicles have seen there.
#pragma once

#include "policies/algorithms/forecast/quality_map.hpp"
#include "policies/api/quality_forecast.hpp"

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace sofof::policies {

/// Of one vehicle: makes visits to cells of what its results were like, and
/// notes them in a map, of its own or of many. A visit with a late result is
/// noted at once, any other one when the vehicle leaves the cell. What offers
/// alone tell of a visit counts for a fifth. A provider that has started again
/// is the same.
class learned_forecast final : public quality_forecast {
public:
  /// @param map  Not null.
  /// @param learns  Else it goes by what the map has.
  explicit learned_forecast(std::shared_ptr<quality_map> map,
                            bool learns = true);

  expected_quality look(provider_id provider, std::string_view service,
                        point at) const override;
  void learn(const seen_quality& seen) override;

private:
  struct visit {
    map_cell cell;
    double came = 0;          ///< Results and offers,
    double latency_s = 0;     ///< with this mean latency.
    bool has_results = false; ///< Not only offers.
    double noted_late = 0;    ///< So much of it, in [0, 1].
  };

  void leave(const std::string& service, provider_id provider, const visit& x);

  std::shared_ptr<quality_map> map_;
  bool learns_;
  std::map<std::pair<std::string, provider_id>, visit> visits_;
};

} // namespace sofof::policies

// Ranks of a junction's lanes from who yields to whom.
#include "maps/sumo_ranks.hpp"

#include <fmt/format.h>

#include "maps/split_words.hpp"
#include <algorithm>
#include <string_view>

namespace sofof::maps {

namespace {

constexpr auto worst_rank = 100;

/// The rows of one junction.
class yielding {
public:
  explicit yielding(std::vector<std::string_view> responses)
      : responses_{std::move(responses)}, ranks_(responses_.size(), unknown) {}

  /// Depth first without recursion: nobody knows how long a row is.
  int rank_of(std::size_t lane) {
    struct place {
      std::size_t lane, next = 0;
      int deepest = 0;
    };
    std::vector<place> trail{{lane}};
    while (!trail.empty()) {
      auto& here = trail.back();
      if (ranks_[here.lane] < 0)
        ranks_[here.lane] = on_trail;
      const auto row = responses_[here.lane];
      if (here.next == row.size() || ranks_[here.lane] >= 0) {
        auto& rank = ranks_[here.lane];
        rank = std::max(rank, std::min(here.deepest, worst_rank));
        const auto found = rank;
        trail.pop_back();
        if (!trail.empty())
          trail.back().deepest = std::max(trail.back().deepest, found + 1);
        continue;
      }
      const auto other = here.next++;
      if (row[row.size() - 1 - other] == '1' && other < ranks_.size()
          && ranks_[other] != on_trail)
        trail.push_back({other});
    }
    return ranks_[lane];
  }

private:
  static constexpr auto unknown = -1, on_trail = -2;
  std::vector<std::string_view> responses_;
  std::vector<int> ranks_;
};

} // namespace

void rank_lanes(const xml_file& net, std::vector<source_lane>& lanes,
                const lane_numbers& index) {
  for (const auto junction : net.root().children("junction")) {
    const auto inside = split_words(junction.attribute("intLanes").value());
    std::vector<std::string_view> responses(inside.size());
    for (const auto request : junction.children("request")) {
      const auto row = net.number(request, "index", 0, 1e6);
      const auto i = static_cast<std::size_t>(row);
      if (i >= responses.size())
        net.refuse(request, fmt::format("the junction has no lane {}.", i));
      responses[i] = net.text(request, "response");
    }
    yielding all{std::move(responses)};
    for (std::size_t i = 0; i < inside.size(); ++i)
      if (const auto lane = index.find(std::string{inside[i]});
          lane != index.end())
        lanes[lane->second].rank = all.rank_of(i);
  }
}

} // namespace sofof::maps

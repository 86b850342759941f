// Drives scenes and prints what they showed, for tests/acceptance/chain/rule.
//
//   scenes FIRST COUNT [POLICY] [slow] [chain] [plain] [text]
//
// POLICY: rss, location or never. A line for each scene of which something is
// to be told, and one of sums: NAME=VALUE ...
#include "scenario/init_messages.hpp"
#include "tests/support/safe_scenes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstdlib>
#include <string_view>
#include <vector>

using namespace sofof::test;

int main(int count, char** words) {
  const std::vector<std::string_view> said(words + 1, words + count);
  if (said.size() < 2)
    return 2;
  const auto says = [&](std::string_view word) {
    return std::ranges::find(said, word) != said.end();
  };
  scene_policy how{.is_slow = says("slow"),
                   .is_plain = says("plain"),
                   .is_chain = says("chain")};
  for (const auto* lodm : {"location", "never"})
    if (says(lodm))
      how.lodm = lodm;
  const auto first = std::strtoull(words[1], nullptr, 10);
  const auto scenes = std::strtoull(words[2], nullptr, 10);
  sofof::scenario::init_messages();
  scene_findings sum;
  for (auto seed = first; seed < first + scenes; ++seed) {
    if (says("text"))
      fmt::print("{}\n", scene_text(seed, how));
    const auto x = drive_scene(seed, how);
    sum.add(x);
    if (x.collisions > 0 || !x.first.empty())
      fmt::print("scene {}, {}: {} collisions; {}\n", seed,
                 name_of(kind_of(seed)), x.collisions, x.first);
  }
  fmt::print(
      "scenes={} passed_over={} collisions={} changes={} driven_s={:.1f} "
      "remote_s={:.1f} less_s={:.2f} less={} entered={} others={} late={} "
      "latest_s={:.3f} home_late={}\n",
      sum.scenes, sum.passed_over, sum.collisions, sum.changes, sum.driven_s,
      sum.remote_s, sum.less_s, sum.less, sum.entered, sum.others, sum.late,
      sum.latest_s, sum.home_late);
  return 0;
}

// Sharing runs out by their costs.
#include "experiments/sweep/shard.hpp"

#include <algorithm>
#include <cassert>
#include <charconv>
#include <functional>
#include <queue>
#include <system_error>
#include <utility>

namespace sofof::experiments {

namespace {

/// Behind a number that counts from 0.
constexpr std::string_view from_zero = "+1";

} // namespace

std::optional<shard> parse_shard(std::string_view text) {
  shard which{0, 0};
  const auto* end = text.data() + text.size();
  const auto first = std::from_chars(text.data(), end, which.number);
  const auto* slash = first.ptr;
  if (first.ec == std::errc{} && which.number < most_shards
      && std::string_view{slash, end}.starts_with(from_zero)) {
    ++which.number;
    slash += from_zero.size();
  }
  if (slash == end || *slash != '/')
    return std::nullopt;
  const auto rest = std::from_chars(slash + 1, end, which.of);
  if (rest.ec != std::errc{} || rest.ptr != end || which.number < 1
      || which.number > which.of || which.of > most_shards)
    return std::nullopt;
  return which;
}

std::vector<std::size_t> share_out(std::span<const wanted_run> runs,
                                   std::size_t shards) {
  assert(shards >= 1);
  double measured = 0;
  std::vector<std::size_t> others;
  std::vector<std::size_t> shard_of(runs.size(), measuring_shard);
  for (std::size_t i = 0; i < runs.size(); ++i)
    if (runs[i].is_measured)
      measured += runs[i].cost;
    else
      others.push_back(i);
  std::ranges::stable_sort(others, std::ranges::greater{},
                           [runs](std::size_t i) { return runs[i].cost; });

  using load = std::pair<double, std::size_t>; // what a shard has, its number
  std::priority_queue<load, std::vector<load>, std::greater<>> least;
  for (std::size_t number = 1; number <= shards; ++number)
    least.emplace(number == measuring_shard ? measured : 0, number);
  for (const auto i : others) {
    const auto [cost, number] = least.top();
    least.pop();
    shard_of[i] = number;
    least.emplace(cost + runs[i].cost, number);
  }
  return shard_of;
}

} // namespace sofof::experiments

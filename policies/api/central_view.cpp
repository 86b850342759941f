// How a provider that decides about many at once sees them.
#include "policies/api/central_view.hpp"

#include "base/protocol.hpp"

#include <algorithm>
#include <cassert>

namespace sofof::policies {

namespace {

constexpr double little = 0.05;
constexpr std::size_t most_others = 16;

} // namespace

double computing_s(double utilisation, const periodic_task& task,
                   std::size_t workers) {
  return utilisation * to_seconds(task.period) * static_cast<double>(workers);
}

std::optional<double> told_gain(std::span<const candidate> told,
                                provider_id provider) {
  const auto i = std::ranges::find(told, provider, &candidate::provider);
  if (i == told.end())
    return std::nullopt;
  return std::clamp(i->gain, -greatest_gain, greatest_gain);
}

double local_gain(std::span<const candidate> told, provider_id self,
                  double utilisation, double price) {
  assert(utilisation >= 0 && price >= 0);
  const auto least = price + little / (1 + utilisation);
  return std::max(told_gain(told, self).value_or(least), least);
}

std::vector<other_provider> others_told(const central_context& context) {
  std::vector<other_provider> all;
  for (const auto& request : context.requests)
    for (const auto& c : request.candidates) {
      if (c.provider == 0 || c.provider == context.self)
        continue;
      const auto utilisation = std::clamp(c.utilisation, 0.0, 1.0);
      const auto known =
          std::ranges::find(all, c.provider, &other_provider::id);
      if (known != all.end())
        known->utilisation = std::max(known->utilisation, utilisation);
      else if (all.size() < most_others)
        all.push_back({c.provider, utilisation});
    }
  return all;
}

} // namespace sofof::policies

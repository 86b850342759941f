// Simple ways to choose among providers that come into question.
#include "policies/choices.hpp"

#include <algorithm>

namespace sofof {

namespace {

constexpr local_decision nobody{0, "nobody comes into question"};

/// Draws of one decision.
enum lane : std::uint32_t { whether, first, second };

/// @param count  At least 1.
/// @returns a number below it; the same for the same draw.
std::size_t drawn(const local_context& context, lane draw, std::size_t count) {
  const auto place =
      context.noise.uniform(context.number, draw) * static_cast<double>(count);
  return std::min(static_cast<std::size_t>(place), count - 1);
}

} // namespace

local_decision random_choice::decide(const local_context& context) {
  if (context.providers.empty())
    return nobody;
  if (context.noise.uniform(context.number, whether) > probability_)
    return {0, "drawn: no"};
  const auto& all = context.providers;
  return {all[drawn(context, first, all.size())].id, "drawn: yes"};
}

void random_choice::fields(settings& s) {
  s.field("probability", probability_, {0, 1});
}

std::unique_ptr<local_policy> random_choice::clone() const {
  return std::make_unique<random_choice>(*this);
}

local_decision nearest_choice::decide(const local_context& context) {
  if (context.providers.empty() || context.path.empty())
    return nobody;
  const auto here = context.path.front();
  const auto nearest =
      std::ranges::min_element(context.providers, {}, [here](const auto& p) {
        return distance_m(p.at, here);
      });
  return {nearest->id, "the nearest"};
}

std::unique_ptr<local_policy> nearest_choice::clone() const {
  return std::make_unique<nearest_choice>(*this);
}

local_decision least_loaded_choice::decide(const local_context& context) {
  const auto& all = context.providers;
  if (all.empty())
    return nobody;
  const auto one = drawn(context, first, all.size());
  auto best = one;
  if (all.size() > 1) {
    const auto step = 1 + drawn(context, second, all.size() - 1);
    const auto other = (one + step) % all.size();
    if (all[other].utilisation < all[one].utilisation)
      best = other;
  }
  if (!(all[best].utilisation < most_)) // nor what is no number
    return {0, "no room"};
  return {all[best].id, "the least loaded of two"};
}

void least_loaded_choice::fields(settings& s) {
  s.field("most", most_, {0, 1e3});
}

std::unique_ptr<local_policy> least_loaded_choice::clone() const {
  return std::make_unique<least_loaded_choice>(*this);
}

} // namespace sofof

// Results are followed back a second later, when all that they may depend on
// has come down, too.
#include "recording/response_ledger.hpp"

#include <algorithm>
#include <cassert>
#include <chrono>
#include <iterator>

namespace sofof::recording {

namespace {

using namespace std::chrono_literals;

constexpr duration all_known_after = 1s;
constexpr duration kept_for = 5s;

using got_results = std::deque<messages::stage_record>;

const messages::stage_record* got_at(const got_results& all, time_point t) {
  const auto i = std::ranges::find(all, t, &messages::stage_record::got);
  return i == all.end() ? nullptr : &*i;
}

/// @returns the provider's newest cycle that had begun by then.
const messages::stage_record* newest_of(const got_results& all,
                                        provider_id provider, time_point t) {
  const messages::stage_record* newest = nullptr;
  for (const auto& x : all)
    if (x.provider == provider && x.begun() <= t
        && (!newest || newest->begun() < x.begun()))
      newest = &x;
  return newest;
}

void forget_before(time_point t, got_results& all) {
  while (!all.empty() && all.front().got < t)
    all.pop_front();
}

} // namespace

response_ledger::response_ledger(const std::vector<std::string>& chain) {
  for (const auto& name : chain)
    chain_.emplace_back(name);
}

void response_ledger::add(const messages::stage_record& x,
                          std::vector<messages::response_record>& out) {
  const auto place = std::ranges::find(chain_, x.service);
  if (place == chain_.end())
    return;
  auto& car = cars_[x.station];
  for (const auto& look : x.looks) {
    car.looks.push_back(look);
    while (car.looks.front().sensed_at < look.sensed_at - messages::look_lasts)
      car.looks.pop_front();
  }
  car.results.resize(chain_.size());
  car.results[static_cast<std::size_t>(place - chain_.begin())].push_back(x);
  follow_until(x.got - all_known_after, x.station, car, out);
  const auto old = x.got - kept_for;
  for (std::size_t k = 0; k + 1 < chain_.size(); ++k)
    forget_before(old, car.results[k]);
}

void response_ledger::finish(std::vector<messages::response_record>& out) {
  for (auto& [station, car] : cars_)
    if (!car.results.empty())
      follow_until(time_point::max(), station, car, out);
}

void response_ledger::follow_until(
    time_point t, station_id station, car& x,
    std::vector<messages::response_record>& out) const {
  auto& plans = x.results.back();
  while (!plans.empty() && plans.front().got <= t) {
    if (const auto found = back_from(x, plans.front());
        found.look && (!x.answered || found.look->sensed_at > *x.answered))
      answer(station, x, found, out);
    plans.pop_front();
  }
}

response_ledger::way
response_ledger::back_from(const car& x, const messages::stage_record& plan) {
  way found;
  const auto* at = &plan;
  for (auto k = x.results.size() - 1; at; --k) {
    auto& last = found.steps.emplace_back(step{k, at});
    if (k == 0) {
      const auto look = std::ranges::find(x.looks, at->timing.input_at,
                                          &messages::sensor_look::input_at);
      found.look = look == x.looks.end() ? nullptr : &*look;
      break;
    }
    const auto here = at->provider;
    const auto* before = got_at(x.results[k - 1], at->timing.input_at);
    if (before && here != 0 && before->provider == here) {
      last.asks_there = true;
      // The first of those that run one after the other there.
      while (k > 1) {
        const auto* earlier = got_at(x.results[k - 2], before->timing.input_at);
        if (!earlier || earlier->provider != here)
          break;
        before = earlier;
        --k;
      }
      before = newest_of(x.results[k - 1], here, at->begun());
    }
    at = before;
  }
  return found;
}

void response_ledger::answer(
    station_id station, car& x, const way& found,
    std::vector<messages::response_record>& out) const {
  const auto& plan = *found.steps.front().result;
  assert(plan.control_at);
  messages::response_record response{.station = station,
                                     .control_at = *plan.control_at,
                                     .parts = {},
                                     .control = *plan.control_at - plan.got};
  auto since = found.look->sensed_at;
  for (auto i = found.steps.rbegin(); i != found.steps.rend(); ++i) {
    const auto& result = *i->result;
    const auto& [input_at, up, queue, computing, down] = result.timing;
    // Those between, which were passed over, ran there, too.
    while (response.parts.size() <= i->service)
      response.parts.push_back(
          {chain_[response.parts.size()], result.provider});
    auto& part = response.parts.back();
    if (!i->asks_there)
      part.up = up.wait + up.travel;
    const auto next = std::next(i);
    if (next != found.steps.rend() && next->asks_there)
      continue;
    part.down = down.wait + down.travel;
    part.took = result.got - since;
    since = result.got;
  }
  const auto newest = found.look->sensed_at;
  for (const auto& look : x.looks)
    if (look.sensed_at <= newest
        && (!x.answered || look.sensed_at > *x.answered)) {
      response.sensed_at = look.sensed_at;
      response.waited = newest - look.sensed_at;
      out.push_back(response);
    }
  x.answered = newest;
  while (!x.looks.empty() && x.looks.front().sensed_at <= newest)
    x.looks.pop_front();
}

} // namespace sofof::recording

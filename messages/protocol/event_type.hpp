// What kinds of events there are, and how each is called in events.jsonl.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <string_view>

namespace sofof::messages {

/// When each happens: docs/results.md.
enum class event_type : std::uint8_t {
  offer,
  stay_local,
  request,
  accepted,
  refused,
  switched, ///< The source of a service has changed.
  joined,
  left,
  plan_switch,
  implausible,
  result_refused, ///< It has come, but too late, or from too old an input.
  violation,
  clock_in_doubt,
  clock_known,
  provider_connected,
  provider_lost,
  peer_connected,
  peer_lost,
  peer_refused,
  peer_ignored,
  peer_disconnected,
  registry_answered, ///< As it should, and something has changed.
  registry_failed,
  doubted,
  believed,
  requester_lost,
  program_lost, ///< One that serves as a function.
  program_back,
  appeared,
  arrived,
  collision,
  near_miss,
};

struct event_name {
  event_type what{};
  std::string_view name;
};

/// All of them, in their order.
inline constexpr event_name event_names[]{
    {event_type::offer, "offer"},
    {event_type::stay_local, "stay_local"},
    {event_type::request, "request"},
    {event_type::accepted, "accepted"},
    {event_type::refused, "refused"},
    {event_type::switched, "switch"},
    {event_type::joined, "joined"},
    {event_type::left, "left"},
    {event_type::plan_switch, "plan_switch"},
    {event_type::implausible, "implausible"},
    {event_type::result_refused, "result_refused"},
    {event_type::violation, "violation"},
    {event_type::clock_in_doubt, "clock_in_doubt"},
    {event_type::clock_known, "clock_known"},
    {event_type::provider_connected, "provider_connected"},
    {event_type::provider_lost, "provider_lost"},
    {event_type::peer_connected, "peer_connected"},
    {event_type::peer_lost, "peer_lost"},
    {event_type::peer_refused, "peer_refused"},
    {event_type::peer_ignored, "peer_ignored"},
    {event_type::peer_disconnected, "peer_disconnected"},
    {event_type::registry_answered, "registry_answered"},
    {event_type::registry_failed, "registry_failed"},
    {event_type::doubted, "doubted"},
    {event_type::believed, "believed"},
    {event_type::requester_lost, "requester_lost"},
    {event_type::program_lost, "program_lost"},
    {event_type::program_back, "program_back"},
    {event_type::appeared, "appeared"},
    {event_type::arrived, "arrived"},
    {event_type::collision, "collision"},
    {event_type::near_miss, "near_miss"},
};
static_assert(std::ranges::all_of(event_names, [](const event_name& x) {
  return &x == &event_names[static_cast<std::size_t>(x.what)];
}));

static_assert(std::size(event_names)
                  == static_cast<std::size_t>(event_type::near_miss) + 1,
              "the last of them has the last name");

/// @returns its name in files.
constexpr std::string_view name_of(event_type what) {
  assert(static_cast<std::size_t>(what) < std::size(event_names));
  return event_names[static_cast<std::size_t>(what)].name;
}

} // namespace sofof::messages

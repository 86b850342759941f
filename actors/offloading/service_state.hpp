// One kind of service in a vehicle: who runs it elsewhere, and who may.
#pragma once

#include "actors/offloading/service_type.hpp"
#include "messages/type_ids.hpp"
#include "offloading/distrust.hpp"
#include "offloading/standby.hpp"
#include "policies/algorithms/forecast/link_estimator.hpp"
#include "policies/api/context.hpp"
#include "world/vehicle/cycle_cost.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <string_view>
#include <vector>

namespace sofof {

/// A provider that a station has heard of.
struct known_provider {
  provider_actor handle;
  std::optional<std::uint32_t> open_request;
  std::optional<time_point>
      last_complaint;  ///< About results of unknown running services.
  service_offer offer; ///< The latest, without what was asked for since.
  time_point offered_at;
  distrust doubted; ///< Since its results were implausible.

  bool offers(std::string_view kind) const;
};

using known_providers = std::map<provider_id, known_provider>;

enum class phase { requested, starting, remote };

/// A provider that runs a service, or is asked to.
struct requester_session {
  provider_id provider = 0;
  phase at = phase::requested;
  session_id running; ///< From acceptance on.
  time_point accepted;
  time_point first_data;
  bool joined = false; ///< One that ran already.
};

/// What the requester remembers of one kind of service.
struct service_state {
  service_type_ptr kind;
  requester_manager_actor manager;
  cycle_cost on_board;
  cycle_cost offloaded; ///< Time: of the way there alone.
  std::vector<requester_session>
      elsewhere{};                   ///< The oldest first; empty: it is local.
  std::vector<provider_id> wanted{}; ///< Who shall run it.
  std::optional<offloading::standby> standby{}; ///< One of them, if any.
  time_point since;                             ///< It has been where it is.
  std::map<provider_id, time_point> cool_until{};
  std::map<provider_id, link_estimator> links{}; ///< By what came from there.

  /// @returns null for a provider that neither runs it nor is asked to.
  requester_session* find(provider_id provider);
  void drop(provider_id provider);

  bool wants(provider_id provider) const;
  /// Whether that one is called only when others do not answer.
  bool is_standby(provider_id provider) const;
  bool is_moving() const; ///< Whether an answer or first data is awaited.
  bool is_remote() const;
  /// @returns the provider that has run it for longest, of those that are not
  /// on call; 0: it is local.
  provider_id current() const;

  service_needs needs() const;
  /// @returns how long a provider computes a result of it.
  duration computing(const service_offer& offer) const;
  link_estimator& link_of(provider_id provider);
  /// Whether its offer holds, and nothing speaks against asking.
  bool may_ask(const known_provider& provider, time_point now) const;
  provider_view view_of(const known_provider& provider, time_point now);
  /// @param offering  Who offers it just now; 0: nobody.
  /// @returns first where it runs, then who may be asked for it: who offers
  /// just now, then by id.
  std::vector<provider_view> views(const known_providers& providers,
                                   provider_id offering, time_point now);
  /// @returns what the vehicle tells of whom it could ask: not where the
  /// service runs, which it would not leave for nothing. Of more than
  /// protocol::most_candidates the nearest; by id.
  /// @param from  Where the vehicle is, m, east-north.
  std::vector<candidate> candidates(const known_providers& providers,
                                    point from, time_point now);
};

/// @returns whether a service that ends so comes home unplanned.
bool is_fallback(end_reason reason);

} // namespace sofof

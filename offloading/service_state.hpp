// One service of a vehicle: at which providers it runs, and at which it may.
#pragma once

#include "offloading/distrust.hpp"
#include "offloading/peer.hpp"
#include "offloading/service.hpp"
#include "offloading/standby.hpp"
#include "policies/algorithms/forecast/link_estimator.hpp"
#include "policies/api/context.hpp"

#include <cstdint>
#include <map>
#include <optional>
#include <vector>

namespace sofof::offloading {

/// A provider that a vehicle has had an offer of.
struct known_provider {
  peer_id peer{};
  std::optional<std::uint32_t> open_request{};
  /// Of a session that it has accepted; the next one's is above.
  std::uint32_t last_counter = 0;
  /// About results of unknown sessions.
  std::optional<time_point> last_complaint{};
  /// Of a digest, by which sessions were ended there that only it has.
  std::optional<time_point> last_correction{};
  /// The latest, without what was asked for since.
  messages::service_offer offer{};
  time_point offered_at{};
  distrust doubted{}; ///< Since its results were implausible.
  /// How long offers were on their way.
  policies::time_law way{};

  bool offers(const messages::service_name& service) const;
  /// @returns where it is: of one that moves, where it has come since its
  /// offer, at most for as long as that holds; m, east-north.
  point position(time_point now) const;
};

using known_providers = std::map<provider_id, known_provider>;

enum class phase {
  requested, ///< The provider has not answered yet.
  starting,  ///< It has accepted; its first result has not come yet.
  remote,    ///< Its results have come.
};

/// A provider that runs a service, or is asked to.
struct requester_session {
  provider_id provider = 0;
  phase at = phase::requested;
  messages::session_id session{}; ///< From acceptance on.
  time_point accepted{};
  time_point first_data{};
  time_point confirmed{}; ///< By the latest acceptance, result or digest.
  /// Since when no digest has named it that could have.
  std::optional<time_point> unnamed_since{};
  bool joined = false; ///< Another provider ran the service already.
};

/// What the requester remembers of one service.
struct service_state {
  onboard_service service;
  policies::service_needs needs; ///< Each > 0; of this service alone.
  duration own_response{};       ///< While the vehicle computes it.
  world::cycle_cost on_board{};  ///< Of a cycle in the vehicle.
  world::cycle_cost offloaded{}; ///< Time: of the way there alone.
  time_point since{};            ///< It has been where it is.
  /// What the service last found of the vehicle's scene.
  struct scene_look {
    time_point at;
    duration safe_response{};
  };
  std::optional<scene_look> scene{};
  /// The oldest first; empty: it is local.
  std::vector<requester_session> sessions{};
  std::vector<provider_id> wanted{}; ///< Which providers shall run it.
  bool is_leaving = false;           ///< A request of it is about to be sent.
  std::optional<messages::standby> standing_by{}; ///< One of them, if any.
  std::map<provider_id, time_point> cool_until{};
  /// By what came from there.
  std::map<provider_id, policies::link_estimator> links{};
  /// What its results took; of a provider by its results alone.
  policies::service_times times{};
  /// When the latest input was made that has had a result.
  time_point answered_input{};

  /// @param computer  The vehicle's.
  service_state(onboard_service what, const world::computer_options& computer,
                time_point now);

  /// @returns null for a provider that neither runs it nor is asked to.
  requester_session* find(provider_id provider);
  const requester_session* find(provider_id provider) const;
  void drop(provider_id provider);

  bool wants(provider_id provider) const;
  /// Whether that one is fed only when others do not answer.
  bool is_standby(provider_id provider) const;
  bool is_moving() const; ///< Whether an answer or first data is awaited.
  bool is_remote() const;
  /// Whether no provider runs it twice, those that have accepted have a session
  /// of it, only those that run it have joined another, one of them does not
  /// stand by, if there are any, and whoever stands by is wanted; it always is.
  bool is_consistent() const;
  /// @returns the provider that has run it for longest, of those that do not
  /// stand by; nullopt: it is local.
  std::optional<provider_id> current() const;

  /// @returns under which response time the scene is safe; none, 0, if inputs
  /// have stopped coming since the service last looked; nullopt: it never has.
  std::optional<duration> safe_response(time_point now) const;

  /// @returns how long a provider computes a result of it.
  duration computing(const messages::service_offer& offer) const;
  policies::link_estimator& link_of(provider_id provider);
  /// Whether its offer holds, and nothing speaks against asking.
  bool may_ask(const known_provider& provider, time_point now) const;
  policies::provider_view view_of(const known_provider& provider,
                                  time_point now);
  /// @param offering  The provider whose offer has come just now, if any.
  /// @returns first where it runs, then which may be asked for it: the one that
  /// offers just now, then by id.
  std::vector<policies::provider_view>
  views(const known_providers& providers, std::optional<provider_id> offering,
        time_point now);
  /// @returns what the vehicle tells of the providers that it could ask. Of
  /// more than protocol::most_candidates the nearest; by id.
  /// @param all   None of them where the service runs, which it would not leave
  ///              for nothing; by id.
  /// @param from  Where the vehicle is, m, east-north.
  std::vector<candidate> candidates(std::vector<policies::provider_view> all,
                                    point from) const;
};

} // namespace sofof::offloading

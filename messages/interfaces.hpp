// Every actor's interface, a sentence per message: the page to read first.
#pragma once

#include "messages/inspector_access.hpp"
#include "messages/protocol/its_pdu.hpp"
#include "messages/protocol/lifecycle.hpp"
#include "messages/protocol/motion.hpp"
#include "messages/protocol/qos.hpp"
#include "messages/protocol/record.hpp"
#include "messages/protocol/remote.hpp"
#include "messages/protocol/service.hpp"

#include <caf/result.hpp>
#include <caf/typed_actor.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace sofof::messages {

// Words of nothing but their names.

/// Begin.
struct begin_atom {};
inline constexpr begin_atom begin_atom_v{};

/// It is time; from an actor to itself.
struct tick_atom {};
inline constexpr tick_atom tick_atom_v{};

/// No provider stands by any more.
struct no_standby_atom {};
inline constexpr no_standby_atom no_standby_atom_v{};

/// A service may come home soon.
struct home_is_near_atom {};
inline constexpr home_is_near_atom home_is_near_atom_v{};

template <class... Ts>
using reacts_to = caf::result<void>(Ts...);

/// Runs one function of a service, cycle by cycle, and has a life cycle.
using instance_actor = caf::typed_actor<
    // Its life cycle shall take this step; an impossible one is ignored.
    reacts_to<lifecycle_step>,
    // The next cycles shall start from this.
    reacts_to<service_input>>;

/// Wherever results of cycles go.
using result_actor = caf::typed_actor<
    // A cycle is done.
    reacts_to<service_result>>;

/// Wherever inputs of a service go.
using input_actor = caf::typed_actor<
    // There is new input.
    reacts_to<service_input>>;

/// Feeds one accepted service at the provider.
using provider_manager_actor = result_actor::extend<
    // New input from the vehicle.
    reacts_to<service_input>,
    // The service has ended: finalise the instance.
    reacts_to<service_end>>;

/// Feeds one service in the vehicle and chooses its source. It alone decides
/// whose results the client gets, so there is always exactly one source.
using requester_manager_actor = result_actor::extend<
    // The client has new input.
    reacts_to<service_input>,
    // A provider runs the service too: feed it there, and use the results from
    // the first one on.
    reacts_to<session_id, provider_manager_actor>,
    // Of several, this provider stands by.
    reacts_to<standby>,
    // No provider stands by any more.
    reacts_to<no_standby_atom>,
    // The service may come home soon.
    reacts_to<home_is_near_atom>,
    // The session has ended: the local service plans at once.
    reacts_to<service_end>>;

/// Uses what a service gives; there is one per vehicle and service.
using client_actor = result_actor::extend<
    // From now on results come from this source.
    reacts_to<source_change>,
    // Inputs are wanted here.
    reacts_to<requester_manager_actor>>;

/// Stands between two services of a chain: what one of them gives becomes input
/// of the next.
using chain_stage_actor = client_actor::extend<
    // As input_actor takes it: for the first of them.
    reacts_to<service_input>,
    // Inputs of the next go here.
    reacts_to<input_actor>>;

/// Reports when results come late or stop coming.
using watchdog_actor = caf::typed_actor<
    // Watch this session; its first result came at this time.
    reacts_to<session_id, time_point>,
    // Another result has come.
    reacts_to<arrival>,
    // One has come that is of no use, for this reason; and the check alone.
    reacts_to<session_id, std::string, std::string>,
    // These are the limits from now on, but for the one of gaps.
    reacts_to<qos_limits>,
    // Watch no longer.
    reacts_to<service_end>>;

/// SR, the vehicle's side of offloading, as providers see it. The sender of
/// an offer is the provider, or a link that looks like it.
using requester_actor = result_actor::extend<
    // A provider has seen this station in its area.
    reacts_to<service_offer>,
    // Each requested service is accepted or refused; one manager per accepted
    // service, in the order of the verdicts.
    reacts_to<service_response, std::vector<provider_manager_actor>>,
    // What the provider believes to run for it.
    reacts_to<session_digest>,
    // The provider has ended a session.
    reacts_to<service_end>>;

/// SR, as the other actors of its vehicle see it.
using onboard_requester_actor = requester_actor::extend<
    // The own motion, every protocol::ego_period.
    reacts_to<ego_state>,
    // The first result of a session is in use.
    reacts_to<session_id>,
    // The scene is safe under this response time, as this service finds it.
    reacts_to<service_name, duration>,
    // The watchdog reports a violation, or a result was implausible.
    reacts_to<qos_violation>>;

/// SP, the edge server's side of offloading, as requesters see it.
using provider_actor = caf::typed_actor<
    // What a station tells everybody: a CAM, a CPM. Its requester can be
    // reached here.
    reacts_to<its_pdu, requester_actor>,
    // A station asks for offered services.
    reacts_to<service_request, requester_actor>,
    // The requester has ended a session.
    reacts_to<service_end>>;

/// SP, as its own sensors see it, and the vehicle that it rides with.
using roadside_provider_actor = provider_actor::extend<
    // One of them has looked at the road.
    reacts_to<roadside_detections>,
    // That vehicle is here, every protocol::ego_period.
    reacts_to<ego_state>>;

/// All that crosses the air between one vehicle and one provider. It looks
/// like the far end to both of them: to the provider and its managers like a
/// requester, to the requester like all of these.
using link_actor = requester_actor::extend<
    // As provider_actor and provider_manager_actor take them.
    reacts_to<its_pdu, requester_actor>,
    reacts_to<service_request, requester_actor>, reacts_to<service_input>>;

/// The vehicles' end of a connection with a provider on another host: what that
/// sends to the vehicles of this process.
using vehicle_endpoint_actor = caf::typed_actor<
    // As requester_actor takes them; offers, with the station they are for.
    reacts_to<station_id::rep, service_offer>, reacts_to<service_response>,
    reacts_to<session_digest>, reacts_to<service_result>,
    reacts_to<service_end>,
    // The connection lives; whose clock says what.
    reacts_to<ping>, reacts_to<pong>,
    // The latest message of this stream has come: the next one may follow.
    reacts_to<stream_id>>;

/// The provider's end of a connection with vehicles on another host: what they
/// send to the provider of this process.
using provider_endpoint_actor = caf::typed_actor<
    // As provider_actor and provider_manager_actor take them; a CAM or a CPM,
    // with the station that sends it.
    reacts_to<station_id::rep, its_pdu>, reacts_to<service_request>,
    reacts_to<service_input>, reacts_to<service_end>,
    // The connection lives; whose clock says what.
    reacts_to<ping>, reacts_to<pong>,
    // The latest message of this stream has come: the next one may follow.
    reacts_to<stream_id>>;

/// Where one process of vehicles introduces itself, once.
using handshake_actor = caf::typed_actor<
    // It is welcome, and speaks to this endpoint from now on; or it is refused
    // by an error that says why.
    caf::result<peer_welcome, provider_endpoint_actor>(peer_hello,
                                                       vehicle_endpoint_actor)>;

/// All that a provider's process makes public. It never changes, so that
/// programs of different age can tell each other that they are.
using acceptor_actor = caf::typed_actor<
    // The peer's protocol version and the fingerprint of its types. Answered by
    // the own ones, and, if they are the same, a number to sign and the
    // handshake.
    caf::result<std::uint32_t, std::uint64_t, std::string,
                caf::strong_actor_ptr>(std::uint32_t, std::uint64_t)>;

/// Hears what other vehicles tell everybody.
using air_listener_actor = caf::typed_actor<
    // A station there has said this.
    reacts_to<point, its_pdu>>;

/// All that vehicles tell each other crosses it.
using air_actor = caf::typed_actor<
    // A station is here, and hears by this.
    reacts_to<station_id::rep, point, air_listener_actor>,
    // A station there tells everybody.
    reacts_to<station_id::rep, point, its_pdu>>;

/// Agrees with others how its vehicle goes through a crossing.
using crossing_driver_actor = client_actor::extend<
    // The own vehicle is here, and drives so.
    reacts_to<payload>,
    // As air_listener_actor takes it.
    reacts_to<point, its_pdu>>;

/// A car: moves, sends CAMs, follows the trajectories it is given.
using vehicle_actor = client_actor::extend<
    // Who agrees with others for it, and wants to know how it drives.
    reacts_to<crossing_driver_actor>,
    // At this place in the chain, the first being 0, stands this one.
    reacts_to<std::uint32_t, chain_stage_actor>,
    // What was agreed, ...
    reacts_to<payload>,
    // ... and what to tell everybody about it.
    reacts_to<its_pdu>,
    // What the driver has to know about the others.
    reacts_to<world::perception>,
    // It is on the road now: its place was free.
    reacts_to<begin_atom>>;

/// The streets and all that moves on them, and what sensors see of it.
using road_actor = caf::typed_actor<
    // A vehicle is here now; it wants to know what it perceives.
    reacts_to<motion_report, vehicle_actor>,
    // A vehicle wants to appear here; it waits until its place is free.
    reacts_to<begin_atom, motion_report, vehicle_actor>,
    // A vehicle has arrived and leaves the streets.
    reacts_to<station_id::rep>>;

/// Keeps what happened.
using recorder_actor = caf::typed_actor<
    // Something has.
    reacts_to<record>>;

} // namespace sofof::messages

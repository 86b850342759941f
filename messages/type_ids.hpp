// The one block of type ids. An id is a position, and processes that talk must
// agree on it: they compare a fingerprint of all names
// (actors/remote/type_block) before anything else, so the order is free. The
// names are those of protocol 7, for as long as it lasts.
#pragma once

#include "messages/admission.hpp"
#include "messages/interfaces.hpp"

#include <caf/allowed_unsafe_message_type.hpp>
#include <caf/type_id.hpp>

// Never leaves its process: it can neither be written nor read.
CAF_ALLOW_UNSAFE_MESSAGE_TYPE(sofof::record)

CAF_BEGIN_TYPE_ID_BLOCK(sofof, first_custom_type_id)

CAF_ADD_TYPE_ID(sofof, (sofof::time_point), "sofof::time_point")
CAF_ADD_TYPE_ID(sofof, (sofof::point), "sofof::point")
CAF_ADD_TYPE_ID(sofof, (sofof::service_name), "sofof::service_name")
CAF_ADD_TYPE_ID(sofof, (sofof::payload), "sofof::payload")
CAF_ADD_TYPE_ID(sofof, (sofof::session_id), "sofof::session_id")
CAF_ADD_TYPE_ID(sofof, (sofof::cam), "sofof::cam")
CAF_ADD_TYPE_ID(sofof, (sofof::service_offer), "sofof::service_offer")
CAF_ADD_TYPE_ID(sofof, (sofof::service_request), "sofof::service_request")
CAF_ADD_TYPE_ID(sofof, (sofof::service_response), "sofof::service_response")
CAF_ADD_TYPE_ID(sofof, (sofof::service_input), "sofof::service_input")
CAF_ADD_TYPE_ID(sofof, (sofof::service_result), "sofof::service_result")
CAF_ADD_TYPE_ID(sofof, (sofof::service_end), "sofof::service_end")
CAF_ADD_TYPE_ID(sofof, (sofof::qos_limits), "sofof::qos_limits")
CAF_ADD_TYPE_ID(sofof, (sofof::arrival), "sofof::arrival")
CAF_ADD_TYPE_ID(sofof, (sofof::qos_violation), "sofof::qos_violation")
CAF_ADD_TYPE_ID(sofof, (sofof::lifecycle_step), "sofof::lifecycle_step")
CAF_ADD_TYPE_ID(sofof, (sofof::motion_report), "sofof::motion_report")
CAF_ADD_TYPE_ID(sofof, (sofof::ego_state), "sofof::ego_state")
CAF_ADD_TYPE_ID(sofof, (sofof::source_change), "sofof::source_change")
CAF_ADD_TYPE_ID(sofof, (sofof::perception), "sofof::perception")
CAF_ADD_TYPE_ID(sofof, (sofof::record), "sofof::record")
CAF_ADD_TYPE_ID(sofof, (sofof::instance_actor), "sofof::instance_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::result_actor), "sofof::result_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::client_actor), "sofof::client_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::provider_manager_actor),
                "sofof::provider_manager_actor")
CAF_ADD_TYPE_ID(sofof, (std::vector<sofof::provider_manager_actor>),
                "std::vector<sofof::provider_manager_actor>")
CAF_ADD_TYPE_ID(sofof, (sofof::requester_manager_actor),
                "sofof::requester_manager_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::watchdog_actor), "sofof::watchdog_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::requester_actor), "sofof::requester_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::onboard_requester_actor),
                "sofof::onboard_requester_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::provider_actor), "sofof::provider_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::link_actor), "sofof::link_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::vehicle_actor), "sofof::vehicle_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::road_actor), "sofof::road_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::recorder_actor), "sofof::recorder_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::tick_atom), "sofof::tick_atom")
CAF_ADD_TYPE_ID(sofof, (sofof::roadside_detections),
                "sofof::roadside_detections")
CAF_ADD_TYPE_ID(sofof, (sofof::its_pdu), "sofof::its_pdu")
CAF_ADD_TYPE_ID(sofof, (sofof::peer_hello), "sofof::peer_hello")
CAF_ADD_TYPE_ID(sofof, (sofof::peer_welcome), "sofof::peer_welcome")
CAF_ADD_TYPE_ID(sofof, (sofof::ping), "sofof::ping")
CAF_ADD_TYPE_ID(sofof, (sofof::pong), "sofof::pong")
CAF_ADD_TYPE_ID(sofof, (sofof::stream_id), "sofof::stream_id")
// These have got other names since.
CAF_ADD_TYPE_ID(sofof, (sofof::vehicle_endpoint_actor), "sofof::uplink_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::provider_endpoint_actor), "sofof::session_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::handshake_actor), "sofof::entrance_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::acceptor_actor), "sofof::gate_actor")
CAF_ADD_TYPE_ID(sofof, (sofof::begin_atom), "sofof::begin_atom")
CAF_ADD_TYPE_ID(sofof, (sofof::admission), "sofof::admission")

CAF_END_TYPE_ID_BLOCK(sofof)

// The one block of type ids. An id is a position, and processes that talk must
// agree on it: they compare a fingerprint of all names
// (actors/remote/type_block) before anything else, so the order is free.
#pragma once

#include "messages/admission.hpp"
#include "messages/interfaces.hpp"

#include <caf/allowed_unsafe_message_type.hpp>
#include <caf/type_id.hpp>

// Never leaves its process: it can neither be written nor read.
CAF_ALLOW_UNSAFE_MESSAGE_TYPE(sofof::messages::record)

CAF_BEGIN_TYPE_ID_BLOCK(sofof, first_custom_type_id)

CAF_ADD_TYPE_ID(sofof, (sofof::time_point))
CAF_ADD_TYPE_ID(sofof, (sofof::point))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::service_name))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::payload))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::session_id))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::cam))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::service_offer))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::session_digest))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::service_request))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::service_response))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::standby))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::service_input))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::service_result))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::service_end))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::qos_limits))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::arrival))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::qos_violation))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::lifecycle_step))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::motion_report))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::ego_state))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::source_change))
CAF_ADD_TYPE_ID(sofof, (sofof::world::perception))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::record))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::instance_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::result_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::client_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::input_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::chain_stage_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::provider_manager_actor))
CAF_ADD_TYPE_ID(sofof, (std::vector<sofof::messages::provider_manager_actor>))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::requester_manager_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::watchdog_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::requester_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::onboard_requester_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::provider_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::link_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::vehicle_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::road_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::recorder_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::tick_atom))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::roadside_detections))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::its_pdu))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::peer_hello))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::peer_welcome))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::ping))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::pong))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::stream_id))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::vehicle_endpoint_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::provider_endpoint_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::handshake_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::acceptor_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::begin_atom))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::no_standby_atom))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::home_is_near_atom))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::admission))

CAF_ADD_TYPE_ID(sofof, (sofof::messages::air_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::air_listener_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::messages::crossing_driver_actor))

CAF_END_TYPE_ID_BLOCK(sofof)

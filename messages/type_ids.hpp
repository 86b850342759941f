// The one block of type ids. An id is a position, and processes that talk must
// agree on it: they compare a fingerprint of all names
// (actors/remote/type_block) before anything else, so the order is free.
#pragma once

#include "messages/admission.hpp"
#include "messages/interfaces.hpp"

#include <caf/allowed_unsafe_message_type.hpp>
#include <caf/type_id.hpp>

// Never leaves its process: it can neither be written nor read.
CAF_ALLOW_UNSAFE_MESSAGE_TYPE(sofof::record)

CAF_BEGIN_TYPE_ID_BLOCK(sofof, first_custom_type_id)

CAF_ADD_TYPE_ID(sofof, (sofof::time_point))
CAF_ADD_TYPE_ID(sofof, (sofof::point))
CAF_ADD_TYPE_ID(sofof, (sofof::service_name))
CAF_ADD_TYPE_ID(sofof, (sofof::payload))
CAF_ADD_TYPE_ID(sofof, (sofof::session_id))
CAF_ADD_TYPE_ID(sofof, (sofof::cam))
CAF_ADD_TYPE_ID(sofof, (sofof::service_offer))
CAF_ADD_TYPE_ID(sofof, (sofof::service_request))
CAF_ADD_TYPE_ID(sofof, (sofof::service_response))
CAF_ADD_TYPE_ID(sofof, (sofof::standby))
CAF_ADD_TYPE_ID(sofof, (sofof::service_input))
CAF_ADD_TYPE_ID(sofof, (sofof::service_result))
CAF_ADD_TYPE_ID(sofof, (sofof::service_end))
CAF_ADD_TYPE_ID(sofof, (sofof::qos_limits))
CAF_ADD_TYPE_ID(sofof, (sofof::arrival))
CAF_ADD_TYPE_ID(sofof, (sofof::qos_violation))
CAF_ADD_TYPE_ID(sofof, (sofof::lifecycle_step))
CAF_ADD_TYPE_ID(sofof, (sofof::motion_report))
CAF_ADD_TYPE_ID(sofof, (sofof::ego_state))
CAF_ADD_TYPE_ID(sofof, (sofof::source_change))
CAF_ADD_TYPE_ID(sofof, (sofof::perception))
CAF_ADD_TYPE_ID(sofof, (sofof::record))
CAF_ADD_TYPE_ID(sofof, (sofof::instance_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::result_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::client_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::provider_manager_actor))
CAF_ADD_TYPE_ID(sofof, (std::vector<sofof::provider_manager_actor>))
CAF_ADD_TYPE_ID(sofof, (sofof::requester_manager_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::watchdog_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::requester_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::onboard_requester_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::provider_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::link_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::vehicle_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::road_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::recorder_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::tick_atom))
CAF_ADD_TYPE_ID(sofof, (sofof::roadside_detections))
CAF_ADD_TYPE_ID(sofof, (sofof::its_pdu))
CAF_ADD_TYPE_ID(sofof, (sofof::peer_hello))
CAF_ADD_TYPE_ID(sofof, (sofof::peer_welcome))
CAF_ADD_TYPE_ID(sofof, (sofof::ping))
CAF_ADD_TYPE_ID(sofof, (sofof::pong))
CAF_ADD_TYPE_ID(sofof, (sofof::stream_id))
CAF_ADD_TYPE_ID(sofof, (sofof::vehicle_endpoint_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::provider_endpoint_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::handshake_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::acceptor_actor))
CAF_ADD_TYPE_ID(sofof, (sofof::begin_atom))
CAF_ADD_TYPE_ID(sofof, (sofof::no_standby_atom))
CAF_ADD_TYPE_ID(sofof, (sofof::admission))

CAF_END_TYPE_ID_BLOCK(sofof)

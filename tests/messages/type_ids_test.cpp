// The numbers of the message types; processes that talk must agree on them.
#include "messages/type_ids.hpp"

#include <caf/init_global_meta_objects.hpp>
#include <doctest/doctest.h>

#include <string>
#include <string_view>
#include <vector>

using namespace sofof;

// Append only. When this fails because a type was put in between or removed,
// put it at the end, or keep its place.
TEST_CASE("type ids are where they have always been") {
  const std::vector<std::string_view> names{
      "sofof::time_point",
      "sofof::point",
      "sofof::service_name",
      "sofof::payload",
      "sofof::session_id",
      "sofof::cam",
      "sofof::service_offer",
      "sofof::service_request",
      "sofof::service_response",
      "sofof::service_input",
      "sofof::service_result",
      "sofof::service_end",
      "sofof::qos_limits",
      "sofof::arrival",
      "sofof::qos_violation",
      "sofof::lifecycle_step",
      "sofof::motion_report",
      "sofof::ego_state",
      "sofof::source_change",
      "sofof::perception",
      "sofof::record",
      "sofof::instance_actor",
      "sofof::result_actor",
      "sofof::client_actor",
      "sofof::provider_manager_actor",
      "std::vector<sofof::provider_manager_actor>",
      "sofof::requester_manager_actor",
      "sofof::watchdog_actor",
      "sofof::requester_actor",
      "sofof::onboard_requester_actor",
      "sofof::provider_actor",
      "sofof::link_actor",
      "sofof::vehicle_actor",
      "sofof::road_actor",
      "sofof::recorder_actor",
      "sofof::tick_atom",
      "sofof::roadside_detections",
      "sofof::its_pdu",
      "sofof::peer_hello",
      "sofof::peer_welcome",
      "sofof::ping",
      "sofof::pong",
      "sofof::stream_id",
      "sofof::uplink_actor",
      "sofof::session_actor",
      "sofof::entrance_actor",
      "sofof::gate_actor",
      "sofof::begin_atom",
      "sofof::admission",
  };
  constexpr auto first = caf::id_block::sofof::begin;
  CHECK(first == 200);
  REQUIRE(caf::id_block::sofof::end - first >= names.size());
  for (std::size_t k = 0; k < names.size(); ++k) {
    const auto id = static_cast<caf::type_id_t>(first + k);
    CAPTURE(id);
    CHECK(to_string(caf::query_type_name(id)) == names[k]);
  }
}

TEST_CASE("every type id is listed above") {
  CHECK(caf::id_block::sofof::end - caf::id_block::sofof::begin == 49);
}

TEST_CASE("numbers of some types, written out") {
  CHECK(caf::type_id_v<time_point> == 200);
  CHECK(caf::type_id_v<cam> == 205);
  CHECK(caf::type_id_v<service_end> == 211);
  CHECK(caf::type_id_v<provider_manager_actor> == 224);
  CHECK(caf::type_id_v<tick_atom> == 235);
  CHECK(caf::type_id_v<roadside_detections> == 236);
  CHECK(caf::type_id_v<its_pdu> == 237);
  CHECK(caf::type_id_v<peer_hello> == 238);
  CHECK(caf::type_id_v<acceptor_actor> == 246);
  CHECK(caf::type_id_v<begin_atom> == 247);
}

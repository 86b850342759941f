// Messages as JSON: there and back, and what is said of mistakes.
#include "messages/etsi/json.hpp"

#include "messages/etsi/hex.hpp"
#include "tests/support/any_message.hpp"

#include <doctest/doctest.h>

#include <string>
#include <string_view>

namespace sofof::messages::etsi {
namespace {

using test::any_message;

std::string json_of(const message& m) {
  std::string json;
  append_json(json, m);
  return json;
}

std::string hex_of(const message& m) {
  const auto [octets, error] = encode_message(m);
  CAPTURE(error);
  REQUIRE(octets);
  std::string hex;
  append_hex(hex, *octets);
  return hex;
}

std::string error_of(std::string_view json) {
  const auto [m, error] = message_from_json(json);
  CHECK(m.has_value() == error.empty());
  return error;
}

/// @returns the JSON of a plain CAM with the first `from` replaced.
std::string cam_with(std::string_view from, std::string_view to) {
  auto json = json_of(cam{});
  const auto at = json.find(from);
  REQUIRE(at != json.npos);
  return json.replace(at, from.size(), to);
}

} // namespace

TEST_CASE("what was decoded, printed, read and encoded is what it was") {
  for (std::uint64_t seed = 0; seed < 400; ++seed) {
    CAPTURE(seed);
    const auto hex = hex_of(any_message(seed));
    const auto decoded = decode_message(*octets_from_hex(hex));
    CAPTURE(decoded.error);
    REQUIRE(decoded.value);
    const auto json = json_of(*decoded.value);
    CHECK(json.find('\n') == json.npos);
    const auto read = message_from_json(json);
    CAPTURE(read.error);
    REQUIRE(read.value);
    CHECK(hex_of(*read.value) == hex);
    CHECK(json_of(*read.value) == json);
  }
}

TEST_CASE("a message tells its fields by their names, in order") {
  const auto json = json_of(mcm{});
  CHECK(json
        == R"({"header":{"protocolVersion":2,"messageId":20,"stationId":0},)"
           R"("mcm":{"generationDeltaTime":0,"mcmParameters":{)"
           R"("basicContainer":{"stationType":0,"referencePosition":{)"
           R"("latitude":900000001,"longitude":1800000001,)"
           R"("positionConfidenceEllipse":{"semiMajorAxisLength":4095,)"
           R"("semiMinorAxisLength":4095,"semiMajorAxisOrientation":3601},)"
           R"("altitude":{"altitudeValue":800001,)"
           R"("altitudeConfidence":"unavailable"}}},)"
           R"("maneuverContainer":{"roadUserContainer":{"roadUserState":{)"
           R"("roadUserType":"connectedVehicle","speed":16383,)"
           R"("heading":3601,"length":62,"width":62}}}}}})");
}

TEST_CASE("members may come in any order, with white space between") {
  const auto [m, error] = message_from_json(
      R"({ "mcm": {"mcmParameters": {"maneuverContainer":
           {"suggestedManeuverContainer": {"targetStationID": 7}},
           "basicContainer": {"referencePosition": {"longitude": 2,
             "latitude": 1, "altitude": {"altitudeConfidence": "outOfRange",
             "altitudeValue": 3}, "positionConfidenceEllipse":
             {"semiMinorAxisLength": 1, "semiMajorAxisLength": 2,
              "semiMajorAxisOrientation": 3}}, "stationType": 5}},
           "generationDeltaTime": 9},
          "header": {"stationId": 8, "messageId": 20, "protocolVersion": 2}})");
  CHECK(error == "");
  REQUIRE(m);
  const auto& read = std::get<mcm>(*m);
  CHECK(read.body.generation == 9);
  CHECK(read.body.parameters.basic.position.longitude == 2);
  CHECK(std::get<1>(read.body.parameters.maneuver.value).target == 7);
}

TEST_CASE("flags are zeros and ones, unknown names are numbers") {
  cam m;
  auto& motion = std::get<0>(m.body.parameters.high_frequency.value);
  motion.control.emplace().set(1);
  motion.curvature_mode = static_cast<curvature_calculation_mode>(5);
  const auto json = json_of(m);
  CHECK(json.find(R"("accelerationControl":"0100000")") != json.npos);
  CHECK(json.find(R"("curvatureCalculationMode":5)") != json.npos);
  CHECK(hex_of(message_from_json(json).value.value()) == hex_of(m));
}

TEST_CASE("a mistake is told with its place, and what is expected") {
  CHECK(error_of("{") == "this is no JSON from character 2 on");
  CHECK(error_of("[]") == "the message is an array, and an object is expected");
  CHECK(error_of("{}") == "the message has no \"header\"");
  CHECK(error_of(R"({"header": 5})")
        == "header is 5, and an object is expected");
  CHECK(error_of(R"({"header": {"protocolVersion": 2, "messageID": 1}})")
            .starts_with("a DENM of protocol version 2 is not known"));
  const std::string basic = "cam.camParameters.basicContainer";
  CHECK(error_of(cam_with(R"("stationType":0)", R"("stationType":256)"))
        == basic
               + ".stationType is 256, and a whole number from 0 to 255 is "
                 "expected");
  for (const auto* wrong :
       {"-1", "1.0", "\"1\"", "null", "[1]", "18446744073709551615", "1e400"}) {
    CAPTURE(wrong);
    CHECK(error_of(cam_with(R"("stationType":0)",
                            std::string{R"("stationType":)"} + wrong))
          != "");
  }
  CHECK(error_of(cam_with("stationType", "stationTyp"))
        == basic
               + " has a member \"stationTyp\", did you mean "
                 "\"stationType\"?");
  CHECK(error_of(cam_with(R"("stationType":0,)", ""))
        == basic + " has no \"stationType\"");
  CHECK(error_of(cam_with(R"("unavailable")", R"("unavailabel")"))
        == basic
               + ".referencePosition.altitude.altitudeConfidence is "
                 "\"unavailabel\", did you mean \"unavailable\"?");
  CHECK(error_of(cam_with("basicVehicleContainerHigh", "lorryContainerHigh"))
        == "cam.camParameters.highFrequencyContainer has a member "
           "\"lorryContainerHighFrequency\", did you mean "
           "\"rsuContainerHighFrequency\"?");
  CHECK(error_of(cam_with(R"("yawRate":)",
                          R"("accelerationControl":"012","yawRate":)"))
        == "cam.camParameters.highFrequencyContainer."
           "basicVehicleContainerHighFrequency.accelerationControl is \"012\", "
           "and a string of 7 zeros and ones is expected");
}

TEST_CASE("JSON is not followed into any depth") {
  const auto nested = [](std::size_t levels) {
    return std::string(levels, '[') + std::string(levels, ']');
  };
  const std::string too_deep = "this is nested deeper than 32 levels";
  CHECK(error_of(nested(32))
        == "the message is an array, and an object is expected");
  CHECK(error_of(nested(33)) == too_deep);
  CHECK(error_of(nested(100'000)) == too_deep);
  CHECK(error_of(std::string(100'000, '[')) == too_deep);
  CHECK(
      error_of(cam_with(R"("stationType":0)", R"("stationType":)" + nested(20)))
      == "cam.camParameters.basicContainer.stationType is an array, and a "
         "whole number from 0 to 255 is expected");
}

TEST_CASE("a message with what another kind has is refused") {
  CHECK(error_of(cam_with("messageID\":2", "messageID\":20"))
        == "the message has a member \"cam\", did you mean \"mcm\"?");
}

TEST_CASE("a usual value is told, and need not be") {
  tr103562::cpm m;
  auto& seen = m.body.parameters.objects.emplace();
  seen.resize(1);
  auto json = json_of(m);
  const std::string_view usual = R"("objectRefPoint":0)";
  const auto at = json.find(usual);
  REQUIRE(at != json.npos);
  json.erase(at - 1, usual.size() + 1); // and the comma before it
  CHECK(hex_of(message_from_json(json).value.value()) == hex_of(m));
}

TEST_CASE("hexadecimal digits are read as people write them") {
  CHECK(octets_from_hex(" 0x0A ff\r") == octets_from_hex("0aFF"));
  CHECK(octets_from_hex("0aff")->size() == 2);
  CHECK(octets_from_hex("")->empty());
  CHECK(!octets_from_hex("0"));
  CHECK(!octets_from_hex("0g"));
  CHECK(!octets_from_hex("0a0xff"));
}

} // namespace sofof::messages::etsi

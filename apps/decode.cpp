// sofof decode: V2X messages from hexadecimal digits to JSON.
#include "apps/command.hpp"
#include "apps/filter_lines.hpp"
#include "messages/etsi/hex.hpp"
#include "messages/etsi/json.hpp"

#include <memory>

namespace sofof::apps {

namespace {

turned_line decode(const std::string& line) {
  const auto octets = messages::etsi::octets_from_hex(line);
  if (!octets)
    return {{}, "only hexadecimal digits, two an octet, are expected"};
  const auto [message, error] = messages::etsi::decode_message(*octets);
  if (!message)
    return {{}, error};
  turned_line json;
  messages::etsi::append_json(json.text, *message);
  return json;
}

} // namespace

void add_decode(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "decode", "Decode V2X messages: hexadecimal in, JSON out");
  auto words =
      std::make_shared<std::vector<std::string>>(std::vector<std::string>{"-"});
  command->add_option("HEX", *words,
                      "CAM, CPM or MCM in UPER as hexadecimal digits; -, the "
                      "default, reads one a line");
  command->footer(
      "Prints a JSON object a line; where a message is wrong, {\"error\": ..., "
      "\"line\": ...}.\nExample:\n  sofof decode - < messages.hex | jq "
      "'.header | .stationID // .stationId'");
  command->callback(
      [words, &exit_code] { exit_code = filter_lines(*words, decode); });
}

} // namespace sofof::apps

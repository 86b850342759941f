// sofof encode: V2X messages from JSON to hexadecimal digits.
#include "apps/command.hpp"
#include "apps/filter_lines.hpp"
#include "messages/etsi/hex.hpp"
#include "messages/etsi/json.hpp"

#include <memory>

namespace sofof::apps {

namespace {

turned_line encode(const std::string& line) {
  const auto [message, error] = messages::etsi::message_from_json(line);
  if (!message)
    return {{}, error};
  const auto [octets, reason] = messages::etsi::encode_message(*message);
  if (!octets)
    return {{}, reason};
  turned_line hex;
  messages::etsi::append_hex(hex.text, *octets);
  return hex;
}

} // namespace

void add_encode(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "encode", "Encode V2X messages: JSON in, hexadecimal out");
  auto words =
      std::make_shared<std::vector<std::string>>(std::vector<std::string>{"-"});
  command->add_option("JSON", *words,
                      "CAM, CPM or MCM as `sofof decode` prints it; -, the "
                      "default, reads one a line");
  command->footer(
      "Prints hexadecimal digits, a message a line; where one is wrong, "
      "{\"error\": ..., \"line\": ...}.\nExample:\n  sofof decode - < "
      "messages.hex | sed s/forward/backward/ | sofof encode -");
  command->callback(
      [words, &exit_code] { exit_code = filter_lines(*words, encode); });
}

} // namespace sofof::apps

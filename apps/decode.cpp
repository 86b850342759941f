// sofof decode: V2X messages from hexadecimal digits or captures to JSON.
#include "apps/capture.hpp"
#include "apps/command.hpp"
#include "apps/filter_lines.hpp"
#include "messages/etsi/hex.hpp"
#include "messages/etsi/json.hpp"

#include <fmt/format.h>

#include <csignal>
#include <iostream>
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

int decode_file(const std::string& file) {
  std::signal(SIGPIPE, SIG_DFL); // who reads no more ends us without a word
  const auto all = decode_capture(
      file, [](const std::string& line) { std::cout << line << '\n'; });
  std::cout.flush();
  if (all.others > 0)
    std::cerr << fmt::format("sofof: {} packets without an ITS message were "
                             "skipped.\n",
                             all.others);
  if (all.messages == 0 && all.others == 0)
    std::cerr << fmt::format("sofof: {}: there are no packets.\n", file);
  if (!all.cut_off.empty())
    std::cerr << fmt::format("sofof: {}: the capture ends here: {}.\n", file,
                             all.cut_off);
  return all.has_errors || !all.cut_off.empty() ? 1 : 0;
}

} // namespace

void add_decode(CLI::App& app, int& exit_code) {
  auto* command = app.add_subcommand(
      "decode", "Decode V2X messages: hexadecimal or a capture in, JSON out");
  auto words =
      std::make_shared<std::vector<std::string>>(std::vector<std::string>{"-"});
  auto capture = std::make_shared<std::string>();
  auto* hex = command->add_option(
      "HEX", *words,
      "CAM, CPM or MCM in UPER as hexadecimal digits; -, the default, reads "
      "one a line");
  command
      ->add_option("--pcap", *capture,
                   "Read the messages of a capture (pcap, pcapng; -: standard "
                   "input) of Ethernet or IEEE 802.11, with GeoNetworking and "
                   "BTP; signatures are not verified")
      ->type_name("FILE")
      ->check([](const std::string& file) {
        return std::string{file.empty() ? "a file's name is expected" : ""};
      })
      ->excludes(hex);
  command->footer(
      "Prints a JSON object a line; where a message is wrong, {\"error\": ..., "
      "\"line\": ...}.\nExamples:\n  sofof decode - < messages.hex | jq "
      "'.header | .stationID // .stationId'\n  sofof decode --pcap air.pcap | "
      "jq -r '[.unix_ns, .port] | @tsv'");
  command->callback([words, capture, &exit_code] {
    exit_code =
        capture->empty() ? filter_lines(*words, decode) : decode_file(*capture);
  });
}

} // namespace sofof::apps

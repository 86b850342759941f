// ITS messages as datagrams between a run and a program that is none of ours.
#include "network/udp/datagrams.hpp"
#include "tests/processes/hosts.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/hex.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <csignal>
#include <mutex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::test;

namespace {

/// The other program.
struct other_program {
  std::mutex mutex;
  std::vector<octets> heard;
  network::datagrams line;

  explicit other_program(const network::network_address& to)
      : line{to, network::network_address{"127.0.0.1", 0}, 2048,
             [this](std::span<const std::byte> x) {
               const std::lock_guard lock{mutex};
               heard.emplace_back(x.begin(), x.end());
             }} {}

  std::vector<octets> so_far() {
    const std::lock_guard lock{mutex};
    return heard;
  }
  std::string address() const { return network::print_address(line.address()); }
};

unsigned port_of_datagram(const octets& x) {
  return std::to_integer<unsigned>(x.at(0)) << 8
         | std::to_integer<unsigned>(x.at(1));
}

} // namespace

TEST_CASE("another program gets each kind of message behind its port") {
  const workplace at;
  other_program other{{"127.0.0.1", 9}};
  program run{words{"run", scenario_file, "--realtime", "--quiet", "--udp",
                    other.address(), "--out", "out", "--pcap", "out/air.pcap"}
                  + patient(2),
              at.here()};
  const auto kinds = [&other] {
    std::set<unsigned> all;
    for (const auto& x : other.so_far())
      all.insert(port_of_datagram(x));
    return all;
  };
  CHECK(wait_until([&] {
    return other.so_far().size() > 60
           && kinds() == std::set<unsigned>{2001, 2009, 2020};
  }));
  run.send(SIGINT);
  CHECK(run.wait().code == 130);
  // What was captured is what was sent, in the same order.
  const auto decoded = at.run_sofof({"decode", "--pcap", "out/air.pcap"}).out;
  std::istringstream lines{decoded};
  const auto sent = other.so_far();
  words hex{"decode"};
  for (std::size_t i = 0; i < 60; ++i)
    hex.push_back(to_hex({sent[i].begin() + 4, sent[i].end()}));
  std::istringstream ours{at.run_sofof(hex).out};
  for (std::size_t i = 0; i < 60; ++i) {
    std::string line, same;
    REQUIRE(std::getline(lines, line));
    REQUIRE(std::getline(ours, same));
    const auto x = nlohmann::ordered_json::parse(line);
    CHECK(x.at("port") == port_of_datagram(sent[i]));
    CHECK(x.at("message") == nlohmann::ordered_json::parse(same));
  }
}

TEST_CASE("a station of another program is heard, and doubted where nobody "
          "sees it") {
  const workplace at;
  other_program other{{"127.0.0.1", 9}};
  program run{words{"run", scenario_file, "--realtime", "--quiet", "--udp",
                    other.address(), "--udp-from", "127.0.0.1:0", "--out",
                    "out"}
                  + patient(3),
              at.here()};
  static constexpr std::string_view before =
      "datagrams are heard at 127.0.0.1:";
  REQUIRE(
      wait_until([&] { return contains(run.printed(), std::string{before}); }));
  const auto text = run.printed();
  other_program ghost{
      {"127.0.0.1", static_cast<std::uint16_t>(std::stoi(
                        text.substr(text.find(before) + before.size())))}};
  // Each CAM of a car comes back in another name: where that car is, nothing
  // else can be.
  std::size_t next = 0;
  CHECK(wait_until([&] {
    const auto heard = other.so_far();
    for (; next < heard.size(); ++next)
      if (auto echo = heard[next]; port_of_datagram(echo) == 2001) {
        echo[8] = std::byte{0x13}; // the station, in the message's header
        ghost.line.send(echo);
      }
    return contains(read_file(at / "out/events.jsonl"), "\"doubted\"");
  }));
  run.send(SIGINT);
  CHECK(run.wait().code == 130);
}

TEST_CASE("datagrams are for the wall clock, and one address is enough") {
  const workplace at;
  const auto refused =
      at.run_sofof({"run", scenario_file, "--udp", "127.0.0.1:9"});
  CHECK(refused.code == 2);
  CHECK(contains(refused.err, "add --realtime"));
  const auto nowhere = at.run_sofof(
      {"run", scenario_file, "--realtime", "--udp-from", "127.0.0.1:9"});
  CHECK(nowhere.code == 2);
}

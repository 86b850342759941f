// Runs are looked at while they go on.
#include "network/http/client.hpp"
#include "network/socket.hpp"
#include "tests/processes/hosts.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <cstddef>
#include <map>
#include <poll.h>
#include <string>
#include <string_view>
#include <sys/socket.h>
#include <vector>

using namespace sofof;
using namespace sofof::test;

namespace {

const words shown_live{"--live", "127.0.0.1:0"};

/// @returns the address of the page that a process has told.
network::http::url live_page_of(const program& of) {
  static constexpr std::string_view before = "live page: ";
  REQUIRE(wait_until([&of] {
    const auto text = of.printed();
    const auto at = text.find(before);
    return at != text.npos && text.find('\n', at) != text.npos;
  }));
  const auto text = of.printed();
  const auto at = text.find(before) + before.size();
  const auto url =
      network::http::parse_url(text.substr(at, text.find('\n', at) - at));
  REQUIRE(url);
  return *url;
}

network::http::response part_of(network::http::url page,
                                const std::string& target) {
  page.target = target;
  return network::http::get(page, std::chrono::seconds{10});
}

/// Follows a run as a browser does.
class follower {
public:
  explicit follower(const network::http::url& page,
                    const std::string& more = "") {
    auto started =
        network::start_connecting(network::loopback_port(page.at.port));
    REQUIRE(started.error == 0);
    line_ = std::move(started.socket);
    REQUIRE(is_ready(POLLOUT));
    const auto words =
        "GET /events HTTP/1.1\r\nHost: localhost\r\n" + more + "\r\n";
    REQUIRE(::send(line_.get(), words.data(), words.size(), MSG_NOSIGNAL)
            == static_cast<ssize_t>(words.size()));
  }

  /// @returns the next frame; the test ends if none comes.
  nlohmann::json next() {
    static constexpr std::string_view begin = "\ndata: ";
    for (;;) {
      const auto from = text_.find(begin);
      const auto until =
          from == text_.npos ? from : text_.find("\n\n", from + 1);
      if (until != text_.npos) {
        const auto data =
            text_.substr(from + begin.size(), until - from - begin.size());
        text_.erase(0, until + 1);
        return nlohmann::json::parse(data);
      }
      std::array<char, 16 * 1024> some{};
      REQUIRE(is_ready(POLLIN));
      const auto size = ::recv(line_.get(), some.data(), some.size(), 0);
      REQUIRE(size > 0);
      text_.append(some.data(), static_cast<std::size_t>(size));
    }
  }

private:
  bool is_ready(short what) const {
    constexpr int patience_ms = 30'000;
    pollfd event{line_.get(), what, 0};
    return poll(&event, 1, patience_ms) == 1;
  }

  descriptor line_;
  std::string text_;
};

using place = std::pair<double, double>;

std::map<int, place> places_in(const nlohmann::json& frame) {
  std::map<int, place> all;
  for (const auto& car : frame["cars"])
    all[car[0]] = {car[2], car[3]};
  return all;
}

/// Waits for a frame.
template <class Condition>
nlohmann::json frame_with(follower& of, Condition what) {
  constexpr int most_frames = 600; // a minute
  for (int i = 0; i < most_frames; ++i)
    if (auto frame = of.next(); what(frame))
      return frame;
  FAIL("no such frame");
  return {};
}

std::size_t remote_cars(const nlohmann::json& frame) {
  std::size_t count = 0;
  for (const auto& car : frame["cars"])
    count += car[6] >= 0;
  return count;
}

} // namespace

TEST_CASE("a run on the wall clock has a page, a scene, and frames of cars") {
  const workplace at;
  program run{words{"run", scenario_file, "--realtime", "--quiet", "--out",
                    "out", "--set", "record.tracks=false", "--live"},
              at.here()};
  const auto page = live_page_of(run);
  CHECK(page.at.host == "127.0.0.1");
  const auto html = part_of(page, "/");
  CHECK(html.type == "text/html; charset=utf-8");
  CHECK(contains(html.body, "EventSource"));
  const auto scene = nlohmann::json::parse(part_of(page, "/scene").body);
  CHECK(scene["name"] == "ulm_lehr");
  CHECK(scene["role"] == "run");
  CHECK(scene["providers"][0]["name"] == "mec");
  CHECK(scene["lanes"]["counts"].size() > 0);
  CHECK(contains(part_of(page, "/metrics").body, "sofof_vehicles 6"));
  CHECK(part_of(page, "/healthz").body == "ready\n");
  CHECK(part_of(page, "/none").status == 404);
  follower someone{page};
  const auto first =
      frame_with(someone, [](const auto& x) { return x["cars"].size() == 6; });
  CHECK(first["run"] == scene["run"]);
  const auto before = places_in(first);
  const auto later = frame_with(someone, [&](const auto& x) {
    return x["t"].template get<double>() > first["t"].get<double>() + 2;
  });
  CHECK(later["n"] > first["n"].get<int>() + 10); // ten a second, or nearly
  std::size_t moved = 0;
  for (const auto& [station, where] : places_in(later))
    moved += where != before.at(station);
  CHECK(moved >= 4); // some may wait
  run.send(SIGINT);
  CHECK(run.wait().code == 130);
  // What was shown was not written.
  CHECK(!std::filesystem::exists(at / "out" / "tracks.csv"));
}

TEST_CASE("vehicles show who plans and how late; providers whom they hear") {
  const workplace at;
  provider_process provider{at, "provider", patient(3) + shown_live};
  drive_process cars{at, "cars", provider.port(), patient(3) + shown_live};
  const auto of_cars = live_page_of(cars.run());
  const auto of_provider = live_page_of(provider.run());
  follower with_cars{of_cars}, with_provider{of_provider};
  const auto all_remote = [](const auto& x) { return remote_cars(x) == 3; };
  const auto driven = frame_with(with_cars, [&](const auto& x) {
    return all_remote(x) && !x["cars"][0][7].is_null();
  });
  CHECK(driven["cars"][0][7] < 200); // ms; clocks may be off by one
  CHECK(driven["loads"].empty());
  const auto heard = frame_with(with_provider, all_remote);
  CHECK(heard["loads"][0][1] > 0);
  const auto a = places_in(frame_with(with_cars, all_remote));
  const auto b = places_in(frame_with(with_provider, all_remote));
  for (const auto& [station, where] : a) { // a CAM comes once a second, or more
    REQUIRE(b.contains(station));
    CHECK(std::hypot(where.first - b.at(station).first,
                     where.second - b.at(station).second)
          < 40);
  }
  // Who comes back is told what it has missed, and no more.
  follower again{of_cars, "Last-Event-ID: 2\r\n"};
  CHECK(again.next()["events"][0][0] == 3);
  CHECK(stop(provider.run()).code == 0);
  CHECK(remote_cars(frame_with(
            with_cars, [](const auto& x) { return remote_cars(x) == 0; }))
        == 0);
  CHECK(stop(cars.run(), SIGINT).code == 130);
}

TEST_CASE("a page for others than this machine wants its token") {
  const workplace at;
  program run{words{"run", scenario_file, "--realtime", "--quiet", "--live",
                    "0.0.0.0:0"},
              at.here()};
  auto page = live_page_of(run);
  page.at.host = "127.0.0.1";
  CHECK(page.target.starts_with("/?token="));
  const auto token = page.target.substr(1);
  CHECK(part_of(page, "/" + token).status == 200);
  CHECK(part_of(page, "/scene" + token).status == 200);
  CHECK(part_of(page, "/healthz").status == 200);
  for (const auto* wanted : {"/", "/scene", "/events", "/metrics"}) {
    CHECK(part_of(page, wanted).status == 403);
    CHECK(part_of(page, wanted + token + "x").status == 403);
  }
  run.send(SIGINT);
  CHECK(run.wait().code == 130);
}

TEST_CASE("a live page wants the wall clock, and an address if anything") {
  const workplace at;
  const auto virtual_run = at.run_sofof({"run", scenario_file, "--live"});
  CHECK(virtual_run.code == 2);
  CHECK(contains(virtual_run.err, "add --realtime"));
  const auto nowhere =
      at.run_sofof({"run", scenario_file, "--realtime", "--live", "nowhere"});
  CHECK(nowhere.code == 2);
  CHECK(contains(nowhere.err, "'nowhere' is no HOST:PORT"));
}

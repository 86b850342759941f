// What programs that decide are told, byte by byte.
#include "programs/messages.hpp"

#include "tests/programs/asked_program.hpp"
#include "tests/support/contains.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <limits>

using namespace sofof;
using namespace sofof::programs;
using namespace sofof::test;
using nlohmann::json;

namespace sofof::messages_of_programs {

std::string ask(const policies::local_context& context, wishes wanted = {}) {
  std::string text;
  append_ask(text, 1, context, wanted);
  return text;
}

TEST_CASE("a program is greeted with the protocol's version, its side and what "
          "is run") {
  std::string text;
  append_hello(text, "lodm", "a \"town\"", 7);
  CHECK(text
        == R"({"type":"hello","sofof":1,"policy":"lodm",)"
           R"("scenario":"a \"town\"","seed":7})"
           "\n");
}

TEST_CASE("an ask of a vehicle is one line with all that a policy sees") {
  const asked_vehicle car;
  const auto text = ask(car.seen);
  CHECK(text.find('\n') == text.size() - 1);
  CHECK(text.starts_with(R"({"type":"ask","n":1,"policy":"lodm",)"
                         R"("t_s":12.345,"station":101,)"
                         R"("service":"trajectory_planning","current":null,)"
                         R"("since_s":0,"here":null,"speed_mps":8.5,)"
                         R"("providers":[{"id":65537,"x_m":0,"y_m":-20.25,)"
                         R"("east_mps":0,"north_mps":0,"reach_m":null,)"
                         R"("utilisation":0.1,"workers":4,)"
                         R"("computing_s":0.0032,"late":0.25,"gap":0.125,)"
                         R"("median_s":0.02,"p99_s":0.045,)"));
  const auto all = json::parse(text);
  CHECK(all["path"] == json::parse("[[0,0],[5,0.5]]"));
  CHECK(all["needs"]["max_latency_s"] == 0.05);
  CHECK(all["needs"]["worst_response_s"].is_null());
  CHECK(all["providers"][1]["median_s"].is_null());
  CHECK(all["draws"].size() == 4);
  CHECK(all["draws"][2] == car.seen.noise.uniform(7, 2));
  for (const auto* name : {"forecasts", "chain", "safe_response_s"})
    CHECK_FALSE(all.contains(name));
}

TEST_CASE("where a service runs is told also if a filter keeps that from the "
          "choice") {
  asked_vehicle car;
  car.seen.current = 65538;
  car.seen.since = time_point{std::chrono::seconds{2}};
  car.seen.here = &car.providers[1];
  car.seen.providers = {};
  const auto all = json::parse(ask(car.seen));
  CHECK(all["current"] == 65538);
  CHECK(all["since_s"] == 2);
  CHECK(all["here"]["id"] == 65538);
  CHECK(all["providers"].empty());
}

TEST_CASE("forecasts, chains and safe response times come to who wants them") {
  asked_vehicle car;
  const std::vector<policies::provider_forecast> ahead{
      {65537, {{0, 0.5, 0.02}, {1, 0.25, 0}}}};
  car.seen.forecasts = ahead;
  car.seen.safe_response = std::chrono::milliseconds{350};
  policies::chain_link link;
  link.service = "perception";
  link.place = 65537;
  link.providers = car.providers;
  const std::vector<policies::chain_link> chain{link};
  car.seen.chain = chain;
  const auto all = json::parse(
      ask(car.seen, {.forecast = true, .scene = true, .chain = true}));
  CHECK(all["safe_response_s"] == 0.35);
  CHECK(all["forecasts"][0]["along"][1]["in_s"] == 1);
  CHECK(all["chain"][0]["place"] == 65537);
  CHECK(all["chain"][0]["providers"].size() == 2);
}

TEST_CASE("a provider that rides with a vehicle is told with how it moves") {
  asked_vehicle car;
  car.providers[0].velocity_mps = {3.5, -1};
  car.providers[0].reach_m = 80;
  const auto leader = json::parse(ask(car.seen))["providers"][0];
  CHECK(leader["east_mps"] == 3.5);
  CHECK(leader["north_mps"] == -1);
  CHECK(leader["reach_m"] == 80);
}

TEST_CASE("an ask of a provider has what is asked and what runs") {
  const asked_provider mec;
  std::string text;
  append_ask(text, 3, mec.seen());
  CHECK(text.starts_with(R"({"type":"ask","n":3,"policy":"codm","t_s":12.5,)"
                         R"("provider":65537,"utilisation":0.25,"workers":4,)"
                         R"("area":[[0,0],[100,0],[100,100]],)"
                         R"("east_mps":0,"north_mps":0,"requests":[)"
                         R"({"station":101,)"));
  const auto all = json::parse(text);
  CHECK(all["requests"].size() == 2);
  CHECK(all["requests"][1]["task"]["wcet_s"] == 0.004);
  CHECK(all["requests"][1]["candidates"][0]["gain"] == 0.5);
  CHECK(all["requests"][1]["follows"]["at"] == "none");
  CHECK(all["sessions"][0]["since_s"] == 2);
  CHECK(all["sessions"][0]["worker"] == 1);
}

TEST_CASE("what became of decisions is told by its kind") {
  std::string text;
  append_told(text, policies::cycle_outcome{
                        .at = time_point{std::chrono::milliseconds{12400}},
                        .service = "any",
                        .computed_at = 65537,
                        .latency_s = std::numeric_limits<double>::infinity(),
                        .missed = true,
                        .energy_j = 0.002,
                        .station = 101});
  CHECK(text
        == R"({"type":"told","what":"cycle","t_s":12.4,"station":101,)"
           R"("service":"any","computed_at":65537,"latency_s":null,)"
           R"("missed":true,"energy_j":0.002,"cycles":1})"
           "\n");
  text.clear();
  append_told(text, policies::refusal_outcome{{}, "any", 65537, "no", 101});
  CHECK(contains(text, R"("what":"refusal","t_s":0,"station":101)"));
  text.clear();
  append_told(text,
              policies::episode_outcome{"any", 65537, 9.5, "left_area", 101});
  CHECK(contains(text, R"("remote_s":9.5,"end_reason":"left_area"})"));
  text.clear();
  append_bye(text);
  CHECK(text == "{\"type\":\"bye\"}\n");
}

TEST_CASE("every double reads back as the same bits") {
  asked_vehicle car;
  for (const auto x : {0.1, 1e-300, 1.0 / 3, 123456789.123456789}) {
    car.seen.speed_mps = x;
    CHECK(json::parse(ask(car.seen))["speed_mps"].get<double>() == x);
  }
}

} // namespace sofof::messages_of_programs

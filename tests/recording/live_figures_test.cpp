// What Prometheus collects of a process that runs.
#include "recording/live_figures.hpp"

#include "tests/support/contains.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <map>
#include <sstream>
#include <string>

namespace sofof::watched {

using namespace recording;
using namespace std::chrono_literals;
using test::contains;

namespace {

const messages::service_name planning{"trajectory_planning"};
const messages::session_id session{provider_id{1}, station_id{101}, planning,
                                   7};

run_info one_service() {
  run_info run;
  run.version = "1.2.3";
  run.vehicles = 6;
  run.services = {"trajectory_planning"};
  return run;
}

/// @returns values by name and labels.
std::map<std::string, std::string>
samples_of(const live_figures& of,
           exposition_format format = exposition_format::text) {
  std::map<std::string, std::string> all;
  std::istringstream lines{of.text(format)};
  for (std::string line; std::getline(lines, line);)
    if (!line.starts_with('#')) {
      const auto space = line.rfind(' ');
      CHECK(all.emplace(line.substr(0, space), line.substr(space + 1)).second);
    }
  return all;
}

std::string with_service(std::string_view name, std::string_view more = "") {
  return std::string{name} + "{service=\"trajectory_planning\""
         + std::string{more} + "}";
}

messages::event_record event(messages::event_type what,
                             std::string detail = {}) {
  return {.what = what,
          .station = session.station,
          .provider = session.provider,
          .service = planning,
          .detail = std::move(detail)};
}

messages::cycle_record result(duration latency, bool used) {
  const time_point sent{10s};
  return {.session = session,
          .created = sent,
          .received = sent + latency,
          .interarrival = 50ms,
          .used = used,
          .timing = {.input_at = sent - 100ms}};
}

} // namespace

TEST_CASE("results are counted by their use, and into buckets of their times") {
  live_figures all{one_service(), "drive", {}};
  all.on_record(result(20ms, true));
  all.on_record(result(50ms, true));
  all.on_record(event(messages::event_type::result_refused,
                      "latency value_ms=61.2 limit_ms=50"));
  all.on_record(result(61ms, false));
  all.on_record(event(messages::event_type::clock_in_doubt));
  all.on_record(result(2s, false));
  all.on_record(event(messages::event_type::clock_known));
  all.on_record(result(30ms, false));
  auto x = samples_of(all);
  const auto results = [&x](const char* outcome) {
    return x[with_service("sofof_results_total",
                          std::string{",outcome=\""} + outcome + '"')];
  };
  CHECK(results("used") == "2");
  CHECK(results("late") == "1");
  CHECK(results("unknown") == "1");
  CHECK(results("other") == "1");
  const auto within = [&x](const char* limit) {
    return x[with_service("sofof_result_latency_seconds_bucket",
                          std::string{",le=\""} + limit + '"')];
  };
  CHECK(within("0.01") == "0");
  CHECK(within("0.02") == "1");
  CHECK(within("0.05") == "3"); // the limit itself is in time
  CHECK(within("0.075") == "4");
  CHECK(within("1.0") == "4");
  CHECK(within("+Inf") == "5");
  CHECK(x[with_service("sofof_result_latency_seconds_count")] == "5");
  CHECK(x[with_service("sofof_result_gap_seconds_sum")] == "0.25");
  CHECK(x[with_service("sofof_input_age_seconds_bucket", ",le=\"0.1\"")]
        == "0");
}

TEST_CASE("an offloading runs from the switch to the switch back") {
  live_figures all{one_service(), "drive", {}};
  auto there = event(messages::event_type::switched, "remote");
  there.remote = true;
  auto other = there;
  other.station = station_id{102};
  all.on_record(there);
  all.on_record(there); // to another provider
  all.on_record(other);
  CHECK(samples_of(all)[with_service("sofof_sessions")] == "2");
  all.on_record(event(messages::event_type::switched, "local"));
  CHECK(samples_of(all)[with_service("sofof_sessions")] == "1");
}

TEST_CASE("a provider counts what it has accepted, refused and ended") {
  live_figures all{one_service(), "provide", {}};
  all.on_record(messages::verdict_record{{}, session, true, {}});
  all.on_record(messages::verdict_record{{}, session, true, {}});
  all.on_record(messages::verdict_record{
      {}, session, false, "no room value=0.84 limit=0.8"});
  messages::episode_record end;
  end.session = session;
  end.of = messages::side::provider;
  end.reason = messages::end_reason::qos_gap;
  all.on_record(end);
  auto x = samples_of(all);
  CHECK(x[with_service("sofof_sessions")] == "1");
  CHECK(x[with_service("sofof_requests_total", ",verdict=\"accepted\"")]
        == "2");
  CHECK(x[with_service("sofof_requests_rejected_total", ",reason=\"no room\"")]
        == "1");
  CHECK(x[with_service("sofof_episodes_ended_total", ",reason=\"qos_gap\"")]
        == "1");
  CHECK(x["sofof_peers"] == "0");
  CHECK(x.count("sofof_vehicles") == 0);
}

TEST_CASE("where both sides are in one process, an offloading counts once") {
  live_figures all{one_service(), "run", {}};
  auto there = event(messages::event_type::switched, "remote");
  there.remote = true;
  all.on_record(messages::verdict_record{{}, session, true, {}});
  messages::decision_record decided;
  decided.station = session.station;
  decided.service = planning;
  decided.accepted = true;
  all.on_record(decided);
  all.on_record(there);
  const auto sessions = with_service("sofof_sessions");
  CHECK(samples_of(all)[sessions] == "1");
  CHECK(samples_of(
            all)[with_service("sofof_requests_total", ",verdict=\"accepted\"")]
        == "1");
  all.on_record(event(messages::event_type::switched, "local"));
  for (const auto of : {messages::side::provider, messages::side::requester}) {
    messages::episode_record end;
    end.session = session;
    end.of = of;
    all.on_record(end);
  }
  auto x = samples_of(all);
  CHECK(x[sessions] == "0");
  std::size_t ended = 0;
  for (const auto& [name, value] : x)
    if (name.starts_with("sofof_episodes_ended_total"))
      ended += std::stoul(value);
  CHECK(ended == 1);
}

TEST_CASE(
    "however many reasons there are, some are told and the rest together") {
  live_figures all{one_service(), "provide", {}};
  for (int i = 0; i < 100; ++i)
    all.on_record(messages::verdict_record{
        {}, session, false, "reason " + std::to_string(i)});
  all.on_record(messages::verdict_record{{}, session, false, "reason 3"});
  std::size_t names = 0, sum = 0;
  for (const auto& [name, value] : samples_of(all))
    if (name.starts_with("sofof_requests_rejected_total")) {
      ++names;
      sum += std::stoul(value);
    }
  CHECK(names == 24);
  CHECK(sum == 101);
  CHECK(samples_of(all)[with_service("sofof_requests_rejected_total",
                                     ",reason=\"reason 3\"")]
        == "2");
}

TEST_CASE("both formats name counters as they ask for, and end as they end") {
  live_figures all{one_service(), "drive", [](exposition& to) {
                     to.family("own", exposition::kind::gauge, "More.");
                     to.sample({{"x", "a\"b\\c\nd"}}, std::uint64_t{3});
                   }};
  const auto old = all.text(exposition_format::text);
  CHECK(contains(old, "# TYPE sofof_offers_total counter\n"));
  CHECK(contains(old, "\nsofof_offers_total 0\n"));
  CHECK(contains(old, "\nown{x=\"a\\\"b\\\\c\\nd\"} 3\n"));
  CHECK_FALSE(contains(old, "# EOF"));
  const auto open = all.text(exposition_format::openmetrics);
  CHECK(contains(open, "# TYPE sofof_offers counter\n"));
  CHECK(contains(open, "\nsofof_offers_total 0\n"));
  CHECK(contains(open, "# UNIT sofof_driven_seconds seconds\n"));
  CHECK(open.ends_with("# EOF\n"));
  CHECK(contains(open, "role=\"drive\""));
}

TEST_CASE("who asks for OpenMetrics gets it, and others the older format") {
  CHECK(format_for("") == exposition_format::text);
  CHECK(format_for("text/html,*/*") == exposition_format::text);
  CHECK(format_for("application/openmetrics-text;version=1.0.0,text/plain")
        == exposition_format::openmetrics);
}

} // namespace sofof::watched

// Measured round trips, to be replayed.
#include "channel/trace.hpp"

#include "tests/support/near.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

using namespace sofof;
using namespace sofof::channel;
using doctest::Approx;
using test::near;

namespace {

constexpr auto measured_trace = "pub_time(ms) sub_time(ms) delay(ms) utmX(m)\n"
                                "1721032372703 1721032372729 26 328977.51\n"
                                "1721032372758 1721032372779 21 328977.23 \n"
                                "\n"
                                "1721032372813 1721032372829 16 328976.90\r\n";

void check_refusal(std::string_view text, const char* sentence) {
  CHECK_THROWS_WITH_AS(parse_trace(text), sentence, std::invalid_argument);
}

} // namespace

TEST_CASE("a measured file becomes round trips since its first message") {
  const auto samples = parse_trace(measured_trace);
  REQUIRE(samples.size() == 3);
  CHECK(samples[0].at_s == 0);
  CHECK(samples[0].delay_s == Approx(0.026));
  CHECK(samples[2].at_s == Approx(0.110));
  CHECK(samples[2].delay_s == Approx(0.016));
}

TEST_CASE("a table of two columns is a trace, too") {
  const auto samples = parse_trace("time_s,delay_ms\n5,20\n5.5, 21.5");
  REQUIRE(samples.size() == 2);
  CHECK(samples[1].at_s == Approx(0.5));
  CHECK(samples[1].delay_s == Approx(0.0215));
}

TEST_CASE("a broken trace is refused with the line that broke it") {
  const auto header =
      "line 1: the header must begin with 'pub_time(ms) sub_time(ms) "
      "delay(ms)' or be 'time_s,delay_ms'";
  check_refusal("", header);
  check_refusal("time,rtt\n1,2\n", header);
  check_refusal("time_s,delay_ms\n", "line 1: no samples below the header");
  check_refusal("time_s,delay_ms\n1,2\n2\n", "line 3: a column is missing");
  check_refusal("time_s,delay_ms\n1,2x\n", "line 2: '2x' is not a number");
  check_refusal("time_s,delay_ms\n1,inf\n", "line 2: 'inf' is not a number");
  check_refusal("time_s,delay_ms\n1,-2\n", "line 2: the delay is negative");
  check_refusal("time_s,delay_ms\n\n1,2\n0,2\n",
                "line 4: the time is before that of the line above");
}

TEST_CASE("a replay takes the round trip measured nearest in time") {
  const auto samples = parse_trace("time_s,delay_ms\n0,10\n1,20\n3,30\n");
  CHECK(replayed_delay_s(samples, 0) == Approx(0.010));
  CHECK(replayed_delay_s(samples, 0.4) == Approx(0.010));
  CHECK(replayed_delay_s(samples, 0.6) == Approx(0.020));
  CHECK(replayed_delay_s(samples, 1.9) == Approx(0.020));
  CHECK(replayed_delay_s(samples, 2.1) == Approx(0.030));
  CHECK(replayed_delay_s(samples, 3) == Approx(0.030));
}

TEST_CASE("a replay begins again one mean spacing after its end") {
  const auto samples = parse_trace("time_s,delay_ms\n0,10\n1,20\n3,30\n");
  CHECK(replay_length_s(samples) == Approx(4.5));
  CHECK(replayed_delay_s(samples, 3.7) == Approx(0.030));
  CHECK(replayed_delay_s(samples, 3.8) == Approx(0.010));
  CHECK(replayed_delay_s(samples, 4.5 + 1) == Approx(0.020));
  CHECK(replayed_delay_s(samples, 45 + 2.9) == Approx(0.030));
}

TEST_CASE("a single sample is replayed for ever") {
  const auto samples = parse_trace("time_s,delay_ms\n7,10\n");
  CHECK(replayed_delay_s(samples, 0) == Approx(0.010));
  CHECK(replayed_delay_s(samples, 1e6) == Approx(0.010));
}

TEST_CASE("a long replay has the mean and the deviation of its samples") {
  // In the measured form: a message every 55 ms, 10 to 40 ms late.
  std::string text = "pub_time(ms) sub_time(ms) delay(ms)\n";
  double sum_ms = 0, squares_ms2 = 0;
  constexpr auto count = 1000;
  for (auto k = 0; k < count; ++k) {
    const auto delay_ms = 10 + (k * k) % 31;
    const auto sent_ms = 1721032372703 + 55LL * k;
    text += std::to_string(sent_ms) + ' ' + std::to_string(sent_ms + delay_ms)
            + ' ' + std::to_string(delay_ms) + '\n';
    sum_ms += delay_ms;
    squares_ms2 += delay_ms * delay_ms;
  }
  const auto samples = parse_trace(text);
  REQUIRE(samples.size() == count);
  double sum_s = 0, squares_s2 = 0;
  constexpr auto results = 200'000;
  for (auto i = 0; i < results; ++i) {
    const auto d_s = replayed_delay_s(samples, i * 0.05);
    sum_s += d_s;
    squares_s2 += d_s * d_s;
  }
  const auto mean_s = sum_s / results, mean_ms = sum_ms / count;
  CHECK(mean_s == near(1e-3 * mean_ms, 1e-3));
  CHECK(
      std::sqrt(squares_s2 / results - mean_s * mean_s)
      == near(1e-3 * std::sqrt(squares_ms2 / count - mean_ms * mean_ms), 1e-2));
}

TEST_CASE("the measured 5G drives can be read and replayed") {
  const auto folder =
      std::filesystem::path{SOFOF_SOURCE_DIR} / "../shared/data/latency_5g";
  if (!std::filesystem::exists(folder)) {
    MESSAGE("SKIPPED: no measured drives at " << folder.string());
    return;
  }
  std::ifstream file{folder / "urban_n78_v20_run01.txt"};
  const std::string text{std::istreambuf_iterator{file}, {}};
  const auto samples = parse_trace(text);
  CHECK(samples.size() == 6217);
  // Mean and deviation of the file's third column: 16.26 ± 6.57 ms.
  double sum = 0;
  double squares = 0;
  constexpr auto results = 200'000;
  for (auto i = 0; i < results; ++i) {
    const auto d = replayed_delay_s(samples, i * 0.05);
    sum += d;
    squares += d * d;
  }
  const auto mean = sum / results;
  CHECK(mean == near(16.26e-3, 0.02));
  CHECK(std::sqrt(squares / results - mean * mean) == near(6.57e-3, 0.1));
}

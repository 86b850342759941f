// Tests of payloads and their bytes: what goes in comes out, as a value and
// as bytes, and strangers' bytes do no harm.
#include "messages/protocol/payload.hpp"

#include "actors/services/planning/plan_request.hpp"
#include "tests/messages/random_messages.hpp"
#include "tests/messages/wire.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <optional>
#include <string>
#include <vector>

using namespace sofof;
using namespace sofof::actors;
using namespace sofof::messages;
using namespace sofof::planners;
using namespace sofof::test;
using namespace sofof::world;

namespace {

/// One member of every kind that can be written.
struct everything {
  bool flag = false;
  std::uint8_t small = 0;
  std::int64_t big = 0;
  double number = 0;
  side enumeration = side::requester;
  duration length{};
  time_point moment;
  std::string text;
  std::optional<double> maybe;
  std::vector<point> line;
  std::vector<std::string> words;

  friend bool operator==(const everything&, const everything&) = default;
};

void visit_fields(auto& v, everything& x) {
  v("flag", x.flag);
  v("small", x.small);
  v("big", x.big);
  v("number", x.number);
  v("enumeration", x.enumeration);
  v("length", x.length);
  v("moment", x.moment);
  v("text", x.text);
  v("maybe", x.maybe);
  v("line", x.line);
  v("words", x.words);
}

everything random_everything(filler& random) {
  everything x;
  random.fill(x.flag);
  random.fill(x.small);
  random.fill(x.big);
  random.fill(x.number);
  random.fill(x.length);
  random.fill(x.moment);
  random.fill(x.text);
  random.fill(x.maybe);
  random.fill(x.line);
  random.fill(x.words);
  return x;
}

std::vector<std::byte> write(const everything& x) {
  byte_writer out;
  out(x);
  return out.take();
}

/// A payload as it arrives from another process.
payload arrived(std::string type, std::vector<std::byte> bytes) {
  caf::byte_buffer wire;
  caf::binary_serializer sink{nullptr, wire};
  REQUIRE(sink.apply(type));
  REQUIRE(sink.apply(bytes));
  const auto p = load<payload>(wire);
  REQUIRE(p);
  return *p;
}

} // namespace

// -- payload -----------------------------------------------------------------

TEST_CASE("inside a process a payload is the very same value") {
  const auto p = payload::of(echo{5});
  const auto copy = p;
  REQUIRE(p.as<echo>());
  CHECK(p.as<echo>()->number == 5);
  CHECK(copy.as<echo>() == p.as<echo>());
  CHECK(p.type() == "echo");
}

TEST_CASE("between processes a payload is bytes, and the same again") {
  const auto p = load<payload>(save(payload::of(echo{5})));
  REQUIRE(p);
  CHECK(p->type() == "echo");
  REQUIRE(p->as<echo>());
  CHECK(p->as<echo>()->number == 5);
  const auto forwarded = load<payload>(save(*p));
  REQUIRE(forwarded);
  CHECK(forwarded->as<echo>()->number == 5);
}

TEST_CASE("a payload of another type is none") {
  CHECK(!payload::of(echo{5}).as<trajectory>());
  CHECK(!load<payload>(save(payload::of(echo{5})))->as<trajectory>());
}

TEST_CASE("no payload has no type and is nothing") {
  CHECK(payload{}.type().empty());
  CHECK(!payload{}.as<echo>());
  CHECK(payload{}.encoded().empty());
  CHECK(load<payload>(save(payload{}))->type().empty());
}

TEST_CASE("a payload with too few or too many bytes is none") {
  const auto good = payload::of(echo{5}).encoded();
  REQUIRE(arrived("echo", good).as<echo>());
  for (std::size_t n = 0; n < good.size(); ++n)
    CHECK(!arrived("echo", {good.data(), good.data() + n}).as<echo>());
  auto longer = good;
  longer.push_back(std::byte{0});
  CHECK(!arrived("echo", longer).as<echo>());
}

TEST_CASE("a plan and a request for one arrive as they were sent") {
  trajectory sent{time_point{duration{7}}, {}};
  for (int k = 0; k < 60; ++k)
    sent.points.push_back({0.1 * k, 1.0 * k, {2.0 * k, 3.0 * k}, 4, 5, 6, 7});
  const auto there = arrived("trajectory", payload::of(sent).encoded());
  const auto got = there.as<trajectory>();
  REQUIRE(got);
  CHECK(got->start == sent.start);
  REQUIRE(got->points.size() == 60);
  CHECK(there.encoded() == payload::of(sent).encoded());
  CHECK(got->points[3].at == point{6, 9});

  plan_request ask{"street",
                   {time_point{duration{9}}, 1, 2, 3, 4, 5, 6, {}},
                   {},
                   {101, time_point{duration{9}}, {1, 2}, 3, 4, 5, 6}};
  ask.seen = {time_point{duration{8}}, 5.0, {{{1, 2}, 3, 4, 5, 6, 7}}};
  const auto asked = arrived("plan_request", payload::of(ask).encoded());
  REQUIRE(asked.as<plan_request>());
  CHECK(asked.as<plan_request>()->way == "street");
  CHECK(asked.as<plan_request>()->from.d_m == 2);
  CHECK(same(asked.as<plan_request>()->own, ask.own));
  CHECK(asked.as<plan_request>()->seen.at == ask.seen.at);
  CHECK(asked.as<plan_request>()->seen.stop_at_m == 5.0);
  REQUIRE(asked.as<plan_request>()->seen.objects.size() == 1);
  CHECK(same(asked.as<plan_request>()->seen.objects, ask.seen.objects));

  plan_report report;
  report.emergency = true;
  report.iterations = 12;
  report.input = time_point{duration{5}};
  const auto about = arrived("plan_report", payload::of(report).encoded());
  REQUIRE(about.as<plan_report>());
  CHECK(about.as<plan_report>()->emergency);
  CHECK(about.as<plan_report>()->iterations == 12);
  CHECK(about.as<plan_report>()->input == report.input);
}

TEST_CASE("an ITS message arrives as it was sent, and is nothing else") {
  const its_pdu pdu{{std::byte{2}, std::byte{20}}};
  const auto there = arrived("its_pdu", payload::of(pdu).encoded());
  REQUIRE(there.as<its_pdu>());
  CHECK(there.as<its_pdu>()->octets == pdu.octets);
  CHECK(!there.as<trajectory>());
}

// -- bytes -------------------------------------------------------------------

TEST_CASE("what was written is read, to the last byte") {
  filler random{1};
  for (int k = 0; k < 500; ++k) {
    const auto x = random_everything(random);
    const auto bytes = write(x);
    everything y;
    byte_reader in{bytes};
    in(y);
    CHECK(in.done());
    CHECK(y == x);
  }
}

TEST_CASE("bytes are little-endian and without padding") {
  byte_writer out;
  out(std::uint8_t{1}, std::uint32_t{0x05040302}, true, std::string{"ab"});
  const auto bytes = out.take();
  std::vector<int> numbers;
  for (const auto b : bytes)
    numbers.push_back(std::to_integer<int>(b));
  CHECK(numbers == std::vector<int>{1, 2, 3, 4, 5, 1, 2, 0, 0, 0, 'a', 'b'});
}

TEST_CASE("bytes that were cut off do not read, wherever the cut is") {
  filler random{2};
  for (int k = 0; k < 50; ++k) {
    auto bytes = write(random_everything(random));
    while (!bytes.empty()) {
      bytes.pop_back();
      everything y;
      byte_reader in{bytes};
      in(y);
      REQUIRE(!in.ok());
      REQUIRE(!in.done());
    }
  }
}

TEST_CASE("after the first misfit everything reads as zero") {
  const std::vector<std::byte> bytes(6, std::byte{0xff});
  byte_reader in{bytes};
  std::uint32_t first = 1;
  double second = 1;
  std::uint8_t third = 1;
  bool flag = true;
  std::string text = "x";
  std::optional<double> maybe = 1.0;
  std::vector<point> line(3);
  in(first, second, third, flag, text, maybe, line);
  CHECK(first == 0xffffffff);
  CHECK(!in.ok());
  CHECK(second == 0);
  CHECK(third == 0);
  CHECK(!flag);
  CHECK(text.empty());
  CHECK(!maybe);
  CHECK(line.empty());
}

TEST_CASE("bytes left over are noticed") {
  auto bytes = write({});
  bytes.push_back(std::byte{0});
  everything y;
  byte_reader in{bytes};
  in(y);
  CHECK(in.ok());
  CHECK(!in.done());
}

TEST_CASE("what is neither true nor false does not read") {
  for (int value = 0; value < 256; ++value) {
    const std::vector bytes{static_cast<std::byte>(value)};
    bool flag = false;
    byte_reader in{bytes};
    in(flag);
    CHECK(in.ok() == (value <= 1));
    CHECK(flag == (value == 1));
  }
}

TEST_CASE("a list that claims to be endless is refused before any of it is "
          "made") {
  const std::vector<std::byte> bytes(20, std::byte{0xff});
  byte_reader in{bytes};
  std::vector<point> line;
  in(line);
  CHECK(!in.ok());
  CHECK(line.capacity() == 0);
  byte_reader again{bytes};
  std::string text;
  again(text);
  CHECK(!again.ok());
}

TEST_CASE("whatever bytes come, they read as something or not at all") {
  filler random{3};
  int read = 0;
  for (int k = 0; k < 20000; ++k) {
    auto bytes = write(random_everything(random));
    for (auto flips = random.below(3) + 1; flips > 0; --flips)
      bytes[random.below(bytes.size())] =
          static_cast<std::byte>(random.below(256));
    everything y;
    byte_reader in{bytes};
    in(y);
    if (!in.done())
      continue;
    ++read;
    CHECK(write(y) == bytes);
  }
  CHECK(read > 1000);
  CHECK(read < 19000);
}

TEST_CASE("whatever bytes come, they are a plan or none") {
  filler random{4};
  trajectory plan;
  plan.points.resize(10);
  const auto good = payload::of(plan).encoded();
  for (int k = 0; k < 5000; ++k) {
    auto bytes = good;
    bytes.resize(random.below(good.size() + 10));
    for (auto flips = random.below(10); flips > 0 && !bytes.empty(); --flips)
      bytes[random.below(bytes.size())] =
          static_cast<std::byte>(random.below(256));
    const auto p = arrived("trajectory", bytes);
    if (p.as<trajectory>())
      CHECK(p.encoded().size() == bytes.size());
  }
}

TEST_CASE("times that could overflow a difference are refused") {
  for (const auto count : {std::numeric_limits<duration::rep>::min(),
                           std::numeric_limits<duration::rep>::max()}) {
    byte_writer out;
    out(time_point{duration{count}});
    const auto bytes = out.take();
    byte_reader in{bytes};
    time_point t;
    in(t);
    CHECK(!in.ok());
  }
}

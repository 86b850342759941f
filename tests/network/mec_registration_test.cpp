// A provider's entry in a registry, from its first moment to its last.
#include "network/mec/registration.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/mock_registry.hpp"

#include <doctest/doctest.h>

#include <chrono>
#include <optional>
#include <string>
#include <vector>

namespace sofof::test::provider_entries {

using namespace network::mec011;
using namespace std::chrono_literals;

namespace {

/// A provider that a registry shall list; whoever tests it makes its steps.
struct listed {
  std::vector<registry_news> news;
  registration entry;

  explicit listed(const std::string& root,
                  const std::string& application = "sofof-mec")
      : entry{registry{parse_root(root)},
              application,
              {.version = "10",
               .provider = "mec",
               .addresses = {{"10.0.0.5", 4711}}},
              random_stream{1, "test"},
              [this](const auto& x) { news.push_back(x); }} {}

  std::string last() const { return news.empty() ? "" : news.back().sentence; }
};

} // namespace

TEST_CASE("a registry lists a provider once it is told, and that it is ready") {
  const mock_registry at;
  listed mec{at.root()};
  CHECK(mec.entry.step() == 5s);
  REQUIRE(at.services().size() == 1);
  const auto entry = at.services().front();
  CHECK(entry["state"] == "ACTIVE");
  CHECK(entry["transportInfo"]["endpoint"]["addresses"][0]["host"]
        == "10.0.0.5");
  CHECK(at.times("confirm_ready 204") == 1);
  CHECK(mec.last()
        == "provider mec is in the registry " + at.root() + " as service s-1");
  for (int i = 0; i < 3; ++i)
    mec.entry.step();
  CHECK(mec.news.size() == 1);
  CHECK(at.times("POST") == 2);
}

TEST_CASE("a provider that ends is INACTIVE, and leaves nothing else") {
  const mock_registry at;
  listed mec{at.root()};
  mec.entry.step();
  mec.entry.end();
  REQUIRE(at.services().size() == 1);
  CHECK(at.services().front()["state"] == "INACTIVE");
  CHECK(contains(mec.last(), "no longer ACTIVE"));
  listed again{at.root()};
  again.entry.step();
  REQUIRE(at.services().size() == 1);
  CHECK(at.services().front()["state"] == "ACTIVE");
  CHECK(at.services().front()["serInstanceId"] == "s-2");
}

TEST_CASE("what a killed process of the provider has left is removed, what "
          "others have told stays") {
  mock_registry at;
  (void)at.list(service_of("mec", 1));
  (void)at.list(service_of("other", 2));
  listed mec{at.root()};
  mec.entry.step();
  CHECK(at.times("DELETE") == 1);
  CHECK(at.services().size() == 2);
}

TEST_CASE("where states cannot be changed the entry is removed") {
  mock_registry at;
  listed mec{at.root()};
  mec.entry.step();
  at.be(registry_mood::immutable);
  mec.entry.end();
  CHECK(at.services().empty());
}

TEST_CASE("a registry that is down is asked again with pauses that grow, and "
          "told of once") {
  std::optional<mock_registry> at{std::in_place};
  const auto port = at->address().port;
  listed mec{at->root()};
  at.reset();
  duration longest{};
  for (int i = 0; i < 12; ++i) {
    const auto pause = mec.entry.step();
    CHECK(pause >= 250ms);
    CHECK(pause <= 10s);
    longest = std::max(longest, pause);
  }
  CHECK(longest > 5s);
  CHECK(mec.news.size() == 1);
  CHECK(!mec.news.front().is_well);
  CHECK(contains(mec.last(), "does not keep provider mec"));
  CHECK(contains(mec.last(), "trying again"));
  mec.entry.end(); // nothing to take back
  at.emplace(port);
  CHECK(mec.entry.step() == 5s);
  CHECK(at->services().size() == 1);
  CHECK(mec.news.back().is_well);
}

TEST_CASE("an entry that the registry has lost is added again") {
  mock_registry at;
  listed mec{at.root()};
  mec.entry.step();
  at.forget();
  mec.entry.step();
  CHECK(at.services().size() == 1);
  CHECK(at.times("confirm_ready 204") == 2);
  CHECK(contains(mec.last(), "as service s-2"));
}

TEST_CASE("wrong answers change nothing, and are told in a sentence") {
  using enum registry_mood;
  const std::vector<std::pair<registry_mood, std::string>> all = {
      {garbage, "not understood: it is no JSON"},
      {huge, "does not answer: body limit exceeded"},
      {redirects, "status 302"},
      {broken, "status 500: no disk?[2J"},
      {silent, "has not answered within 1000 ms"}};
  for (const auto& [mood, why] : all) {
    mock_registry at;
    listed mec{at.root()};
    mec.entry.step();
    at.be(mood);
    mec.entry.step();
    CHECK(mec.entry.step() < 5s);
    CAPTURE(mec.last());
    CHECK(contains(mec.last(), why));
    CHECK(mec.news.size() == 2);
    at.be(well);
    CHECK(mec.entry.step() == 5s);
    CHECK(at.services().size() == 1);
    CHECK(mec.news.back().is_well);
  }
}

TEST_CASE("a platform that does not know the application says so") {
  const mock_registry at;
  listed mec{at.root(), "nobody"};
  mec.entry.step();
  CHECK(contains(mec.last(), "status 404: no such resource"));
}

TEST_CASE("a registry speaks HTTP, at a host, a port and a path") {
  const auto root = [](const char* text) {
    try {
      return print_root(parse_root(text));
    } catch (const network::network_error& problem) {
      return std::string{problem.what()};
    }
  };
  CHECK(root("http://10.0.0.9:8080/mep/") == "http://10.0.0.9:8080/mep");
  CHECK(root("http://mep.example") == "http://mep.example:80");
  CHECK(contains(root("https://mep.example"), "wants TLS"));
  for (const auto* wrong : {"", "mep.example:80", "ftp://x", "http://x:0",
                            "http://x/?a=b", "http://x/#a", "http://x?a=b"})
    CHECK(contains(root(wrong), "is no URL of a registry"));
}

} // namespace sofof::test::provider_entries

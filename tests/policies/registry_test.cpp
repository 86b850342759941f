// Tests of the policies by name, and of those that need no thought.
#include "policies/registry.hpp"

#include "tests/support/decisions.hpp"
#include "tests/support/option_list.hpp"

#include <doctest/doctest.h>

#include <algorithm>

using namespace sofof;
using namespace sofof::policies;
using test::goes_to;
using test::is_accepted;

namespace {

template <class Names>
bool has(const Names& names, std::string_view name) {
  return std::ranges::find(names, name) != names.end();
}

bool request(local_policy& lodm) {
  const std::vector<point> path{{1e6, 0}};
  const std::vector<provider_view> one{{7, {}, 0}};
  return goes_to(lodm.decide({time_point{}, "any", one, path, 10})) == 7;
}

std::vector<central_decision> decide(central_policy& codm) {
  const std::vector<point> route{{1e6, 0}};
  const std::vector<request_view> requests{{101, "one", route, 10, 0},
                                           {101, "two", route, 10, 0}};
  return codm.decide({time_point{}, requests, {}, 0, 1, {}, {}});
}

} // namespace

TEST_CASE("every listed policy can be made, and knows its name") {
  for (const auto name : lodm_names()) {
    CAPTURE(name);
    REQUIRE(make_lodm(name));
    CHECK(make_lodm(name)->name() == name);
    CHECK(make_lodm(name)->clone()->name() == name);
  }
  for (const auto name : codm_names()) {
    CAPTURE(name);
    REQUIRE(make_codm(name));
    CHECK(make_codm(name)->name() == name);
    CHECK(make_codm(name)->clone()->name() == name);
  }
}

TEST_CASE("the paper's policies and the baselines are there") {
  for (const auto name : {"location", "always", "never"}) {
    CHECK(has(lodm_names(), name));
    CHECK(has(codm_names(), name));
  }
}

TEST_CASE("there is no policy of an unknown name") {
  for (const auto name : {"", "Location", "sometimes"}) {
    CHECK(!make_lodm(name));
    CHECK(!make_codm(name));
  }
}

TEST_CASE("every policy's defaults are within their ranges") {
  for (const auto name : lodm_names()) {
    test::option_list options;
    make_lodm(name)->visit_options(options);
    CHECK(options.refused.empty());
  }
  for (const auto name : codm_names()) {
    test::option_list options;
    make_codm(name)->visit_options(options);
    CHECK(options.refused.empty());
  }
}

TEST_CASE("always is always yes, never is never yes") {
  CHECK(request(*make_lodm("always")));
  CHECK(!request(*make_lodm("never")));
  const auto yes = decide(*make_codm("always"));
  const auto no = decide(*make_codm("never"));
  REQUIRE(yes.size() == 2);
  REQUIRE(no.size() == 2);
  for (std::size_t k = 0; k < 2; ++k) {
    CHECK(is_accepted(yes[k]));
    CHECK(!is_accepted(no[k]));
  }
}

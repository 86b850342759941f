// Tests of the names of services: their length and how they travel.
#include "messages/protocol/service_name.hpp"

#include "tests/messages/random_messages.hpp"
#include "tests/messages/wire.hpp"

#include <doctest/doctest.h>

#include <string>

using namespace sofof;
using namespace sofof::messages;
using namespace sofof::test;

TEST_CASE("a service's name has 31 characters at most") {
  const std::string longest(31, 'x');
  CHECK(service_name{longest}.view() == longest);
  CHECK_THROWS_AS(service_name{longest + "x"}, std::invalid_argument);
  CHECK(service_name{}.view().empty());
  CHECK(service_name{""} == service_name{});
}

TEST_CASE("service names are equal when their letters are") {
  CHECK(service_name{"cabin_climate"} == service_name{"cabin_climate"});
  CHECK(service_name{"cabin"} != service_name{"cabin_climate"});
  CHECK(service_name{"cabin"} < service_name{"cabin_climate"});
  auto reused = service_name{"cabin_climate"};
  reused = service_name{"cabin"};
  CHECK(reused == service_name{"cabin"});
}

TEST_CASE("a service's name travels as text") {
  const std::string longest(31, 'x');
  CHECK(save(service_name{longest}) == save(longest));
  CHECK(load<service_name>(save(longest)) == service_name{longest});
}

TEST_CASE("a name that is too long is refused on arrival") {
  CHECK(!load<service_name>(save(std::string(32, 'x'))));
  CHECK(!load<service_name>(save(std::string(10000, 'x'))));
}

TEST_CASE("a name that hides something behind its end is refused on arrival") {
  using namespace std::string_literals;
  CHECK(!load<service_name>(save("one\0two"s)));
  CHECK(!load<service_name>(save("\0"s)));
}

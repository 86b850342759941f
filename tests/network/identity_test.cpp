// Lists of stations, and identities as URIs.
#include "network/keys/identity.hpp"

#include "network/keys/station_list.hpp"

#include <doctest/doctest.h>

using namespace sofof;
using namespace sofof::network;

TEST_CASE("a list of stations has numbers and ranges") {
  CHECK(parse_stations("7") == std::vector<station_id>{7});
  CHECK(parse_stations("110,101-103")
        == std::vector<station_id>{101, 102, 103, 110});
  CHECK(parse_stations("1-3,2-4") == std::vector<station_id>{1, 2, 3, 4});
  CHECK(parse_stations("4294967290-4294967295")->size() == 6);
  CHECK(parse_stations("1-10000")->size() == most_stations);
}

TEST_CASE("what is no list of stations is refused") {
  for (const auto* text : {"",
                           ",",
                           "1,",
                           ",1",
                           "1,,2",
                           "-",
                           "1-",
                           "-1",
                           "3-1",
                           "1-2-3",
                           "1 ",
                           " 1",
                           "+1",
                           "0",
                           "0-3",
                           "a",
                           "1.5",
                           "4294967296",
                           "1-10001",
                           "1-4294967295",
                           "1-6000,10000-16000"}) {
    CAPTURE(text);
    CHECK_FALSE(parse_stations(text));
  }
}

TEST_CASE("a list of stations is printed as short as it can be read") {
  for (const auto* text :
       {"7", "1-2", "101-106,110", "1,3,5,7-9", "4294967294-4294967295"}) {
    CAPTURE(text);
    CHECK(print_stations(parse_stations(text).value()) == text);
  }
  CHECK(print_stations({}) == "");
}

TEST_CASE("an identity is what its URIs say") {
  for (const auto& who : {peer_identity{{7}, {}},
                          {{101, 102, 103, 110}, {}},
                          {{}, "mec"},
                          {{}, "Ulm.Lehr-2_a"}}) {
    CAPTURE(describe(who));
    const auto uris = uris_of(who);
    CHECK(identity_of(uris) == who);
  }
  CHECK(uris_of({{101, 102, 110}, {}})
        == std::vector<std::string>{"urn:sofof:station:101-102",
                                    "urn:sofof:station:110"});
  CHECK(uris_of({{}, "mec"})
        == std::vector<std::string>{"urn:sofof:provider:mec"});
}

TEST_CASE("URIs of others do not count") {
  const std::vector<std::string> uris{"https://example.org",
                                      "urn:sofof:station:5", "urn:sofofa:x"};
  CHECK(identity_of(uris) == peer_identity{{5}, {}});
}

TEST_CASE("URIs that do not name exactly one kind of peer name nobody") {
  using list = std::vector<std::string>;
  for (const auto& uris : {list{},
                           {"https://example.org"},
                           {"urn:sofof:station:"},
                           {"urn:sofof:station:x"},
                           {"urn:sofof:station:5", "urn:sofof:station:"},
                           {"urn:sofof:station:5", "urn:sofof:provider:mec"},
                           {"urn:sofof:provider:mec", "urn:sofof:provider:mec"},
                           {"urn:sofof:provider:"},
                           {"urn:sofof:provider:a b"},
                           {"urn:sofof:provider:-a"},
                           {std::string{"urn:sofof:provider:a\0b", 23}},
                           {"urn:sofof:provider:" + std::string(64, 'a')},
                           {"urn:sofof:road:5"}}) {
    CAPTURE(uris);
    CHECK_FALSE(identity_of(uris));
  }
}

TEST_CASE("a peer speaks for its own stations only") {
  const peer_identity who{{101, 102, 110}, {}};
  CHECK(who.has(102));
  CHECK_FALSE(who.has(103));
  CHECK_FALSE(peer_identity{{}, "mec"}.has(101));
}

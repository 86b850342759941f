// Arguments and peers that cannot work: one sentence each, exit code 2.
#include "tests/processes/hosts.hpp"

using namespace sofof::test;

namespace {

/// @param said  What its sentence must contain.
void check_refused(const ending& end, const words& said) {
  CAPTURE(end.out);
  CAPTURE(end.err);
  CHECK(end.code == 2);
  CHECK(end.err.find('\n') + 1 == end.err.size());
  for (const auto& part : said) {
    CAPTURE(part);
    CHECK(end.err.find(part) != end.err.npos);
  }
}

} // namespace

TEST_CASE("a provider of another version refuses, and both are named") {
  const workplace at;
  provider_process provider{at, "provider", {}};
  check_refused(at.run_sofof(drive_words("drive", provider.port(),
                                         {"--test-protocol", "9"})),
                {"provider mec", "refuses", "protocol 9 ", "protocol 11 ",
                 "same version"});
  CHECK_FALSE(std::filesystem::exists(at / "drive")); // nothing has begun
  CHECK(provider.run().runs());
}

TEST_CASE("a provider with another map refuses") {
  const workplace at;
  at.write("config/maps/ulm_lehr.toml",
           read_file(at / "config/maps/ulm_lehr.toml") + "# other\n");
  provider_process provider{at, "provider", {}};
  std::filesystem::copy_file(std::filesystem::path{SOFOF_SOURCE_DIR}
                                 / "config/maps/ulm_lehr.toml",
                             at / "config/maps/ulm_lehr.toml",
                             std::filesystem::copy_options::overwrite_existing);
  check_refused(
      at.run_sofof(drive_words("drive", provider.port(), {})),
      {"provider mec", "refuses", "another map", "the same scenario file"});
  CHECK(stop(provider.run()).code == 0);
  CHECK(!events_of(provider.out(), "peer_refused").empty());
}

TEST_CASE("a provider with other services refuses") {
  const workplace at;
  provider_process provider{at, "provider", {}};
  auto fewer = read_file(at / scenario_file);
  fewer.resize(fewer.find("[[service]]\nname = \"cabin_climate\""));
  at.write(scenario_file, fewer);
  check_refused(at.run_sofof(drive_words("drive", provider.port(), {})),
                {"provider mec", "refuses", "other services"});
}

TEST_CASE("a port that is taken is refused") {
  const workplace at;
  provider_process provider{at, "provider", {}};
  const auto where = "127.0.0.1:" + std::to_string(provider.port());
  check_refused(at.run_sofof({"provide", scenario_file, "--out", "second",
                              "--listen", where}),
                {std::to_string(provider.port()), "--listen"});
  CHECK_FALSE(std::filesystem::exists(at / "second"));
}

TEST_CASE("wrong arguments of provide are refused") {
  for (const auto& [more, said] : std::vector<std::pair<words, words>>{
           {{"--listen", "here"}, {"'here'", "HOST:PORT"}},
           {{"--listen", "127.0.0.1"}, {"HOST:PORT"}},
           {{"--listen", "127.0.0.1:"}, {"HOST:PORT"}},
           {{"--listen", "127.0.0.1:70000"}, {"HOST:PORT"}},
           {{"--listen", "127.0.0.1:-1"}, {"HOST:PORT"}},
           {{"--listen", "::1:4711"}, {"HOST:PORT"}},
           {{"--listen", "0.0.0.0:0"}, {"--keys", "sofof keys"}},
           {{"--listen", "10.99.0.1:4711"}, {"--keys"}},
           {{"--listen", "127.0.0.1:0", "--name", "mac"}, {"'mac'", "mec"}},
           {{"--listen", "127.0.0.1:0", "--test-clock", "now"},
            {"--test-clock"}}}) {
    CAPTURE(more);
    const workplace at;
    check_refused(
        at.run_sofof(words{"provide", scenario_file, "--out", "out"} + more),
        said);
    CHECK_FALSE(std::filesystem::exists(at / "out"));
  }
}

TEST_CASE("wrong arguments of drive are refused") {
  for (const auto& [more, said] : std::vector<std::pair<words, words>>{
           {{"--provider", "there"}, {"'there'", "HOST:PORT"}},
           {{"--provider", "mec="}, {"HOST:PORT"}},
           {{"--provider", "127.0.0.1:4711x"}, {"HOST:PORT"}},
           {{"--provider", "mac=127.0.0.1:4711"}, {"'mac'", "mec"}},
           {{"--provider", "10.99.0.1:4711"}, {"--keys", "sofof keys"}},
           {{"--provider", "127.0.0.1:1", "--provider", "127.0.0.1:2"},
            {"mec", "twice"}},
           {{"--provider", "127.0.0.1:1", "--station", "107"},
            {"no station 107"}},
           {{"--provider", "127.0.0.1:1", "--station", "101-107"},
            {"no station 107"}},
           {{"--provider", "127.0.0.1:1", "--station", "all"},
            {"'all'", "101-106"}},
           {{"--provider", "127.0.0.1:1", "--keys", "nowhere"}, {"nowhere"}}}) {
    CAPTURE(more);
    const workplace at;
    check_refused(
        at.run_sofof(words{"drive", scenario_file, "--out", "out"} + more),
        said);
    CHECK_FALSE(std::filesystem::exists(at / "out"));
  }
}

TEST_CASE("vehicles need to know where a provider is") {
  const workplace at;
  const auto end = at.run_sofof({"drive", scenario_file});
  CHECK(end.code == 2);
  CHECK(end.err.find("--provider") != end.err.npos);
}

// `sofof keys`: a CA, its certificates, and what it does not do.
#include "tests/processes/workplace.hpp"
#include "tests/support/contains.hpp"

using namespace sofof::test;

TEST_CASE("a CA and its certificates are a command each") {
  const workplace at;
  const auto ca = at.run_sofof({"keys", "init", "keys"});
  CHECK(ca.code == 0);
  CHECK(ca.err == "");
  CHECK(contains(ca.out, "keys/ca.pem, keys/ca_key.pem: a new CA"));
  const auto provider =
      at.run_sofof({"keys", "issue", "keys", "--provider", "mec"});
  CHECK(provider.code == 0);
  CHECK(contains(provider.out, "keys/provider-mec: ca.pem, cert.pem, key.pem "
                               "for provider mec, valid for 825 days"));
  const auto car =
      at.run_sofof({"keys", "issue", "keys", "--station", "101-106,110",
                    "--days", "30", "--out", "car"});
  CHECK(car.code == 0);
  CHECK(contains(car.out, "car: ca.pem, cert.pem, key.pem for stations "
                          "101-106,110, valid for 30 days"));
  for (const auto* file :
       {"keys/provider-mec/key.pem", "car/ca.pem", "car/cert.pem"})
    CHECK(read_file(at / file).starts_with("-----BEGIN "));
}

TEST_CASE("keys that cannot be made are refused") {
  const workplace at;
  REQUIRE(at.run_sofof({"keys", "init", "keys"}).code == 0);
  const auto before = at.inventory();
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"keys"},
        {"keys", "init"},
        {"keys", "init", "keys"},
        {"keys", "issue", "keys"},
        {"keys", "issue", "keys", "--station", "1", "--provider", "mec"},
        {"keys", "issue", "keys", "--station", "x"},
        {"keys", "issue", "keys", "--provider", "a/b"},
        {"keys", "issue", "keys", "--provider", "mec", "--days", "0"},
        {"keys", "issue", "keys", "--provider", "mec", "--days", "x"},
        {"keys", "issue", "config", "--provider", "mec"},
        {"keys", "renew", "keys"},
        {"keys", "renew", "keys", "config"},
        {"keys", "revoke", "keys"},
        {"keys", "revoke", "keys", "--station", "1"},
        {"keys", "revoke", "keys", "--serial", "xyz"},
        {"keys", "revoke", "config", "--serial", "01"}}) {
    CAPTURE(words);
    const auto end = at.run_sofof(words);
    CHECK(end.code == 2);
    CHECK(end.out == "");
    CHECK(end.err != "");
  }
  CHECK(at.inventory() == before);
}

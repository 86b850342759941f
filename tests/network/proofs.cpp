// Who proves to be whom with a certificate and a signature.
#include "network/keys/nonce.hpp"
#include "network/network_error.hpp"
#include "tests/network/key_folder.hpp"
#include "tests/support/contains.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <set>
#include <string>

using namespace sofof;
using namespace sofof::network;
using namespace sofof::test;

namespace {

const std::vector<std::byte> nonce(32, std::byte{42});

} // namespace

TEST_CASE("who signs a nonce proves to be whom the certificate names") {
  const key_folder keys;
  const auto provider = keys.credentials_for(mec);
  const auto vehicle = keys.credentials_for(car);
  const auto one =
      provider.prove(vehicle.certificate_pem(), nonce, vehicle.sign(nonce));
  CHECK(one.who == car);
  CHECK(one.refusal == "");
  CHECK(
      vehicle.prove(provider.certificate_pem(), nonce, provider.sign(nonce)).who
      == mec);
  CHECK(provider.prove(vehicle.certificate_pem(), {}, vehicle.sign({})).who
        == car);
}

TEST_CASE("no nonce comes twice, and each is of 32 octets") {
  std::set<std::string> drawn;
  for (int k = 0; k < 1000; ++k) {
    const auto one = draw_nonce();
    CHECK(one.size() == 32);
    CHECK(drawn.insert(one).second);
  }
}

TEST_CASE("a signature over other bytes, or by another key, proves nothing") {
  const key_folder keys;
  const auto provider = keys.credentials_for(mec);
  const auto vehicle = keys.credentials_for(car);
  const auto thief = keys.credentials_for({{666}, {}});
  auto other = nonce;
  other[0] ^= std::byte{1};
  for (const auto& signature :
       {vehicle.sign(other), thief.sign(nonce), std::vector<std::byte>{},
        std::vector<std::byte>(72, std::byte{0x30})}) {
    const auto refused =
        provider.prove(vehicle.certificate_pem(), nonce, signature);
    CHECK_FALSE(refused.who);
    CHECK(contains(refused.refusal, "signature is not that of"));
  }
}

TEST_CASE("a certificate of another CA, or out of its days, proves nothing") {
  const key_folder keys;
  const key_folder others;
  const auto provider = keys.credentials_for(mec);
  const auto stranger = others.credentials_for(car);
  CHECK(provider.prove(stranger.certificate_pem(), nonce, stranger.sign(nonce))
            .refusal
        == "the certificate is not signed by this CA");
  const auto folder = keys.issue(car);
  const credentials vehicle{folder};
  keys.alter(folder, expire);
  const auto late = provider.prove(read_file(folder / "cert.pem"), nonce,
                                   vehicle.sign(nonce));
  CHECK_FALSE(late.who);
  CHECK(contains(late.refusal, "the certificate has expired on 20"));
  keys.alter(folder, [](X509& certificate) {
    ASN1_TIME_set_string_X509(X509_getm_notBefore(&certificate),
                              "20200101000000Z");
    ASN1_TIME_set_string_X509(X509_getm_notAfter(&certificate),
                              "20200229123000Z");
  });
  CHECK(contains(
      provider.prove(read_file(folder / "cert.pem"), nonce, vehicle.sign(nonce))
          .refusal,
      "the certificate has expired on 2020-02-29 12:30 UTC"));
}

TEST_CASE("what is too long is not looked at") {
  const key_folder keys;
  const auto own = keys.credentials_for(car);
  const auto& pem = own.certificate_pem();
  const auto signature = own.sign(nonce);
  const std::vector<std::byte> huge(credentials::most_signed + 1);
  CHECK(
      own.prove(pem + std::string(largest_certificate, '\n'), nonce, signature)
          .refusal
      == "the proof is too long");
  CHECK(own.prove(pem, huge, signature).refusal == "the proof is too long");
  CHECK(own.prove(pem, nonce, huge).refusal == "the proof is too long");
  CHECK_THROWS_AS((void)own.sign(huge), network_error);
}

TEST_CASE("a damaged certificate does no harm and proves nothing") {
  const key_folder keys;
  const auto provider = keys.credentials_for(mec);
  const auto vehicle = keys.credentials_for(car);
  const auto signature = vehicle.sign(nonce);
  const auto& good = vehicle.certificate_pem();
  test::dice dice{1};
  for (int round = 0; round < 500; ++round) {
    auto pem = good;
    const auto at = static_cast<std::size_t>(
        dice.between(0, static_cast<double>(pem.size())));
    pem[at] = static_cast<char>(dice.between(-128, 128));
    if (pem == good)
      continue;
    const auto [who, refusal] = provider.prove(pem, nonce, signature);
    // Some changes lie outside of what counts, e.g. in a line's end.
    CHECK((who == car) != !refusal.empty());
  }
}

// Credentials that change while lines are open.
#include "network/keys/key_ring.hpp"
#include "network/network_error.hpp"
#include "tests/network/two_hosts.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <list>

using namespace sofof;
using namespace sofof::network;
using namespace sofof::test;
namespace fs = std::filesystem;

namespace {

std::string serial_in(const fs::path& folder) {
  return serial_of(*certificate_from_pem(read_file(folder / "cert.pem")));
}

/// Lets a key folder trust the CAs of another one as well.
void add_authorities(const fs::path& folder, const key_folder& other) {
  write_text(folder / "ca.pem",
             read_file(folder / "ca.pem") + read_file(other.path() / "ca.pem"));
}

/// A vehicle's host with a line to a port.
struct car_host {
  car_host(const fs::path& folder, std::uint16_t port)
      : own{folder}, connector{&own, connector_to(port)},
        line{plug_into(connector.port())} {}

  credentials own;
  tls_connector connector;
  plug line;
};

/// A provider's acceptor with a thief inside, whose certificate it revokes.
struct door_with_thief {
  door_with_thief() { REQUIRE(echoes(thief.line, "thief")); }

  void revoke() {
    write_text(provider / "revoked", "# lost\n" + serial_in(stolen) + "\n");
    acceptor.renew(credentials{provider});
  }

  key_folder keys;
  server inner{echo};
  sentences heard;
  fs::path provider = keys.issue(mec);
  fs::path stolen = keys.issue(car);
  tls_acceptor acceptor{credentials{provider},
                        acceptor_to(inner.port(), &heard)};
  car_host thief{stolen, acceptor.port()};
};

} // namespace

TEST_CASE_FIXTURE(door_with_thief,
                  "a revoked peer's line is closed at once, and no other") {
  const car_host honest{keys.issue(car), acceptor.port()};
  REQUIRE(echoes(honest.line, "honest"));

  const auto begun = std::chrono::steady_clock::now();
  revoke();
  CHECK(thief.line.is_closed());
  CHECK(std::chrono::steady_clock::now() - begun < 1s);
  CHECK(heard.heard("stations 101-102, was disconnected: its certificate has "
                    "been revoked"));
  CHECK(echoes(honest.line, "still here"));

  CHECK(plug_into(thief.connector.port()).is_closed());
  CHECK(heard.heard("was refused: its certificate has been revoked"));
  CHECK(wait_until([&] {
    return contains(thief.connector.last_error(),
                    "our certificate has been revoked");
  }));
  CHECK(echoes(plug_into(honest.connector.port()), "and again"));
}

TEST_CASE_FIXTURE(door_with_thief,
                  "strangers that are refused do not hide who was revoked") {
  const auto knock = [this] {
    auto stranger = plug_into(acceptor.port());
    stranger.send("no TLS");
    CHECK(stranger.is_closed());
  };

  knock();
  revoke();
  CHECK(thief.line.is_closed());
  knock();
  CHECK(heard.heard("stations 101-102, was disconnected: its certificate has "
                    "been revoked"));
}

TEST_CASE("vehicles leave a provider that is revoked") {
  const key_folder keys;
  server inner{echo};
  const auto provider = keys.issue(mec);
  const auto folder = keys.issue(car);
  const tls_acceptor acceptor{credentials{provider}, acceptor_to(inner.port())};
  car_host vehicle{folder, acceptor.port()};
  REQUIRE(echoes(vehicle.line, "here"));
  write_text(folder / "revoked", serial_in(provider));
  vehicle.connector.renew(credentials{folder});
  CHECK(vehicle.line.is_closed());
  CHECK(contains(vehicle.connector.last_error(),
                 "its certificate has been revoked"));
  CHECK(plug_into(vehicle.connector.port()).is_closed());
}

TEST_CASE("a line does not outlive the certificate of either side") {
  const key_folder keys;
  server inner{echo};
  sentences heard;
  constexpr long left_s = 3;
  const auto shorten = [&](const fs::path& folder) {
    keys.alter(folder, [](X509& x) {
      X509_gmtime_adj(X509_getm_notAfter(&x), left_s);
    });
    return folder;
  };
  const tls_acceptor lasting{keys.credentials_for(mec),
                             acceptor_to(inner.port(), &heard)};
  const tls_acceptor ending{credentials{shorten(keys.issue(mec))},
                            acceptor_to(inner.port())};
  const car_host old_car{shorten(keys.issue(car)), lasting.port()};
  const car_host new_car{keys.issue(car), lasting.port()};
  const car_host car_at_old{keys.issue(car), ending.port()};
  for (const auto* host : {&old_car, &new_car, &car_at_old})
    REQUIRE(echoes(host->line, "in time"));
  CHECK(old_car.line.is_closed());
  CHECK(heard.heard("was disconnected: its certificate has expired"));
  CHECK(car_at_old.line.is_closed());
  CHECK(contains(car_at_old.connector.last_error(),
                 "its certificate has expired"));
  CHECK(echoes(new_car.line, "longer"));
}

TEST_CASE("twenty renewals end no line") {
  const key_folder keys;
  server inner{echo};
  const auto provider = keys.issue(mec);
  tls_acceptor acceptor{credentials{provider}, acceptor_to(inner.port())};
  std::list<car_host> cars;
  for (int k = 0; k < 8; ++k)
    REQUIRE(
        echoes(cars.emplace_back(keys.issue(car), acceptor.port()).line, "in"));
  for (int k = 0; k < 20; ++k) {
    write_text(provider / "revoked", serial_in(keys.issue(car)));
    acceptor.renew(credentials{provider});
    for (auto& one : cars) {
      one.connector.renew(one.own);
      CHECK(echoes(one.line, "still here"));
    }
  }
  CHECK(acceptor.counts().open == cars.size());
}

TEST_CASE("a CA is rolled over while lines are open") {
  const key_folder old_keys;
  const key_folder new_keys;
  server inner{echo};
  const auto provider = old_keys.issue(mec);
  const auto folder = old_keys.issue(car);
  tls_acceptor acceptor{credentials{provider}, acceptor_to(inner.port())};
  car_host vehicle{folder, acceptor.port()};
  const auto check = [&] {
    CHECK(echoes(vehicle.line, "the same line"));
    CHECK(echoes(plug_into(vehicle.connector.port()), "a new one"));
  };
  check();
  // Both trust both CAs.
  add_authorities(provider, new_keys);
  acceptor.renew(credentials{provider});
  check();
  add_authorities(folder, new_keys);
  vehicle.connector.renew(credentials{folder});
  check();
  // One after the other shows a certificate of the new one.
  const auto next = new_keys.issue(mec);
  add_authorities(next, old_keys);
  acceptor.renew(credentials{next});
  check();
  const auto next_car = new_keys.issue(car);
  add_authorities(next_car, old_keys);
  vehicle.connector.renew(credentials{next_car});
  check();
  // Both trust the new one only.
  write_text(next / "ca.pem", read_file(new_keys.path() / "ca.pem"));
  acceptor.renew(credentials{next});
  check();
  write_text(next_car / "ca.pem", read_file(new_keys.path() / "ca.pem"));
  vehicle.connector.renew(credentials{next_car});
  check();
  // The old one counts no more.
  const car_host late{old_keys.issue(car), acceptor.port()};
  CHECK(late.line.is_closed());
}

TEST_CASE("a renewal that cannot be leaves all as it was") {
  const key_folder keys;
  server inner{echo};
  const auto folder = keys.issue(mec);
  key_ring ring{folder, [](const credentials& own) {
                  if (own.identity() != mec)
                    throw network_error{"that is another one"};
                }};
  tls_acceptor acceptor{ring.now(), acceptor_to(inner.port())};
  ring.add_user([&acceptor](const credentials& own) { acceptor.renew(own); });
  const car_host vehicle{keys.issue(car), acceptor.port()};
  const auto check = [&](std::string_view said) {
    CAPTURE(said);
    CHECK(contains(ring.read_again(), said));
    CHECK(ring.now().identity() == mec);
    CHECK(echoes(vehicle.line, "the same line"));
    CHECK(echoes(plug_into(vehicle.connector.port()), "a new one"));
  };
  check("keys were read again: provider mec until 20");
  const auto certificate = read_file(folder / "cert.pem");
  write_text(folder / "cert.pem", "broken");
  check("keys stay as they were: ");
  write_text(folder / "cert.pem", certificate);
  write_text(folder / "revoked", "\nno serial\n");
  check("revoked:2: this is no serial number");
  fs::remove(folder / "revoked");
  const auto other = keys.issue({{}, "other"});
  for (const auto* name : {"cert.pem", "key.pem"})
    write_text(folder / name, read_file(other / name));
  check("keys stay as they were: that is another one");
}

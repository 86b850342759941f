// Those who shall not get through, and what it costs those who shall.
#include "network/tls/refusal_log.hpp"
#include "tests/network/two_hosts.hpp"
#include "tests/support/dice.hpp"

#include <doctest/doctest.h>

#include <openssl/bio.h>
#include <openssl/ssl.h>

using namespace sofof;
using namespace sofof::network;
using namespace sofof::test;

namespace {

/// TLS of somebody who does not keep our rules: shows what is in a folder, if
/// any, and trusts everybody.
ssl_context_ptr stranger(const std::filesystem::path& folder) {
  ssl_context_ptr context{SSL_CTX_new(TLS_method())};
  if (!folder.empty()) {
    SSL_CTX_use_certificate_file(context.get(), (folder / "cert.pem").c_str(),
                                 SSL_FILETYPE_PEM);
    SSL_CTX_use_PrivateKey_file(context.get(), (folder / "key.pem").c_str(),
                                SSL_FILETYPE_PEM);
  }
  return context;
}

/// Opens TLS and says something, whatever comes of it.
void knock(std::uint16_t port, SSL_CTX& context) {
  const auto line = plug_into(port);
  const ssl_ptr tls{SSL_new(&context)};
  SSL_set_fd(tls.get(), line.fd());
  std::array<char, 16> answer{};
  if (SSL_connect(tls.get()) == 1)
    SSL_read(tls.get(), answer.data(), answer.size());
  forget_openssl_errors();
}

/// Answers TLS and waits for something.
void answer(const plug& line, SSL_CTX& context) {
  const ssl_ptr tls{SSL_new(&context)};
  SSL_set_fd(tls.get(), line.fd());
  std::array<char, 16> question{};
  if (SSL_accept(tls.get()) == 1)
    SSL_read(tls.get(), question.data(), question.size());
  forget_openssl_errors();
}

/// @returns what TLS says first.
bytes client_hello(const credentials& own) {
  const auto context = make_tls_context(own);
  const ssl_ptr tls{SSL_new(context.settings.get())};
  SSL_set_bio(tls.get(), BIO_new(BIO_s_mem()), BIO_new(BIO_s_mem()));
  SSL_connect(tls.get());
  forget_openssl_errors();
  char* text = nullptr;
  const auto size = BIO_get_mem_data(SSL_get_wbio(tls.get()), &text);
  return to_bytes({text, static_cast<std::size_t>(size)});
}

std::size_t open_files() {
  const std::filesystem::directory_iterator all{"/proc/self/fd"};
  return static_cast<std::size_t>(std::distance(begin(all), end(all)));
}

} // namespace

TEST_CASE("an acceptor refuses whom it does not know, and says why") {
  const key_folder keys;
  const key_folder others;
  server inner{echo};
  sentences heard;
  const tls_acceptor acceptor{keys.credentials_for(mec),
                              acceptor_to(inner.port(), &heard)};
  SUBCASE("a certificate of another CA") {
    knock(acceptor.port(), *stranger(others.issue(car)));
    CHECK(heard.heard("was refused: its certificate is not signed by this CA"));
  }
  SUBCASE("an expired certificate") {
    const auto folder = keys.issue(car);
    keys.alter(folder, expire);
    knock(acceptor.port(), *stranger(folder));
    CHECK(heard.heard("was refused: its certificate has expired on 20"));
  }
  SUBCASE("a certificate of days to come") {
    const auto folder = keys.issue(car);
    keys.alter(folder, postpone);
    knock(acceptor.port(), *stranger(folder));
    CHECK(heard.heard("was refused: its certificate is not valid before 20"));
  }
  SUBCASE("a provider") {
    knock(acceptor.port(), *stranger(keys.issue({{}, "other"})));
    CHECK(heard.heard(
        "was refused: its certificate names provider other, no station"));
  }
  SUBCASE("no certificate") {
    knock(acceptor.port(), *stranger({}));
    CHECK(heard.heard("was refused: it shows no certificate"));
  }
  SUBCASE("TLS 1.2") {
    const auto context = stranger(keys.issue(car));
    SSL_CTX_set_max_proto_version(context.get(), TLS1_2_VERSION);
    knock(acceptor.port(), *context);
    CHECK(heard.heard("was refused: it does not speak TLS 1.3"));
  }
  SUBCASE("plain text") {
    const auto line = plug_into(acceptor.port());
    line.send("hello, is anybody there?");
    CHECK(line.is_closed());
    CHECK(heard.heard("was refused: it does not speak TLS"));
  }
  SUBCASE("HTTP") {
    const auto line = plug_into(acceptor.port());
    line.send("GET / HTTP/1.1\r\n\r\n");
    CHECK(line.is_closed());
    CHECK(heard.heard("was refused: it does not speak TLS"));
  }
  SUBCASE("somebody who hangs up") {
    (void)plug_into(acceptor.port());
    CHECK(heard.heard("was refused: it hung up"));
  }
  CHECK(acceptor.counts().accepted == 0);
  CHECK(acceptor.counts().refused == 1);
}

TEST_CASE("a connector refuses who is no provider of its CA, and says why") {
  const key_folder keys;
  const auto own = keys.credentials_for(car);
  const auto error_with = [&](const std::filesystem::path& folder) {
    const auto context = stranger(folder);
    server false_door{[&](const plug& line) { answer(line, *context); }};
    const tls_connector connector{&own, connector_to(false_door.port())};
    CHECK(plug_into(connector.port()).is_closed());
    return connector.last_error();
  };
  SUBCASE("a station that poses as a provider") {
    CHECK(contains(error_with(keys.issue({{7}, {}})),
                   "its certificate names station 7, not a provider"));
  }
  SUBCASE("an expired provider") {
    const auto folder = keys.issue(mec);
    keys.alter(folder, expire);
    CHECK(contains(error_with(folder), "its certificate has expired on 20"));
  }
  SUBCASE("no certificate") {
    CHECK(error_with({}) != "");
  }
}

TEST_CASE("a connector hears that it is not accepted itself") {
  const key_folder keys;
  const key_folder others;
  const auto own = keys.credentials_for(car);
  const auto context = stranger(keys.issue(mec));
  const auto trusted = others.credentials_for(mec);
  SSL_CTX_set1_cert_store(context.get(), &trusted.trusted());
  SSL_CTX_set_verify(context.get(),
                     SSL_VERIFY_PEER | SSL_VERIFY_FAIL_IF_NO_PEER_CERT,
                     nullptr);
  server acceptor{[&](const plug& line) { answer(line, *context); }};
  const tls_connector connector{&own, connector_to(acceptor.port())};
  CHECK(plug_into(connector.port()).is_closed());
  CHECK(contains(connector.last_error(),
                 "it does not trust the CA of our certificate"));
}

TEST_CASE("who does not finish the handshake in time is shown out") {
  const key_folder keys;
  server inner{echo};
  sentences heard;
  auto options = acceptor_to(inner.port(), &heard);
  options.handshake_timeout = 50ms;
  const tls_acceptor acceptor{keys.credentials_for(mec), options};
  std::vector<plug> idle;
  for (int k = 0; k < 50; ++k)
    idle.push_back(plug_into(acceptor.port()));
  for (const auto& line : idle)
    CHECK(line.is_closed());
  CHECK(acceptor.counts().refused == 50);
  CHECK(heard.heard("was refused: it did not finish the TLS handshake in "
                    "time"));
  CHECK(heard.all().size() <= 2);
}

TEST_CASE("a crowd at the acceptor does not keep an honest vehicle out") {
  const key_folder keys;
  server inner{echo};
  sentences heard;
  auto options = acceptor_to(inner.port(), &heard);
  options.most_handshakes = 8;
  const tls_acceptor acceptor{keys.credentials_for(mec), options};
  std::vector<plug> idle;
  for (int k = 0; k < 20; ++k)
    idle.push_back(plug_into(acceptor.port()));
  CHECK(wait_until([&] { return acceptor.counts().refused == 12; }));
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  CHECK(echoes(plug_into(connector.port()), "honest"));
  CHECK(acceptor.counts().refused == 13);
  CHECK(heard.heard("8 handshakes of its network are unfinished"));
  CHECK(wait_until([&] {
    return std::ranges::count_if(
               idle,
               [](const plug& line) {
                 std::byte any{};
                 return recv(line.fd(), &any, 1, MSG_DONTWAIT | MSG_PEEK) == 0;
               })
           == 13;
  }));
}

TEST_CASE("two thousand damaged handshakes leave the acceptor serving") {
  const key_folder keys;
  server inner{echo};
  const auto own = keys.credentials_for(car);
  const auto hello = client_hello(own);
  REQUIRE(hello.size() > 100);
  const auto files_before = open_files();
  {
    const tls_acceptor acceptor{keys.credentials_for(mec),
                                acceptor_to(inner.port())};
    const tls_connector connector{&own, connector_to(acceptor.port())};
    const auto line = plug_into(connector.port());
    CHECK(echoes(line, "before"));
    test::dice dice{2025};
    const auto below = [&](std::size_t limit) {
      return static_cast<std::size_t>(
          dice.between(0, static_cast<double>(limit)));
    };
    for (int round = 0; round < 2000; ++round) {
      auto damaged = hello;
      for (auto flips = 1 + below(8); flips > 0; --flips)
        damaged[below(damaged.size())] ^=
            static_cast<std::byte>(1 + below(255));
      if (below(4) == 0)
        damaged.resize(below(damaged.size()));
      plug_into(acceptor.port()).send(damaged);
    }
    CHECK(echoes(line, "after"));
    CHECK(echoes(plug_into(connector.port()), "new"));
    CHECK(wait_until([&] { return acceptor.counts().refused == 2000; }));
    CHECK(acceptor.counts().accepted == 2);
  }
  // The inner server keeps the two that it got.
  CHECK(open_files() == files_before + 2);
}

TEST_CASE("idle strangers and a flood of garbage do not slow a line down") {
  const key_folder keys;
  server inner{echo};
  const tls_acceptor acceptor{keys.credentials_for(mec),
                              acceptor_to(inner.port())};
  const auto own = keys.credentials_for(car);
  const tls_connector connector{&own, connector_to(acceptor.port())};
  const auto line = plug_into(connector.port());
  const auto p99_us = [&] {
    std::vector<double> times_us;
    for (int k = 0; k < 1000; ++k) {
      const auto begin = std::chrono::steady_clock::now();
      CHECK(echoes(line, "a message of some bytes"));
      times_us.push_back(std::chrono::duration<double, std::micro>(
                             std::chrono::steady_clock::now() - begin)
                             .count());
      std::this_thread::sleep_for(500us);
    }
    std::ranges::sort(times_us);
    return times_us[990];
  };
  const auto quiet_us = p99_us();
  std::vector<plug> idle;
  for (int k = 0; k < 500; ++k)
    idle.push_back(plug_into(acceptor.port()));
  std::atomic<bool> over = false;
  std::thread flood{[&] {
    const bytes garbage(512, std::byte{0x16});
    while (!over) {
      const auto refused = acceptor.counts().refused;
      for (int k = 0; k < 10; ++k)
        plug_into(acceptor.port()).send(garbage);
      wait_until([&] { return acceptor.counts().refused >= refused + 10; });
    }
  }};
  const auto flooded_us = p99_us();
  over = true;
  flood.join();
  MESSAGE("p99 of a round trip, us: quiet ", quiet_us, ", in the flood ",
          flooded_us, "; refused ", acceptor.counts().refused);
  // A broken acceptor takes seconds; the machine's other work takes some.
  CHECK(flooded_us < 50'000);
}

TEST_CASE("of many refusals a second, one is told, and how many there were") {
  std::vector<std::string> told;
  refusal_log log{[&](const std::string& s) { told.push_back(s); }};
  const deadline start{};
  CHECK_FALSE(log.next());
  log.add("one", start);
  log.add("two", start + 1ms);
  log.add("three", start + 2ms);
  CHECK(told == std::vector<std::string>{"one"});
  CHECK(log.next() == start + 1s);
  log.publish_rest(start + 999ms);
  CHECK(told.size() == 1);
  log.publish_rest(start + 1s);
  CHECK(told.back() == "three (and 1 more before it)");
  CHECK_FALSE(log.next());
  log.add("four", start + 1500ms);
  CHECK(told.size() == 2);
  log.add("five", start + 2s);
  CHECK(told.size() == 3);
  CHECK(told.back() == "four");
  log.publish_rest(start + 3s);
  CHECK(told.back() == "five");
}

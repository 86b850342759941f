// Names and tokens.
#include "live/gate.hpp"

#include "network/keys/nonce.hpp"

#include <fmt/format.h>

#include <openssl/crypto.h>

namespace sofof::live {

namespace {

constexpr unsigned forbidden = 403;
constexpr std::size_t token_octets = 16;

/// @returns a host without its port: "[::1]:80" is "::1".
std::string_view without_port(std::string_view host) {
  if (host.starts_with('[')) {
    host.remove_prefix(1);
    return host.substr(0, host.find(']'));
  }
  return host.substr(0, host.find(':'));
}

/// Takes as long, wherever the first difference is.
bool is_same(std::string_view a, std::string_view b) {
  return a.size() == b.size()
         && CRYPTO_memcmp(a.data(), b.data(), a.size()) == 0;
}

} // namespace

bool is_loopback(std::string_view host) {
  return host == "::1" || host == "localhost" || host == "::ffff:127.0.0.1"
         || (host.starts_with("127.")
             && host.find_first_not_of("0123456789.") == host.npos);
}

gate::gate(std::string_view host) {
  if (is_loopback(host))
    return;
  query_ = "?token=";
  for (const auto octet : network::draw_nonce().substr(0, token_octets))
    query_ += fmt::format("{:02x}", static_cast<unsigned char>(octet));
}

std::optional<network::http::response>
gate::refuse(const network::http::request& x) const {
  network::http::response no;
  no.status = forbidden;
  if (query_.empty()) {
    if (x.host.empty() || is_loopback(without_port(x.host)))
      return std::nullopt;
    no.body = "this page is served on this machine alone; ask for it by "
              "localhost or 127.0.0.1\n";
    return no;
  }
  if (is_same("?" + x.query, query_))
    return std::nullopt;
  no.body = "the token is missing or wrong; the console of the process shows "
            "the address with it\n";
  return no;
}

} // namespace sofof::live

// Where others reach a process, and what it shows them.
#include "scenario/secure_listener.hpp"

#include "base/fingerprint.hpp"
#include "base/input_error.hpp"
#include "network/keys/nonce.hpp"

#include <fmt/format.h>

#include <utility>

namespace sofof::scenario {

std::shared_ptr<network::key_ring> load_keys(const network::network_address& at,
                                             const std::string& folder,
                                             std::string_view option,
                                             network::key_ring::user check) {
  if (!folder.empty())
    return std::make_shared<network::key_ring>(folder, std::move(check));
  if (at.host != "127.0.0.1" && at.host != "localhost")
    throw input_error(fmt::format(
        "{} {} is not 127.0.0.1, and connections beyond this machine must be "
        "secured; make certificates with `sofof keys` and name their folder "
        "with --keys",
        option, network::print_address(at)));
  return nullptr;
}

secure_listener::secure_listener(std::shared_ptr<network::key_ring> keys,
                                 network::network_address listen)
    : keys_{std::move(keys)}, listen_{std::move(listen)} {}

network::network_address
secure_listener::open(network_runtime& time,
                      const messages::acceptor_actor& acceptor,
                      std::function<void(const std::string&)> on_refusal) {
  const auto port = time.publish(acceptor, keys_ ? 0 : listen_.port);
  if (!keys_)
    return {listen_.host, port};
  tls_.emplace(keys_->now(),
               network::acceptor_options{
                   .listen = listen_,
                   .inner_port = port,
                   .draws = {fingerprint(network::draw_nonce()), "handshakes"},
                   .peers = peers_,
                   .on_refusal = std::move(on_refusal)});
  keys_->add_user(
      [this](const network::credentials& own) { tls_->renew(own); });
  return {listen_.host, tls_->port()};
}

} // namespace sofof::scenario

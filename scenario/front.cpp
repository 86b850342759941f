// Where others reach a process, and what it shows them.
#include "scenario/front.hpp"

#include "network/nonce.hpp"
#include "scenario/input_error.hpp"
#include "world/fingerprint.hpp"

#include <fmt/format.h>

#include <utility>

namespace sofof {

std::optional<credentials> load_keys(const network_address& at,
                                     const std::string& folder,
                                     std::string_view option) {
  if (!folder.empty())
    return credentials{folder};
  if (at.host != "127.0.0.1" && at.host != "localhost")
    throw input_error(fmt::format(
        "{} {} is not 127.0.0.1, and connections beyond this machine must be "
        "secured; make certificates with `sofof keys` and name their folder "
        "with --keys",
        option, print_address(at)));
  return std::nullopt;
}

front::front(const std::optional<credentials>& own, network_address listen)
    : own_{own}, listen_{std::move(listen)} {}

network_address
front::open(network_runtime& time, const gate_actor& gate,
            std::function<void(const std::string&)> on_refusal) {
  const auto port = time.publish(gate, own_ ? 0 : listen_.port);
  if (!own_)
    return {listen_.host, port};
  door_.emplace(*own_,
                door_options{.listen = listen_,
                             .inner_port = port,
                             .draws = {fingerprint(draw_nonce()), "handshakes"},
                             .on_refusal = std::move(on_refusal)});
  return {listen_.host, door_->port()};
}

} // namespace sofof

// Where Qpid Proton was not installed when this program was built.
#include "network/amqp/broker.hpp"
#include "network/amqp/client.hpp"
#include "network/amqp/is_built_in.hpp"
#include "network/network_error.hpp"

namespace sofof::network::amqp {

namespace {

[[noreturn]] void refuse() {
  throw network_error{"this program was built without AMQP; install "
                      "libqpid-proton-cpp12-dev and build it again with "
                      "./sofof setup"};
}

} // namespace

class client::state {};
class broker::loop {};

bool is_built_in() {
  return false;
}

client::client(client_options) {
  refuse();
}
client::~client() = default;
void client::start() {}
void client::stop() {}
void client::send(message) {}
bool client::is_up() const {
  return false;
}
client_counts client::counts() const {
  return {};
}

broker::broker(broker_options) {
  refuse();
}
broker::~broker() = default;
std::uint16_t broker::port() const {
  return 0;
}
broker_counts broker::counts() const {
  return {};
}

} // namespace sofof::network::amqp

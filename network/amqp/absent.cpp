// Where Qpid Proton was not installed when this program was built.
#include "network/amqp/broker.hpp"
#include "network/amqp/client.hpp"
#include "network/amqp/is_built_in.hpp"

namespace sofof::network::amqp {

class client::state {};
class broker::loop {};

bool is_built_in() {
  return false;
}

client::client(client_options) {
  require_built_in();
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
  require_built_in();
}
broker::~broker() = default;
std::uint16_t broker::port() const {
  return 0;
}
broker_counts broker::counts() const {
  return {};
}

} // namespace sofof::network::amqp

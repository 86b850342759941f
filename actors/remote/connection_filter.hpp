// Judges what comes by the connections of a process, in CAF's middleman.
#pragma once

#include "actors/remote/frame_check.hpp"
#include "messages/type_ids.hpp"
#include "network/keys/identity.hpp"

#include <caf/fwd.hpp>
#include <caf/io/fwd.hpp>

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>

namespace sofof::actors {

/// The peers that have introduced their nodes, by the node ids that their
/// messages come from. Any thread may call these.
class peer_nodes {
public:
  /// @returns whether it was added; a node that is known stays what it is.
  bool add(const std::string& node, const network::peer_identity& who);
  void remove(const std::string& node);

  /// @returns whom TLS has established behind a node; nothing for a node
  /// without a connection.
  std::optional<network::peer_identity> find(const caf::node_id& node) const;

private:
  mutable std::mutex mutex_;
  // Nodes as they are serialised.
  std::map<std::string, network::peer_identity> by_node_;
};

/// Whom a process lets connect, and how much it hears of each.
struct filter_setup {
  /// @returns whom TLS has established behind a connection from this loopback
  /// port; nothing: the connection is closed. Empty: every connection of this
  /// machine is let in, by whom is not known.
  std::function<std::optional<network::peer_identity>(std::uint16_t port)>
      identify;
  /// For which those speak that are not known, and those that we call.
  std::size_t stations = 0;
  /// Notes why connections were closed; may be none.
  messages::recorder_actor recorder;
  /// Told the same, in a sentence without its full stop; by the thread of CAF's
  /// middleman. Must not block. Both hear of five at once, then of one in five
  /// seconds.
  std::function<void(const std::string&)> on_refusal;
};

/// Filters all connections from now on; call it before there are any.
/// @param nodes  Gets those whose identity is known.
void filter_connections(caf::io::middleman& middleman, filter_setup setup,
                        std::shared_ptr<peer_nodes> nodes);

} // namespace sofof::actors

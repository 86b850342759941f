// Judges what comes by the connections of a process, in CAF's middleman.
#include "actors/remote/connection_filter.hpp"

#include "actors/remote/frame_allowance.hpp"
#include "actors/remote/public_messages.hpp"
#include "network/flow/token_bucket.hpp"

#include <caf/binary_serializer.hpp>
#include <caf/io/basp/frame_filter.hpp>
#include <caf/io/middleman.hpp>
#include <caf/node_id.hpp>
#include <caf/send.hpp>
#include <fmt/format.h>

#include <utility>

namespace sofof::actors {

namespace {

constexpr double reports_s = 0.2;
constexpr double reports_at_once = 5;

/// What all connections of a process share, on the middleman's thread.
struct shared_setup {
  filter_setup given;
  std::shared_ptr<peer_nodes> nodes;
  frame_allowances allowances{};
  network::token_bucket reports{reports_s, reports_at_once};
  std::uint64_t left_out = 0;

  void report(std::string why, time_point at) {
    if (!reports.try_spend(at)) {
      ++left_out;
      return;
    }
    if (left_out > 0)
      why += fmt::format("; {} more", std::exchange(left_out, 0));
    given.on_refusal(why);
    if (given.recorder)
      caf::anon_send(given.recorder,
                     messages::record{messages::event_record{
                         .at = at,
                         .what = messages::event_type::peer_disconnected,
                         .detail = std::move(why)}});
  }
};

class connection_filter final : public caf::io::basp::frame_filter {
public:
  connection_filter(bool is_accepted, std::shared_ptr<shared_setup> setup,
                    std::optional<network::peer_identity> peer)
      : setup_{std::move(setup)}, peer_{std::move(peer)},
        check_{is_accepted,
               is_accepted ? messages_to_provider() : messages_to_vehicles()} {}

  ~connection_filter() override {
    if (is_known_)
      setup_->nodes->remove(check_.node());
  }

  bool expects(const caf::io::basp::header& header,
               caf::actor_clock::time_point now) override {
    now_ = time_point{now.time_since_epoch()};
    operation_ = header.operation;
    why_ = check_.objection(translated(header));
    return why_.empty();
  }

  bool admits(const caf::io::basp::header& header,
              caf::span<const caf::byte> payload,
              caf::actor_clock::time_point now) override {
    now_ = time_point{now.time_since_epoch()};
    why_ = allowance().objection(frame_header_size + payload.size(), now_);
    if (!why_.empty())
      return false;
    const auto was_new = check_.node().empty();
    why_ = check_.objection(
        translated(header),
        {reinterpret_cast<const std::byte*>(payload.data()), payload.size()});
    if (peer_ && was_new && !check_.node().empty())
      is_known_ = setup_->nodes->add(check_.node(), *peer_);
    return why_.empty();
  }

  void refused() override {
    using caf::io::basp::message_type;
    // CAF gives up a second connection with a process that it still knows, be
    // it one that has just ended or was cut: whoever has called it knows.
    if (why_.empty() && operation_ == message_type::server_handshake)
      return;
    if (why_.empty() && operation_ == message_type::client_handshake)
      why_ = "its process is connected already";
    setup_->report(
        fmt::format("{} was disconnected: {}",
                    peer_ ? network::describe(*peer_) : "a peer",
                    why_.empty() ? "its frame cannot be read" : why_),
        now_);
  }

private:
  frame_allowance& allowance() {
    if (!allowance_) {
      const auto bounds =
          bounds_for(peer_ ? peer_->stations.size() : setup_->given.stations);
      allowance_ =
          peer_ ? setup_->allowances.of(network::describe(*peer_), bounds, now_)
                : std::make_shared<frame_allowance>(bounds);
    }
    return *allowance_;
  }

  static frame_header translated(const caf::io::basp::header& h) {
    return {static_cast<std::uint8_t>(h.operation),
            h.flags,
            h.payload_len,
            h.operation_data,
            h.source_actor,
            h.dest_actor};
  }

  std::shared_ptr<shared_setup> setup_;
  std::optional<network::peer_identity> peer_;
  std::shared_ptr<frame_allowance> allowance_; // from the first frame on
  frame_check check_;
  bool is_known_ = false;                   // to the others, by its node
  caf::io::basp::message_type operation_{}; // of the latest frame
  std::string_view why_;
  time_point now_;
};

} // namespace

bool peer_nodes::add(const std::string& node,
                     const network::peer_identity& who) {
  const std::lock_guard lock{mutex_};
  return by_node_.try_emplace(node, who).second;
}

void peer_nodes::remove(const std::string& node) {
  const std::lock_guard lock{mutex_};
  by_node_.erase(node);
}

std::optional<network::peer_identity>
peer_nodes::find(const caf::node_id& node) const {
  caf::byte_buffer octets;
  caf::binary_serializer sink{nullptr, octets};
  if (!sink.apply(node))
    return std::nullopt;
  const std::string key{reinterpret_cast<const char*>(octets.data()),
                        octets.size()};
  const std::lock_guard lock{mutex_};
  const auto at = by_node_.find(key);
  if (at == by_node_.end())
    return std::nullopt;
  return at->second;
}

void filter_connections(caf::io::middleman& middleman, filter_setup setup,
                        std::shared_ptr<peer_nodes> nodes) {
  middleman.make_frame_filter =
      [setup = std::make_shared<shared_setup>(
           shared_setup{std::move(setup), std::move(nodes)})](
          bool is_accepted,
          std::uint16_t port) -> std::unique_ptr<caf::io::basp::frame_filter> {
    std::optional<network::peer_identity> peer;
    if (is_accepted && setup->given.identify) {
      peer = setup->given.identify(port);
      if (!peer)
        return nullptr;
    }
    return std::make_unique<connection_filter>(is_accepted, setup,
                                               std::move(peer));
  };
}

} // namespace sofof::actors

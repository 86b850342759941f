// Page, scene, events.
#include "live/live_server.hpp"

#include "network/keys/nonce.hpp"

#include <fmt/format.h>

#include "live/frame.hpp"
#include "live/page.hpp"
#include "live/scene.hpp"
#include "live/shown_at.hpp"
#include <algorithm>
#include <charconv>
#include <utility>

namespace sofof::live {

namespace {

using health = scenario::operations::health;

/// Clients that come between two ticks of the server get the same frame.
constexpr duration same_frame = std::chrono::milliseconds{60};
constexpr std::size_t events_at_once = 100;

/// Whoever was sent a frame so long ago still follows.
constexpr duration follows = std::chrono::milliseconds{500};
/// Two ticks of the server, and some more.
constexpr std::chrono::milliseconds last_moment{300};

std::string draw_run() {
  constexpr std::size_t octets = 8;
  std::string text;
  for (const auto x : network::draw_nonce().substr(0, octets))
    text += fmt::format("{:02x}", static_cast<unsigned char>(x));
  return text;
}

/// @returns a number as Last-Event-ID has it; 0 for what is none.
std::uint64_t number_in(const std::string& text) {
  std::uint64_t x = 0;
  const auto end = text.data() + text.size();
  const auto read = std::from_chars(text.data(), end, x);
  return read.ec == std::errc{} && read.ptr == end ? x : 0;
}

std::vector<std::string> names_in(const scenario::scenario_definition& s) {
  std::vector<std::string> all;
  for (const auto& x : s.providers)
    all.push_back(x.name);
  return all;
}

std::shared_ptr<run_state> state_for(const scenario::live_subject& of,
                                     const std::vector<std::string>& names) {
  std::optional<std::uint64_t> only;
  if (of.role == "provide")
    only = static_cast<std::uint64_t>(std::ranges::find(names, of.run.provider)
                                      - names.begin());
  return std::make_shared<run_state>(
      of.run.chain.empty() ? "" : of.run.chain.back(), only);
}

class seeing_sink final : public messages::record_sink {
public:
  seeing_sink(std::shared_ptr<messages::record_sink> sees,
              std::shared_ptr<messages::record_sink> then)
      : sees_{std::move(sees)}, then_{std::move(then)} {}

  void on_record(const messages::record& x) override {
    sees_->on_record(x);
    then_->on_record(x);
  }

private:
  std::shared_ptr<messages::record_sink> sees_, then_;
};

network::http::response page() {
  network::http::response x;
  x.type = "text/html; charset=utf-8";
  x.body = live_page;
  x.fields = {{"Content-Security-Policy",
               "default-src 'none'; script-src 'unsafe-inline'; style-src "
               "'unsafe-inline'; connect-src 'self'; img-src data: blob:; "
               "frame-ancestors 'none'; base-uri 'none'; form-action 'none'"},
              {"Referrer-Policy", "no-referrer"}};
  return x;
}

} // namespace

live_server::live_server(const network::network_address& at,
                         const scenario::live_subject& of)
    : figures_{of.figures}, run_{draw_run()}, names_{names_in(of.what)},
      scene_{scene_text(of, run_)}, state_{state_for(of, names_)},
      gate_{at.host}, server_{at, [this](const network::http::request& to) {
                                return answer(to);
                              }} {}

live_server::~live_server() {
  if (figures_.state() != health::ending
      || figures_.now() - made_at_.load() > follows)
    return;
  std::unique_lock lock{end_mutex_};
  end_is_told_.wait_for(lock, last_moment, [this] { return is_end_told_; });
}

std::shared_ptr<messages::record_sink>
live_server::seeing(std::shared_ptr<messages::record_sink> then) const {
  return std::make_shared<seeing_sink>(state_, std::move(then));
}

std::function<void(const messages::cam&, time_point)>
live_server::hearing() const {
  return [state = state_](const messages::cam& x, time_point now) {
    state->on_heard(x, now);
  };
}

std::string live_server::address() const {
  return fmt::format("http://{}/{}", network::print_address(server_.address()),
                     gate_.query());
}

network::http::response live_server::answer(const network::http::request& to) {
  if (to.path == "/healthz") // is for everybody
    return figures_.answer(to);
  if (auto no = gate_.refuse(to))
    return *no;
  if (to.path == "/")
    return page();
  if (to.path == "/scene")
    return {200, "application/json", scene_};
  if (to.path == "/events")
    return follow(to);
  return figures_.answer(to);
}

network::http::response live_server::follow(const network::http::request& to) {
  network::http::response x;
  x.type = "text/event-stream";
  x.next = [this, seen = number_in(to.last_event)]() mutable {
    return next(seen);
  };
  return x;
}

network::http::piece live_server::next(std::uint64_t& seen) {
  renew_frame();
  if (!piece_ || piece_after_ != seen) {
    const auto events = state_->events_after(seen, events_at_once);
    piece_after_ = seen;
    piece_until_ = events.empty() ? seen : events.back().number;
    piece_ = std::make_shared<const std::string>(
        event_text(frame_, figures_.start(), events, piece_until_));
  }
  seen = piece_until_;
  return piece_;
}

void live_server::renew_frame() {
  const auto now = figures_.now();
  if (!frame_.empty() && now - made_at_.load() < same_frame)
    return;
  made_at_ = now;
  piece_.reset();
  const auto is_ending = figures_.state() == health::ending;
  frame_ =
      frame_text({run_, ++number_, figures_.start(), now, is_ending},
                 state_->cars(now), figures_.loads(), names_, state_->counts());
  if (!is_ending)
    return;
  const std::lock_guard lock{end_mutex_};
  is_end_told_ = true; // with this tick of the server, which it finishes
  end_is_told_.notify_one();
}

scenario::live_view_maker shown_at(const network::network_address& at) {
  return [at](const scenario::live_subject& of) {
    return std::make_unique<live_server>(at, of);
  };
}

} // namespace sofof::live

// Those who follow a stream of a server: Boost.Beast writes.
#pragma once

#include "network/http/message.hpp"

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/asio/steady_timer.hpp>
#include <boost/asio/write.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <cstddef>
#include <exception>
#include <functional>
#include <memory>
#include <optional>
#include <utility> // before Asio, which lacks it
#include <vector>

namespace sofof::network::http {

using beast_response =
    boost::beast::http::response<boost::beast::http::string_body>;

/// One client. It has one write under way at most: what it cannot take, it
/// loses. Lives until its last operation is over.
class stream : public std::enable_shared_from_this<stream> {
public:
  /// @param head   Without a body.
  /// @param count  Of streams; outlives this.
  stream(boost::beast::tcp_stream&& line, beast_response head,
         std::function<piece()> next, std::size_t& count)
      : line_{std::move(line)}, head_{std::move(head)},
        serializer_{head_}, next_{std::move(next)}, count_{count} {
    ++count_;
    // Small, so that who has stopped reading is known soon, and does not find
    // a long past when it goes on.
    boost::system::error_code ignored;
    line_.socket().set_option(
        boost::asio::socket_base::send_buffer_size{kept_octets}, ignored);
  }
  ~stream() { --count_; }
  stream(const stream&) = delete;
  stream& operator=(const stream&) = delete;

  /// Writes the head, and a first piece at once.
  void begin() {
    line_.expires_after(patience);
    boost::beast::http::async_write_header(
        line_, serializer_,
        [self = shared_from_this()](boost::system::error_code problem,
                                    std::size_t) {
          self->is_writing_ = false;
          self->is_over_ = problem.failed();
          self->offer();
        });
  }

  /// Writes another piece, unless the last one is still on its way.
  void offer() {
    if (is_writing_ || is_over_)
      return;
    try {
      sent_ = next_();
    } catch (const std::exception&) { // no room, say
      is_over_ = true;
      return;
    }
    if (!sent_)
      return;
    is_writing_ = true;
    line_.expires_after(patience);
    boost::asio::async_write(
        line_, boost::asio::buffer(*sent_),
        [self = shared_from_this()](boost::system::error_code problem,
                                    std::size_t) {
          self->is_writing_ = false;
          self->is_over_ = problem.failed();
        });
  }

  /// @returns whether the client has gone.
  bool is_over() const { return is_over_; }

private:
  static constexpr int kept_octets = 64 * 1024;
  static constexpr std::chrono::seconds patience{30};

  boost::beast::tcp_stream line_;
  beast_response head_;
  boost::beast::http::response_serializer<boost::beast::http::string_body>
      serializer_;
  std::function<piece()> next_;
  std::size_t& count_;
  piece sent_;
  bool is_writing_ = true;
  bool is_over_ = false;
};

/// All of them: ten times a second each is offered what comes next.
class streams {
public:
  /// @param count  Of streams that live; outlives what the context holds.
  streams(boost::asio::io_context& io, std::size_t& count, std::size_t most)
      : timer_{io}, count_{count}, most_{most} {}

  bool has_room() const { return count_ < most_; }

  void add(boost::beast::tcp_stream&& line, beast_response head,
           std::function<piece()> next) {
    all_.push_back(std::make_shared<stream>(std::move(line), std::move(head),
                                            std::move(next), count_));
    all_.back()->begin();
    if (all_.size() == 1) {
      timer_.expires_after(period);
      await();
    }
  }

private:
  static constexpr std::chrono::milliseconds period{100};

  void await() {
    timer_.async_wait([this](boost::system::error_code problem) {
      if (!problem)
        tick();
    });
  }

  void tick() {
    std::erase_if(all_, [](const auto& x) { return x->is_over(); });
    for (const auto& x : all_)
      x->offer();
    if (all_.empty())
      return;
    timer_.expires_after(period);
    await();
  }

  boost::asio::steady_timer timer_;
  std::size_t& count_;
  const std::size_t most_;
  std::vector<std::shared_ptr<stream>> all_;
};

} // namespace sofof::network::http

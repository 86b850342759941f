// Boost.Beast reads and writes; one thread does everything.
#include "network/http/server.hpp"

#include "network/block_signals.hpp"
#include "network/http/streams.hpp"
#include "network/network_error.hpp"

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <chrono>
#include <exception>
#include <optional>
#include <pthread.h>
#include <string>
#include <thread>
#include <utility> // before Asio, which lacks it

namespace sofof::network::http {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using boost::system::error_code;
using beast_request = beast::http::request<beast::http::empty_body>;
using answerer = std::function<response(const request&)>;

constexpr std::uint32_t longest_header = 8192;
constexpr std::chrono::seconds patience{10};

request as_ours(const beast_request& from) {
  request to;
  to.method = std::string{from.method_string()};
  const std::string target{from.target()};
  const auto question = target.find('?');
  to.path = target.substr(0, question);
  if (question != target.npos)
    to.query = target.substr(question + 1);
  to.accept = std::string{from[beast::http::field::accept]};
  to.host = std::string{from[beast::http::field::host]};
  to.last_event = std::string{from["Last-Event-ID"]};
  return to;
}

response answer_of(const answerer& answer, const beast_request& from) {
  const auto verb = from.method();
  if (verb != beast::http::verb::get && verb != beast::http::verb::head)
    return {405, "text/plain; charset=utf-8", "only GET is answered here\n"};
  try {
    return answer(as_ours(from));
  } catch (const std::exception& problem) { // no room, say
    return {500, "text/plain; charset=utf-8",
            std::string{problem.what()} + '\n'};
  }
}

beast_response as_theirs(response&& from, const beast_request& to) {
  beast_response out{static_cast<beast::http::status>(from.status),
                     to.version()};
  out.set(beast::http::field::content_type, from.type);
  out.set(beast::http::field::cache_control, "no-store");
  out.set("X-Content-Type-Options", "nosniff");
  for (const auto& [name, value] : from.fields)
    out.set(name, value);
  if (from.next) { // it ends with its connection
    out.keep_alive(false);
    return out;
  }
  out.keep_alive(to.keep_alive());
  const auto size = from.body.size();
  if (to.method() != beast::http::verb::head)
    out.body() = std::move(from.body);
  out.content_length(size);
  return out;
}

/// One client; lives until its last operation is over, or becomes a stream.
class connection : public std::enable_shared_from_this<connection> {
public:
  connection(tcp::socket socket, const answerer& answer, streams& followers,
             std::size_t& count)
      : stream_{std::move(socket)}, answer_{answer},
        followers_{followers}, count_{count} {
    ++count_;
  }
  ~connection() { --count_; }
  connection(const connection&) = delete;
  connection& operator=(const connection&) = delete;

  void read() {
    parser_.emplace();
    parser_->header_limit(longest_header);
    parser_->body_limit(0);
    stream_.expires_after(patience);
    beast::http::async_read(
        stream_, buffer_, *parser_,
        [self = shared_from_this()](error_code problem, std::size_t) {
          if (!problem)
            self->write();
        });
  }

private:
  void write() {
    const auto& asked = parser_->get();
    const auto is_head = asked.method() == beast::http::verb::head;
    auto answer = answer_of(answer_, asked);
    if (answer.next && !followers_.has_room())
      answer = {503, "text/plain; charset=utf-8",
                "as many follow as there is room for; try again later\n"};
    auto next = answer.next;
    out_.emplace(as_theirs(std::move(answer), asked));
    if (next && !is_head) {
      followers_.add(std::move(stream_), std::move(*out_), std::move(next));
      return;
    }
    stream_.expires_after(patience);
    const auto written = [self = shared_from_this()](error_code problem,
                                                     std::size_t) {
      if (!problem && self->out_->keep_alive())
        self->read();
    };
    if (is_head) {
      serializer_.emplace(*out_);
      beast::http::async_write_header(stream_, *serializer_, written);
    } else {
      beast::http::async_write(stream_, *out_, written);
    }
  }

  beast::tcp_stream stream_;
  const answerer& answer_;
  streams& followers_;
  std::size_t& count_;
  beast::flat_buffer buffer_{longest_header};
  std::optional<beast::http::request_parser<beast::http::empty_body>> parser_;
  std::optional<beast_response> out_;
  std::optional<beast::http::response_serializer<beast::http::string_body>>
      serializer_;
};

tcp::endpoint endpoint_of(asio::io_context& io, const network_address& at) {
  error_code problem;
  tcp::resolver resolver{io};
  const auto all = resolver.resolve(at.host, std::to_string(at.port),
                                    asio::ip::resolver_base::passive, problem);
  if (problem)
    throw network_error{
        fmt::format("{} has no address: {}", at.host, problem.message())};
  return all.begin()->endpoint();
}

} // namespace

class server::state {
public:
  state(const network_address& at, answerer answer, limits most)
      : answer_{std::move(answer)}, most_connections_{most.connections},
        followers_{io_, streams_, most.streams}, acceptor_{io_}, retry_{io_} {
    const auto endpoint = endpoint_of(io_, at);
    try {
      acceptor_.open(endpoint.protocol());
      acceptor_.set_option(tcp::acceptor::reuse_address{true});
      acceptor_.bind(endpoint);
      acceptor_.listen();
    } catch (const boost::system::system_error& problem) {
      throw network_error{
          fmt::format("cannot listen at {}: {}; choose another port or address",
                      print_address(at), problem.code().message())};
    }
    accept();
    thread_ = std::thread{[this] {
      leave_signals_to_others();
      pthread_setname_np(pthread_self(), "http"); // for `top -H`
      io_.run();
    }};
  }
  ~state() {
    io_.stop();
    thread_.join();
  }
  state(const state&) = delete;
  state& operator=(const state&) = delete;

  network_address address() const {
    const auto own = acceptor_.local_endpoint();
    return {own.address().to_string(), own.port()};
  }

private:
  void accept() {
    if (connections_ >= most_connections_) {
      later();
      return;
    }
    acceptor_.async_accept([this](error_code problem, tcp::socket socket) {
      if (problem == asio::error::operation_aborted)
        return;
      if (problem) { // no more files, say
        later();
        return;
      }
      std::make_shared<connection>(std::move(socket), answer_, followers_,
                                   connections_)
          ->read();
      accept();
    });
  }

  void later() {
    constexpr std::chrono::milliseconds soon{50};
    retry_.expires_after(soon);
    retry_.async_wait([this](error_code problem) {
      if (!problem)
        accept();
    });
  }

  // Connections, which the context holds, use what stands before it.
  answerer answer_;
  const std::size_t most_connections_;
  std::size_t connections_ = 0, streams_ = 0;
  asio::io_context io_{1};
  streams followers_;
  tcp::acceptor acceptor_;
  asio::steady_timer retry_;
  std::thread thread_;
};

server::server(const network_address& at, answerer answer, limits most)
    : state_{std::make_unique<state>(at, std::move(answer), most)} {}
server::~server() = default;

network_address server::address() const {
  return state_->address();
}

} // namespace sofof::network::http

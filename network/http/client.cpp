// Boost.Beast asks; a deadline ends what takes too long.
#include "network/http/client.hpp"

#include "network/network_error.hpp"

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <utility> // before Asio, which lacks it

namespace sofof::network::http {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using boost::system::error_code;

constexpr std::uint64_t longest_answer = 1U << 20;

/// One question and its answer; each step begins the next.
class exchange {
public:
  exchange(asio::io_context& io, const url& what) : resolver_{io}, stream_{io} {
    question_.version(11); // HTTP/1.1
    question_.method(beast::http::verb::get);
    question_.target(what.target);
    question_.set(beast::http::field::host, print_address(what.at));
    question_.set(beast::http::field::user_agent, "sofof");
    question_.keep_alive(false);
    answer_.body_limit(longest_answer);
    resolver_.async_resolve(what.at.host, std::to_string(what.at.port),
                            [this](error_code problem, auto all) {
                              if (goes_on(problem))
                                connect(all);
                            });
  }

  /// @returns what is known so far.
  bool is_done() const { return is_done_; }
  const error_code& problem() const { return problem_; }
  response answer() const {
    const auto& from = answer_.get();
    return {from.result_int(),
            std::string{from[beast::http::field::content_type]}, from.body()};
  }

private:
  bool goes_on(error_code problem) {
    problem_ = problem;
    is_done_ = is_done_ || problem;
    return !problem;
  }
  void connect(const tcp::resolver::results_type& all) {
    stream_.async_connect(all, [this](error_code problem, const auto&) {
      if (goes_on(problem))
        ask();
    });
  }
  void ask() {
    beast::http::async_write(stream_, question_,
                             [this](error_code problem, std::size_t) {
                               if (goes_on(problem))
                                 listen();
                             });
  }
  void listen() {
    beast::http::async_read(stream_, buffer_, answer_,
                            [this](error_code problem, std::size_t) {
                              goes_on(problem);
                              is_done_ = true;
                            });
  }

  tcp::resolver resolver_;
  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  beast::http::request<beast::http::empty_body> question_;
  beast::http::response_parser<beast::http::string_body> answer_;
  error_code problem_;
  bool is_done_ = false;
};

} // namespace

std::optional<url> parse_url(std::string_view text) {
  constexpr std::string_view scheme = "http://";
  if (!text.starts_with(scheme))
    return std::nullopt;
  text.remove_prefix(scheme.size());
  const auto slash = text.find('/');
  std::string authority{text.substr(0, slash)};
  const auto has_port = authority.find_last_of(':') != authority.npos
                        && !authority.ends_with(']');
  if (!has_port)
    authority += ":80";
  const auto at = parse_address(authority);
  if (!at)
    return std::nullopt;
  url found{*at};
  if (slash != text.npos)
    found.target = std::string{text.substr(slash)};
  for (const auto c : found.target)
    if (static_cast<unsigned char>(c) <= ' ' || c == '\x7f')
      return std::nullopt;
  return found;
}

response get(const url& what, std::chrono::milliseconds patience) {
  asio::io_context io{1};
  exchange all{io, what};
  io.run_for(patience);
  const auto where = print_address(what.at);
  if (!all.is_done())
    throw network_error{fmt::format("{} has not answered within {} ms", where,
                                    patience.count())};
  if (all.problem())
    throw network_error{
        fmt::format("{} does not answer: {}", where, all.problem().message())};
  return all.answer();
}

} // namespace sofof::network::http

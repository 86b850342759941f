// Boost.Beast asks; a deadline ends what takes too long.
#include "network/http/client.hpp"

#include "network/deadline.hpp"
#include "network/name_lookup.hpp"
#include "network/network_error.hpp"

#include <fmt/format.h>

#include <boost/asio/io_context.hpp>
#include <boost/asio/ip/tcp.hpp>
#include <boost/beast/core.hpp>
#include <boost/beast/http.hpp>
#include <cstring>
#include <memory>
#include <poll.h>
#include <system_error>
#include <utility> // before Asio, which lacks it
#include <vector>

namespace sofof::network::http {

namespace {

namespace asio = boost::asio;
namespace beast = boost::beast;
using asio::ip::tcp;
using boost::system::error_code;

using endpoints = std::vector<tcp::endpoint>;

/// @returns the addresses of a host: none that are found too late.
endpoints find_host(const network_address& at, deadline until) {
  const auto wake = std::make_shared<wake_up>();
  const name_lookup lookup{&resolve, at, wake};
  auto found = lookup.answer();
  for (auto now = deadline_clock::now(); !found && now < until;
       now = deadline_clock::now()) {
    pollfd answered{wake->fd(), POLLIN, 0};
    poll(&answered, 1, milliseconds_until(until, now));
    found = lookup.answer();
  }
  endpoints all;
  for (const auto& x : found ? *found : std::vector<socket_address>{}) {
    tcp::endpoint& to = all.emplace_back();
    to.resize(x.size);
    std::memcpy(to.data(), &x.storage, x.size);
  }
  return all;
}

/// One question and its answer; each step begins the next.
class exchange {
public:
  /// @param host  Outlives this.
  exchange(asio::io_context& io, const endpoints& host, const question& how,
           const url& what, std::uint64_t most_octets)
      : stream_{io} {
    question_.version(11); // HTTP/1.1
    question_.method_string(how.method);
    question_.target(what.target);
    question_.set(beast::http::field::host, print_address(what.at));
    question_.set(beast::http::field::user_agent, "sofof");
    if (!how.type.empty())
      question_.set(beast::http::field::content_type, how.type);
    question_.body() = how.body;
    question_.prepare_payload();
    question_.keep_alive(false);
    answer_.body_limit(most_octets);
    stream_.async_connect(host, [this](error_code problem, const auto&) {
      if (goes_on(problem))
        ask();
    });
  }

  /// @returns what is known so far.
  bool is_done() const { return is_done_; }
  const error_code& problem() const { return problem_; }
  response answer() const {
    const auto& from = answer_.get();
    return {from.result_int(),
            std::string{from[beast::http::field::content_type]}, from.body(),
            std::string{from[beast::http::field::location]}};
  }

private:
  bool goes_on(error_code problem) {
    problem_ = problem;
    is_done_ = is_done_ || problem;
    return !problem;
  }
  void ask() {
    beast::http::async_write(stream_, question_,
                             [this](error_code problem, std::size_t) {
                               if (goes_on(problem))
                                 listen();
                             });
  }
  // In two steps: Beast forgets its own limit when the first octets of a body
  // come along with the header.
  void listen() {
    beast::http::async_read_header(stream_, buffer_, answer_,
                                   [this](error_code problem, std::size_t) {
                                     if (goes_on(problem))
                                       listen_on();
                                   });
  }
  void listen_on() {
    beast::http::async_read(stream_, buffer_, answer_,
                            [this](error_code problem, std::size_t) {
                              goes_on(problem);
                              is_done_ = true;
                            });
  }

  beast::tcp_stream stream_;
  beast::flat_buffer buffer_;
  beast::http::request<beast::http::string_body> question_;
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

response ask(const question& how, const url& what, const bounds& within) {
  const auto until = deadline_clock::now() + within.patience;
  const auto where = print_address(what.at);
  endpoints host;
  try {
    host = find_host(what.at, until);
  } catch (const std::system_error& problem) { // no more threads, or files
    throw network_error{
        fmt::format("cannot ask {}: {}", where, problem.what())};
  }
  if (host.empty())
    throw network_error{fmt::format(
        "{} has no address, or none was found in time", what.at.host)};
  asio::io_context io{1};
  exchange all{io, host, how, what, within.most_octets};
  io.run_until(until);
  if (!all.is_done())
    throw network_error{fmt::format("{} has not answered within {} ms", where,
                                    within.patience.count())};
  if (all.problem())
    throw network_error{
        fmt::format("{} does not answer: {}", where, all.problem().message())};
  return all.answer();
}

response get(const url& what, std::chrono::milliseconds patience) {
  return ask({}, what, {patience});
}

} // namespace sofof::network::http

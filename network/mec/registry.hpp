// Asks a registry of services of ETSI GS MEC 011 v2.2.1.
#pragma once

#include "network/http/client.hpp"
#include "network/mec/service_info.hpp"
#include "network/network_error.hpp"

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>

namespace sofof::network::mec011 {

/// Reads the root of a registry's interfaces, "http://HOST[:PORT][/PATH]".
/// @returns it, without "/" at the end. @throws network_error for anything
/// else, and for https.
http::url parse_root(std::string_view text);

/// @returns the root, for people.
std::string print_root(const http::url& root);

/// The registry has answered, but does not do what it was asked for.
class registry_refusal : public network_error {
public:
  using network_error::network_error;
};

/// What has become of a registry, for people and events.
struct registry_news {
  bool is_well = true; ///< It answers as it should.
  std::string sentence;
};

/// A registry, whose answers are not believed but read. All functions ask it
/// once, for 1 s at most, and throw network_error with a sentence when that
/// comes to nothing; a redirection is not followed.
class registry {
public:
  using asker =
      std::function<http::response(const http::question&, const http::url&)>;

  /// @param ask  For tests.
  explicit registry(http::url root, asker ask = &registry::ask_by_http)
      : root_{std::move(root)}, ask_{std::move(ask)} {}

  const http::url& root() const { return root_; }

  /// @returns all providers that it knows.
  service_list providers() const;

  // -- of an application, whose id the platform has given ------------------

  /// @returns its providers.
  service_list providers_of(const std::string& application) const;

  /// Adds one. @returns the id that the registry has given it.
  std::string add(const std::string& application,
                  const service_info& what) const;

  /// @returns one; nothing: it does not know it.
  std::optional<service_info> find(const std::string& application,
                                   const std::string& id) const;

  /// Changes one that it knows.
  void update(const std::string& application, const service_info& what) const;

  /// Removes one, if it knows it.
  void remove(const std::string& application, const std::string& id) const;

  /// Tells that the application is up and running.
  void confirm_ready(const std::string& application) const;

private:
  static http::response ask_by_http(const http::question& how,
                                    const http::url& what);
  http::response ask(std::string_view method, const std::string& target,
                     std::string body = {}) const;
  /// @throws registry_refusal about an answer.
  [[noreturn]] void complain(std::string_view method,
                             const http::response& answer) const;
  service_list list(const std::string& target) const;

  http::url root_;
  asker ask_;
};

} // namespace sofof::network::mec011

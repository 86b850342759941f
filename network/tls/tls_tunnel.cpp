// Bytes from side to side.
#include "network/tls/tls_tunnel.hpp"

#include "network/keys/certificate.hpp"

#include <span>
#include <sys/epoll.h>
#include <utility>

namespace sofof::network {

namespace {

std::uint32_t events_of(byte_stream::state waits) {
  switch (waits) {
    case byte_stream::state::waits_to_read:
      return EPOLLIN;
    case byte_stream::state::waits_to_write:
      return EPOLLOUT;
    default:
      return 0;
  }
}

bool is_over(byte_stream::state what) {
  return what == byte_stream::state::closed
         || what == byte_stream::state::failed;
}

} // namespace

tls_tunnel::tls_tunnel(byte_stream far, byte_stream near, end_handler on_end)
    : far_{std::move(far)}, near_{std::move(near)}, on_end_{std::move(on_end)} {
}

tls_tunnel::turn tls_tunnel::move() {
  constexpr int most_shifts = 8;
  turn t;
  for (int i = 0; i < most_shifts; ++i) {
    const auto out = shift(near_, far_, outward_);
    const auto in = shift(far_, near_, inward_);
    t.more = out || in;
    t.moved = t.moved || t.more;
    if (!t.more)
      break;
  }
  using cause = tunnel_end::cause;
  t.ended = has_ended(inward_, cause::far_closed, cause::near_closed)
            || has_ended(outward_, cause::near_closed, cause::far_closed);
  update_events();
  return t;
}

bool tls_tunnel::shift(byte_stream& from, byte_stream& to, flow& f) {
  bool moved = false;
  if (f.is_empty() && !f.source_closed) {
    const auto [what, size] = from.read(*f.bytes);
    f.read_waits = what;
    f.source_closed = is_over(what);
    f.begin = 0;
    f.end = size;
    moved = size > 0;
  }
  if (!f.is_empty()) {
    const auto [what, size] =
        to.write(std::span{*f.bytes}.subspan(f.begin, f.end - f.begin));
    f.write_waits = what;
    f.begin += size;
    f.moved += size;
    moved = moved || size > 0;
  }
  return moved;
}

bool tls_tunnel::has_ended(const flow& f, tunnel_end::cause source,
                           tunnel_end::cause sink) {
  if (is_over(f.write_waits))
    closed_by_ = sink;
  else if (f.source_closed && f.is_empty())
    closed_by_ = source;
  else
    return false;
  return true;
}

void tls_tunnel::update_events() {
  const auto reads = [](const flow& f) {
    return f.is_empty() ? events_of(f.read_waits) : 0;
  };
  const auto writes = [](const flow& f) {
    return f.is_empty() ? 0 : events_of(f.write_waits);
  };
  far_events_ = reads(inward_) | writes(outward_);
  near_events_ = reads(outward_) | writes(inward_);
}

void tls_tunnel::end_distrusted(std::string why) {
  if (const auto handler = std::exchange(on_end_, nullptr))
    handler({tunnel_end::cause::distrusted, std::move(why), inward_.moved});
}

std::string tls_tunnel::distrust(const revocation_list& revoked) const {
  const auto* certificate = far_.certificate();
  if (!certificate)
    return {};
  if (revoked.contains(*certificate))
    return "its certificate has been revoked";
  return has_expired(*certificate) ? "its certificate has expired" : "";
}

void tls_tunnel::end(tunnel_end::cause why) {
  if (const auto handler = std::exchange(on_end_, nullptr))
    handler({why, far_.failure(), inward_.moved});
}

} // namespace sofof::network

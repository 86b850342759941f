// A capture of all ITS messages of a run.
#include "recording/pcap_file.hpp"

#include "messages/etsi/cam.hpp"
#include "messages/etsi/cpm_tr103562.hpp"
#include "messages/etsi/cpm_ts103324.hpp"
#include "messages/etsi/mcm.hpp"
#include "messages/etsi/uper.hpp"
#include "messages/v2x/geonet.hpp"

#include <concepts>
#include <string_view>
#include <utility>

namespace sofof::recording {

namespace {

constexpr std::uint32_t with_nanoseconds = 0xa1b23c4d;
constexpr std::uint32_t longest_packet = 65535;
constexpr std::uint32_t ethernet = 1;
constexpr std::int64_t per_second = 1'000'000'000;

constexpr std::string_view other_file = "another file with --pcap";

/// As this machine has it; readers find out by the first number.
void append_octets(std::string& out, std::integral auto x) {
  out.append(reinterpret_cast<const char*>(&x), sizeof x);
}

/// What the network layer knows of a message.
struct envelope {
  messages::geonet_sender from;
  std::uint16_t port = 0;
};

template <class Position>
void locate(messages::geonet_sender& from, std::uint8_t type,
            const Position& at) {
  from.station_type = type;
  from.latitude = at.latitude;
  from.longitude = at.longitude;
  from.is_mobile = type != messages::etsi::roadside_unit;
}

/// What is unavailable goes out as 0: the network layer has no word for it.
void set_in_motion(messages::geonet_sender& from, std::uint16_t speed,
                   std::uint16_t heading) {
  if (speed != messages::etsi::speed_unavailable)
    from.speed_cmps = speed;
  if (heading != messages::etsi::heading_unavailable)
    from.heading = heading;
}

void describe(envelope& out, const messages::etsi::cam& message) {
  const auto& x = message.body.parameters;
  out.port = messages::btp_port::cam;
  locate(out.from, x.basic.station_type, x.basic.position);
  if (const auto* motion = std::get_if<messages::etsi::vehicle_high_frequency>(
          &x.high_frequency.value))
    set_in_motion(out.from, motion->speed.value, motion->heading.value);
}

void describe(envelope& out, const messages::etsi::tr103562::cpm& message) {
  const auto& x = message.body.parameters;
  out.port = messages::btp_port::cpm;
  locate(out.from, x.management.station_type, x.management.position);
  if (const auto* sender =
          x.station_data
              ? std::get_if<messages::etsi::tr103562::originating_vehicle>(
                  &x.station_data->value)
              : nullptr)
    set_in_motion(out.from, sender->speed.value, sender->heading.value);
}

void describe(envelope& out, const messages::etsi::ts103324::cpm& message) {
  out.port = messages::btp_port::cpm;
  locate(out.from, messages::etsi::passenger_car,
         message.body.management.position);
}

void describe(envelope& out, const messages::etsi::mcm& message) {
  const auto& x = message.body.parameters;
  out.port = messages::btp_port::mcm;
  locate(out.from, x.basic.station_type, x.basic.position);
  if (const auto* user =
          std::get_if<messages::etsi::road_user_container>(&x.maneuver.value))
    set_in_motion(out.from, user->state.speed, user->state.heading);
}

template <class Message>
bool describe_if(envelope& out, const messages::its_pdu& pdu) {
  Message message;
  if (!messages::etsi::decode(pdu.view(), message))
    return false;
  out.from.station = message.header.station;
  describe(out, message);
  return true;
}

envelope envelope_of(const messages::its_pdu& pdu) {
  envelope out;
  describe_if<messages::etsi::cam>(out, pdu)
      || describe_if<messages::etsi::mcm>(out, pdu)
      || describe_if<messages::etsi::tr103562::cpm>(out, pdu)
      || describe_if<messages::etsi::ts103324::cpm>(out, pdu);
  return out;
}

} // namespace

void pcap_file::check(const std::filesystem::path& path) {
  output_file::check(path, other_file);
}

pcap_file::pcap_file(std::filesystem::path path,
                     messages::etsi::its_clock clock)
    : file_{std::move(path), other_file}, clock_{clock} {
  auto& out = file_.text();
  append_octets(out, with_nanoseconds);
  append_octets(out, std::uint16_t{2}); // version 2.4
  append_octets(out, std::uint16_t{4});
  append_octets(out, std::int32_t{0});  // times are UTC
  append_octets(out, std::uint32_t{0}); // accuracy
  append_octets(out, longest_packet);
  append_octets(out, ethernet);
}

void pcap_file::write(const messages::air_record& x) {
  auto to = envelope_of(x.message);
  to.from.at_ms = static_cast<std::uint64_t>(clock_.timestamp(x.at));
  std::string frame;
  messages::append_frame(frame, to.from, to.port, x.message.view());
  const auto ns = clock_.unix_time(x.at).count();
  auto& out = file_.text();
  append_octets(out, static_cast<std::uint32_t>(ns / per_second));
  append_octets(out, static_cast<std::uint32_t>(ns % per_second));
  append_octets(out, static_cast<std::uint32_t>(frame.size()));
  append_octets(out, static_cast<std::uint32_t>(frame.size()));
  out += frame;
  file_.end_line();
}

} // namespace sofof::recording

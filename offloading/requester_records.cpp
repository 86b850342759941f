// What a requester records of its decisions.
#include "messages/protocol/record.hpp"
#include "offloading/requester.hpp"

namespace sofof::offloading {

void requester::log_verdict(const service_state& service, provider_id provider,
                            std::uint32_t counter, std::string_view why,
                            bool accepted, time_point now) {
  const auto& name = service.service.name;
  port_.record(messages::decision_record{now, setup_.station, name, accepted});
  log(accepted ? messages::event_type::accepted : messages::event_type::refused,
      {provider, setup_.station, name, counter}, why, now);
}

void requester::log_switch(const messages::session_id& session, bool remote,
                           time_point now) {
  port_.record(messages::event_record{.at = now,
                                      .what = messages::event_type::switched,
                                      .station = setup_.station,
                                      .provider = session.provider,
                                      .service = session.service,
                                      .counter = session.counter,
                                      .detail = remote ? "remote" : "local",
                                      .remote = remote});
}

void requester::log(messages::event_type what,
                    const messages::session_id& session,
                    std::string_view detail, time_point now) {
  port_.record(messages::event_record{.at = now,
                                      .what = what,
                                      .station = setup_.station,
                                      .provider = session.provider,
                                      .service = session.service,
                                      .counter = session.counter,
                                      .detail = std::string{detail}});
}

} // namespace sofof::offloading

// sofof keys: a private CA, and certificates for vehicles and providers.
#include "apps/command.hpp"
#include "base/input_error.hpp"
#include "network/keys/key_store.hpp"
#include "network/keys/station_list.hpp"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace sofof::apps {

namespace {

struct issue_arguments {
  std::string folder;
  std::string stations;
  std::string provider;
  std::string out;
  int days = network::issue_options{}.days;
};

struct init_arguments {
  std::string folder;
  std::string stations;
  std::vector<std::string> providers;
};

struct renew_arguments {
  std::string folder;
  std::string of;
  int days = network::issue_options{}.days;
};

struct revoke_arguments {
  std::string folder;
  std::string stations;
  std::string provider;
  std::string serial;
};

std::vector<station_id> stations_in(const std::string& list) {
  auto stations = network::parse_stations(list);
  if (!stations)
    throw input_error{fmt::format(
        "--station {}: that is no list of stations; 101, 101-106 and "
        "101-106,110 are, of at most {}",
        list, network::most_stations)};
  return *std::move(stations);
}

network::peer_identity identity_in(const std::string& stations,
                                   const std::string& provider) {
  if (!provider.empty())
    return {{}, provider};
  return {stations_in(stations), {}};
}

void init(const init_arguments& args) {
  network::permitted_names names;
  if (!args.stations.empty())
    names.stations = stations_in(args.stations);
  names.providers = args.providers;
  network::init_keys(args.folder, names);
  std::cout << fmt::format("{0}/ca.pem, {0}/ca_key.pem: a new CA. Keep "
                           "ca_key.pem here; no host needs it.\n",
                           args.folder);
}

void issue(const issue_arguments& args) {
  const auto who = identity_in(args.stations, args.provider);
  network::issue_options options{args.days, {}};
  if (!args.out.empty())
    options.out = args.out;
  const auto written = network::issue_keys(args.folder, who, options);
  std::cout << fmt::format("{}: ca.pem, cert.pem, key.pem for {}, valid for {} "
                           "days.\nCopy the folder to its host; key.pem is "
                           "secret.\n",
                           written.string(), network::describe(who), args.days);
}

void renew(const renew_arguments& args) {
  const auto who = network::renew_keys(args.folder, args.of, args.days);
  std::cout << fmt::format("{}: ca.pem, cert.pem, key.pem for {}, valid for {} "
                           "days.\nCopy the folder to its host, and send "
                           "SIGHUP to what runs there.\n",
                           args.of, network::describe(who), args.days);
}

void revoke(const revoke_arguments& args) {
  network::revocation_choice which{{}, args.serial};
  if (args.serial.empty())
    which.who = identity_in(args.stations, args.provider);
  const auto revoked = network::revoke_keys(args.folder, which);
  for (const auto& name : revoked)
    std::cout << fmt::format("revoked: {}\n", name);
  if (revoked.empty())
    std::cout << "all of these have been revoked before\n";
  std::cout << fmt::format("Copy {}/revoked into the key folder of every host, "
                           "and send SIGHUP to what runs there.\n",
                           args.folder);
}

/// Whom a command is about: stations or a provider.
CLI::Option_group& add_names(CLI::App& command, std::string& stations,
                             std::string& provider, const char* which) {
  auto& names = *command.add_option_group("names");
  names.add_option("--station", stations, which)->type_name("LIST");
  names.add_option("--provider", provider, "Name of a provider")
      ->type_name("NAME");
  names.require_option(1);
  return names;
}

void add_days(CLI::App& command, int& days) {
  command.add_option("--days", days, "How long it is valid")
      ->capture_default_str()
      ->type_name("N");
}

void add_folder(CLI::App& command, std::string& folder, const char* what) {
  command.add_option("DIR", folder, what)->required()->type_name(" ");
}

} // namespace

void add_keys(CLI::App& app, int&) {
  auto* keys = app.add_subcommand(
      "keys", "Make a private CA and certificates for vehicles and providers");
  keys->require_subcommand(1);
  keys->footer("Example:\n  sofof keys init keys\n"
               "  sofof keys issue keys --provider mec\n"
               "  sofof keys issue keys --station 101-106\n"
               "  sofof keys renew keys keys/station-101-106\n"
               "  sofof keys revoke keys --station 101-106");

  auto* init_command = keys->add_subcommand("init", "Make a private CA");
  auto init_args = std::make_shared<init_arguments>();
  add_folder(*init_command, init_args->folder, "Folder for the CA");
  init_command
      ->add_option("--station", init_args->stations,
                   "Stations that it may name, and no others")
      ->type_name("LIST");
  init_command
      ->add_option("--provider", init_args->providers,
                   "Provider that it may name; may be given several times")
      ->type_name("NAME")
      ->take_all()
      ->expected(1);
  init_command->callback([init_args] { init(*init_args); });

  auto* issue_command =
      keys->add_subcommand("issue", "Make a key and its certificate");
  auto args = std::make_shared<issue_arguments>();
  add_folder(*issue_command, args->folder, "Folder of the CA");
  add_names(*issue_command, args->stations, args->provider,
            "Stations that it speaks for, e.g. 101-106,110");
  add_days(*issue_command, args->days);
  issue_command
      ->add_option("--out", args->out,
                   "Folder to write; otherwise one in DIR, named after them")
      ->type_name("DIR");
  issue_command->callback([args] { issue(*args); });

  auto* renew_command = keys->add_subcommand(
      "renew", "Make a new key and certificate for the same peer");
  auto renew_args = std::make_shared<renew_arguments>();
  add_folder(*renew_command, renew_args->folder, "Folder of the CA");
  renew_command->add_option("KEYS", renew_args->of, "Folder of the certificate")
      ->required()
      ->type_name(" ");
  add_days(*renew_command, renew_args->days);
  renew_command->callback([renew_args] { renew(*renew_args); });

  auto* revoke_command =
      keys->add_subcommand("revoke", "Take certificates back");
  auto revoke_args = std::make_shared<revoke_arguments>();
  add_folder(*revoke_command, revoke_args->folder, "Folder of the CA");
  add_names(*revoke_command, revoke_args->stations, revoke_args->provider,
            "All certificates of these stations, e.g. 101-106,110")
      .add_option("--serial", revoke_args->serial,
                  "The certificate with this serial number")
      ->type_name("HEX");
  revoke_command->callback([revoke_args] { revoke(*revoke_args); });
}

} // namespace sofof::apps

// sofof keys: a private CA, and certificates for vehicles and providers.
#include "apps/command.hpp"
#include "network/key_store.hpp"
#include "network/station_list.hpp"
#include "scenario/input_error.hpp"

#include <fmt/format.h>

#include <iostream>
#include <memory>
#include <string>

namespace sofof {

namespace {

struct issue_arguments {
  std::string folder;
  std::string stations;
  std::string provider;
  std::string out;
  int days = issue_options{}.days;
};

peer_identity identity_in(const issue_arguments& args) {
  if (!args.provider.empty())
    return {{}, args.provider};
  auto stations = parse_stations(args.stations);
  if (!stations)
    throw input_error{fmt::format(
        "--station {}: that is no list of stations; 101, 101-106 and "
        "101-106,110 are, of at most {}",
        args.stations, most_stations)};
  return {std::move(*stations), {}};
}

void init(const std::string& folder) {
  init_keys(folder);
  std::cout << fmt::format("{0}/ca.pem, {0}/ca_key.pem: a new CA. Keep "
                           "ca_key.pem here; no host needs it.\n",
                           folder);
}

void issue(const issue_arguments& args) {
  const auto who = identity_in(args);
  issue_options options{args.days, {}};
  if (!args.out.empty())
    options.out = args.out;
  const auto written = issue_keys(args.folder, who, options);
  std::cout << fmt::format("{}: ca.pem, cert.pem, key.pem for {}, valid for {} "
                           "days.\nCopy the folder to its host; key.pem is "
                           "secret.\n",
                           written.string(), describe(who), args.days);
}

} // namespace

void add_keys(CLI::App& app, int&) {
  auto* keys = app.add_subcommand(
      "keys", "Make a private CA and certificates for vehicles and providers");
  keys->require_subcommand(1);
  keys->footer("Example:\n  sofof keys init keys\n"
               "  sofof keys issue keys --provider mec\n"
               "  sofof keys issue keys --station 101-106");

  auto* init_command = keys->add_subcommand("init", "Make a private CA");
  auto folder = std::make_shared<std::string>();
  init_command->add_option("DIR", *folder, "Folder for the CA")
      ->required()
      ->type_name(" ");
  init_command->callback([folder] { init(*folder); });

  auto* issue_command =
      keys->add_subcommand("issue", "Make a key and its certificate");
  auto args = std::make_shared<issue_arguments>();
  issue_command->add_option("DIR", args->folder, "Folder of the CA")
      ->required()
      ->type_name(" ");
  auto* names = issue_command->add_option_group("names");
  names
      ->add_option("--station", args->stations,
                   "Stations that it speaks for, e.g. 101-106,110")
      ->type_name("LIST");
  names->add_option("--provider", args->provider, "Name of a provider")
      ->type_name("NAME");
  names->require_option(1);
  issue_command->add_option("--days", args->days, "How long it is valid")
      ->capture_default_str()
      ->type_name("N");
  issue_command
      ->add_option("--out", args->out,
                   "Folder to write; otherwise one in DIR, named after them")
      ->type_name("DIR");
  issue_command->callback([args] { issue(*args); });
}

} // namespace sofof

// Which seeds have been tried, and what came out.
#include "experiments/torture/seed_log.hpp"

#include "base/files/output_file.hpp"
#include "base/text/csv.hpp"
#include "base/text/csv_reader.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <cstdio>
#include <memory>
#include <set>
#include <utility>
#include <vector>

namespace sofof::experiments::torture {

namespace fs = std::filesystem;

namespace {

constexpr std::array<std::string_view, 3> first_columns{"seed", "program",
                                                        "broken"};

std::vector<std::string_view> columns() {
  std::vector<std::string_view> all(first_columns.begin(), first_columns.end());
  all.insert(all.end(), counted_names.begin(), counted_names.end());
  return all;
}

bool is_log(const fs::path& file) {
  return file.filename().string().starts_with("seeds")
         && file.extension() == ".csv";
}

} // namespace

seed_log::seed_log(const fs::path& folder, std::string_view own,
                   std::string program)
    : own_{folder / own}, program_{std::move(program)} {
  std::set<fs::path> files; // in the order of their names
  for (const auto& entry : fs::directory_iterator{folder})
    if (is_log(entry.path()))
      files.insert(entry.path());
  for (const auto& file : files)
    read(file);
  if (!files.contains(own_))
    write_file(own_, fmt::format("{}\n", fmt::join(columns(), ",")));
}

void seed_log::read(const fs::path& file) {
  const auto wanted = columns();
  csv_reader rows{file, wanted, csv_reader::ending::killed};
  while (rows.next()) {
    tried_seed one;
    one.program = rows.text(1);
    one.broken = rows.text(2);
    for (std::size_t k = 0; k < counted_names.size(); ++k)
      one.counts.sums()[k] = rows.number(first_columns.size() + k);
    seeds_.insert_or_assign(rows.whole(0), std::move(one));
  }
}

void seed_log::add(std::uint64_t seed, const verdict& v) {
  std::set<std::string> promises;
  for (const auto& x : v.broken)
    promises.insert(x.promise);
  tried_seed one{v.counts, fmt::format("{}", fmt::join(promises, " ")),
                 program_};
  auto line = fmt::format("{},", seed);
  append(line, program_);
  line += ',' + one.broken;
  for (const auto x : v.counts.sums())
    line += fmt::format(",{}", x);
  line += '\n';
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file{
      std::fopen(own_.c_str(), "a"), &std::fclose};
  if (!file
      || std::fwrite(line.data(), 1, line.size(), file.get()) != line.size()
      || std::fflush(file.get()) != 0)
    refuse_to_write(fmt::format("{} cannot be written", own_.string()), errno);
  seeds_.insert_or_assign(seed, std::move(one));
}

tally seed_log::sum() const {
  tally all;
  for (const auto& [seed, one] : seeds_)
    all += one.counts;
  return all;
}

} // namespace sofof::experiments::torture

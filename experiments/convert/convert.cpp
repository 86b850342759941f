// By the ending of the file.
#include "experiments/convert/convert.hpp"

#include "base/files/output_file.hpp"
#include "base/input_error.hpp"
#include "experiments/convert/formats.hpp"
#include "recording/results_folder.hpp"

#include <fmt/format.h>

#include <string>
#include <system_error>

namespace sofof::experiments::convert {

namespace {

namespace fs = std::filesystem;

struct format {
  std::string_view ending;
  void (*write)(const recorded_drive&, const sink&);
};

constexpr format formats[]{{".mcap", write_mcap},
                           {".fcd.xml", write_fcd},
                           {".geojson", write_geojson},
                           {".latencies.csv", write_latencies}};

const format& format_of(const fs::path& file) {
  const auto name = file.filename().string();
  for (const auto& one : formats)
    if (name.ends_with(one.ending) && name.size() > one.ending.size())
      return one;
  throw input_error{fmt::format("{}: the ending says the format; choose a name "
                                "that ends with .mcap, .fcd.xml, .geojson or "
                                ".latencies.csv.",
                                file.string())};
}

/// A file under another name until it is complete.
class growing_file {
public:
  explicit growing_file(fs::path to)
      : to_{std::move(to)}, part_{to_.string() + ".part"},
        file_{part_, "another file with -o"} {}
  ~growing_file() {
    std::error_code gone;
    fs::remove(part_, gone); // no longer there once it is complete
  }
  growing_file(const growing_file&) = delete;
  growing_file& operator=(const growing_file&) = delete;

  void put(std::string_view text) {
    file_.text() += text;
    file_.end_line();
  }
  void complete() {
    file_.close();
    fs::rename(part_, to_);
  }

private:
  fs::path to_, part_;
  output_file file_;
};

} // namespace

void convert(const fs::path& folder, const fs::path& file) {
  const auto& how = format_of(file);
  const auto drive = open_drive(folder);
  output_file::check(file, "another file with -o");
  growing_file to{file};
  how.write(drive, [&to](std::string_view text) { to.put(text); });
  to.complete();
}

} // namespace sofof::experiments::convert

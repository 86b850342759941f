// Messages that other codecs made, beside what those codecs read in them. They
// lie outside of the repository. Of our own are the same: known octets in
// cam_test, both CPMs' and mcm_test, round trips in json_test and mcm_test, the
// first protocol version in cam_test.
#include "messages/etsi/hex.hpp"
#include "messages/etsi/json.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace sofof::messages::etsi {
namespace {

using json = nlohmann::ordered_json;

const std::filesystem::path folder{SOFOF_SOURCE_DIR "/../shared/data/v2x"};

bool is_there(const std::string& file) {
  if (std::filesystem::exists(folder / file))
    return true;
  MESSAGE("SKIPPED: no " << (folder / file).string());
  return false;
}

std::vector<std::string> lines_of(const std::string& file) {
  std::ifstream in{folder / file};
  std::vector<std::string> lines;
  for (std::string line; std::getline(in, line);)
    if (!line.empty())
      lines.push_back(line);
  return lines;
}

json json_of(const std::string& hex) {
  const auto [m, error] = decode_message(*octets_from_hex(hex));
  CAPTURE(error);
  REQUIRE(m);
  std::string text;
  append_json(text, *m);
  return json::parse(text);
}

/// What another codec printed: a tree of names and texts.
struct node {
  std::string name, type, text;
  std::vector<node> parts;
};

/// Whether another codec read the same as we did.
bool is_same(const json& ours, const node& theirs);

bool are_same(const json& ours, const std::vector<node>& theirs) {
  if (ours.size() != theirs.size())
    return false;
  auto part = theirs.begin();
  for (const auto& [name, value] : ours.items()) {
    const auto named = ours.is_object() ? name == part->name : true;
    if (!named || !is_same(value, *part++))
      return false;
  }
  return true;
}

/// The dump of the MCM names a choice by its type: "RoadUserContainer".
bool is_alternative(const json& ours, const node& theirs) {
  if (!ours.is_object() || ours.size() != 1 || theirs.type.empty())
    return false;
  auto type = theirs.type;
  type[0] = static_cast<char>(std::tolower(type[0]));
  return ours.begin().key() == type;
}

bool is_same(const json& ours, const node& theirs) {
  auto same = false;
  if (is_alternative(ours, theirs))
    same = are_same(*ours.begin(), theirs.parts);
  else if (theirs.name == "containerData" && theirs.parts.size() == 1)
    same = are_same(ours, theirs.parts[0].parts); // named once more by its type
  else if (ours.is_structured())
    same = are_same(ours, theirs.parts);
  else if (ours.is_string() && theirs.parts.size() == 1) // <name/>
    same = ours == theirs.parts[0].name;
  else if (ours.is_string()) // 15 (name), or bits
    same = ours == theirs.text
           || theirs.text.ends_with("(" + ours.get<std::string>() + ")");
  else if (ours.is_boolean() && theirs.parts.size() == 1) // <true/>
    same = ours.dump() == theirs.parts[0].name;
  else if (ours.is_boolean())
    same = theirs.text == (ours.get<bool>() ? "TRUE" : "FALSE");
  else
    same = ours.dump() == theirs.text;
  if (!same)
    MESSAGE(theirs.name << ": " << ours.dump().substr(0, 200) << ", not "
                        << theirs.text);
  return same;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view white = " \r\n\t";
  const auto begin = text.find_first_not_of(white);
  if (begin == text.npos)
    return {};
  return text.substr(begin, text.find_last_not_of(white) + 1 - begin);
}

/// Reads elements without attributes, one after the other.
std::vector<node> read_xml(std::string_view& text) {
  std::vector<node> parts;
  for (;;) {
    const auto open = text.find('<');
    if (open == text.npos || text[open + 1] == '/')
      return parts;
    const auto close = text.find('>', open);
    auto name = text.substr(open + 1, close - open - 1);
    text.remove_prefix(close + 1);
    auto& part = parts.emplace_back();
    part.name = name;
    if (name.ends_with('/')) {
      part.name.pop_back();
      continue;
    }
    part.text = trimmed(text.substr(0, text.find('<')));
    part.parts = read_xml(text);
    text.remove_prefix(text.find('>') + 1);
  }
}

/// Reads lines of `name: Type ::= {`, `name: text`, `text` and `}`.
std::vector<node> read_dump(std::istream& in) {
  std::vector<node> parts;
  for (std::string line; std::getline(in, line);) {
    line.erase(0, line.find_first_not_of(' '));
    if (line == "}")
      return parts;
    if (line.empty())
      continue;
    auto& part = parts.emplace_back();
    if (const auto colon = line.find(": "); colon != line.npos) {
      part.name = line.substr(0, colon);
      line.erase(0, colon + 2);
    }
    if (const auto type = line.find(" ::= {"); type != line.npos) {
      part.type = line.substr(0, type);
      part.parts = read_dump(in);
    } else {
      part.text = line;
    }
  }
  return parts;
}

void check_round_trips(const std::string& file, std::size_t count) {
  CAPTURE(file);
  const auto lines = lines_of(file);
  CHECK(lines.size() == count);
  for (const auto& hex : lines) {
    const auto octets = *octets_from_hex(hex);
    const auto decoded = decode_message(octets);
    CAPTURE(decoded.error);
    REQUIRE(decoded.value);
    CHECK(encode_message(*decoded.value).value == octets);
    std::string text;
    append_json(text, *decoded.value);
    const auto read = message_from_json(text);
    CAPTURE(read.error);
    REQUIRE(read.value);
    CHECK(encode_message(*read.value).value == octets);
  }
}

void check_fields(const std::string& file, const std::vector<node>& theirs) {
  CAPTURE(file);
  const auto lines = lines_of(file);
  REQUIRE(lines.size() >= theirs.size());
  REQUIRE(!theirs.empty());
  for (std::size_t i = 0; i < theirs.size(); ++i) {
    CAPTURE(i);
    CHECK(are_same(json_of(lines[i]), theirs[i].parts));
  }
}

} // namespace

TEST_CASE("messages of other codecs come back octet for octet") {
  for (const auto& [file, count] :
       {std::pair{"cam.hex", 150}, std::pair{"cpm_tr103562.hex", 100},
        std::pair{"cpm_ts103324.hex", 100}, std::pair{"mcm.hex", 100},
        std::pair{"real_cam_160B.hex", 1}})
    if (is_there(file))
      check_round_trips(file, static_cast<std::size_t>(count));
}

TEST_CASE("other codecs read the same fields") {
  for (const std::string kind : {"cam.hex", "cpm_tr103562.hex",
                                 "cpm_ts103324.hex", "real_cam_160B.hex"}) {
    auto file = kind.substr(0, kind.size() - 4);
    file += kind.starts_with("real") ? ".xer.xml" : "_first10.xer.xml";
    if (!is_there(file))
      continue;
    std::ifstream in{folder / file};
    const std::string text{std::istreambuf_iterator<char>{in}, {}};
    std::string_view rest = text;
    check_fields(kind, read_xml(rest));
  }
  if (is_there("mcm_first10.dump.txt")) {
    std::ifstream in{folder / "mcm_first10.dump.txt"};
    check_fields("mcm.hex", read_dump(in));
  }
}

TEST_CASE("a CAM of the first protocol version is refused, for a reason") {
  if (!is_there("negative_cam_pv1.hex"))
    return;
  const auto octets = *octets_from_hex(lines_of("negative_cam_pv1.hex").at(0));
  const auto [m, error] = decode_message(octets);
  CHECK(!m);
  CHECK(error.starts_with("a CAM of protocol version 1 is not known"));
}

} // namespace sofof::messages::etsi

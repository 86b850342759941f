// An XML file in memory, with the place of everything in it.
#pragma once

#include <cstddef>
#include <optional>
#include <pugixml.hpp>
#include <string>
#include <string_view>

namespace sofof::maps {

/// A document that believes nothing: what is missing, or is no number, is
/// refused with `FILE:LINE:COLUMN`.
class xml_file {
public:
  /// @param text  The content, UTF-8.
  /// @param file  What to call it in errors.
  /// @throws input_error with the place when it is no XML.
  xml_file(std::string_view text, std::string file);

  /// The element around everything else.
  pugi::xml_node root() const { return document_.document_element(); }

  /// @throws input_error that names the place of the element.
  [[noreturn]] void refuse(pugi::xml_node at, std::string_view why) const;

  /// @returns an attribute that has to be there, UTF-8.
  std::string_view text(pugi::xml_node at, const char* attribute) const;

  /// @returns a number that has to be there, finite and from `least` to
  /// `most`.
  double number(pugi::xml_node at, const char* attribute, double least = -1e7,
                double most = 1e7) const;
  std::optional<double> optional_number(pugi::xml_node at,
                                        const char* attribute,
                                        double least = -1e7,
                                        double most = 1e7) const;

  /// @param text  Of which the number is the whole.
  /// @param at    Where it stands.
  double to_number(std::string_view text, pugi::xml_node at,
                   double least = -1e7, double most = 1e7) const;

private:
  [[noreturn]] void refuse(std::ptrdiff_t offset, std::string_view why) const;

  std::string_view source_;
  std::string file_;
  pugi::xml_document document_;
};

} // namespace sofof::maps

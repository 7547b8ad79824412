#pragma once
// One XML file in memory, its elements with their place in the file, and the `$name` parameters
// that are replaced in every attribute. Used by the scene reader only.
#include <filesystem>
#include <map>
#include <pugixml.hpp>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/scene/xml/scene_node.h"

namespace nacre {

/// A parsed file. Not copyable: the document points into the text.
class XmlSource {
  public:
    /// Throws InputError if the file cannot be read or is not well-formed XML.
    explicit XmlSource(const std::filesystem::path& file);
    XmlSource(const XmlSource&) = delete;
    XmlSource& operator=(const XmlSource&) = delete;

    /// The one outermost element.
    pugi::xml_node root() const { return document_.first_child(); }
    SourceLocation locate(const pugi::xml_node& node) const;
    const std::filesystem::path& path() const { return path_; }
    /// Place of the element with this id, wherever it stands in the file; line 0 if there is none.
    SourceLocation find_id(std::string_view id) const;

    /// First number of the format's version; below 2 names are in camelCase.
    int version = 3;

  private:
    SourceLocation locate(std::ptrdiff_t offset) const;
    [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& message) const;
    void parse();

    std::filesystem::path path_;
    std::shared_ptr<const std::string> name_;
    std::string text_;
    std::vector<std::ptrdiff_t> line_starts_;
    pugi::xml_document document_;
};

/// Values for `$name`: those of the command line win over <default>.
class XmlParameters {
  public:
    explicit XmlParameters(const std::map<std::string, std::string>& defines);
    void set_default(const std::string& name, const std::string& value);
    /// `text` with all parameters replaced; throws at `where` if one is not defined.
    std::string substitute(std::string_view text, const SourceLocation& where);
    /// Throws if a value from the command line was never asked for.
    void check_all_used() const;

  private:
    std::map<std::string, std::string> values_;
    std::set<std::string> defines_, used_, asked_;
};

/// An element whose attributes have been checked and substituted.
class XmlElement {
  public:
    XmlElement(const XmlSource& source, const pugi::xml_node& node, XmlParameters& parameters);

    /// Throws if an attribute is not among `allowed` or one of `required` is missing or empty.
    void check_attributes(const std::vector<std::string>& required,
                          const std::vector<std::string>& optional = {}) const;
    bool has(const std::string& attribute) const { return attributes_.contains(attribute); }
    /// Empty if absent.
    std::string get(const std::string& attribute) const;
    [[noreturn]] void fail(const std::string& message) const;

    std::string tag;
    SourceLocation location;
    pugi::xml_node node;

  private:
    std::map<std::string, std::string> attributes_;
};

/// Today's snake_case for the camelCase names of Mitsuba 0.x: `sigmaS` is `sigma_s`.
std::string snake_case(std::string_view camel);

}  // namespace nacre

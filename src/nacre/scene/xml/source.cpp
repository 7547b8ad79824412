#include "nacre/scene/xml/source.h"
#include "nacre/text/names.h"
#include "nacre/text/whole_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <optional>
#include <sstream>

namespace nacre {
namespace {

constexpr std::string_view blanks = " \t\r\n";

struct Unbalanced {
    std::ptrdiff_t offset;
    std::string message;
};

/// Why the tags of `text` do not match: the element that is never closed, or the end tag that
/// closes nothing. The parser only knows where it gave up, which may be hundreds of lines later.
std::optional<Unbalanced> find_unbalanced(std::string_view text) {
    struct Open {
        std::string name;
        std::size_t offset;
    };
    std::vector<Open> open;
    for (std::size_t i = text.find('<'); i != text.npos; i = text.find('<', i)) {
        const std::string_view rest = text.substr(i);
        std::string_view end = ">";
        const bool markup = rest.starts_with("<!") || rest.starts_with("<?");
        if (rest.starts_with("<!--")) end = "-->";
        if (rest.starts_with("<![CDATA[")) end = "]]>";
        std::size_t close = i + 1;
        if (markup) {
            close = text.find(end, i);
        } else {
            // A '>' within a quoted attribute does not end the tag.
            for (char quote = 0; close < text.size() && (quote || text[close] != '>'); ++close)
                if (quote ? text[close] == quote : text[close] == '"' || text[close] == '\'')
                    quote = quote ? char(0) : text[close];
            if (close == text.size()) close = text.npos;
        }
        if (close == text.npos)
            return Unbalanced{static_cast<std::ptrdiff_t>(i),
                              markup ? "this comment or declaration is never closed"
                                     : "this tag is never closed: a '>' or a quote is missing"};
        if (!markup) {
            const bool closing = rest.starts_with("</");
            const std::size_t from = i + (closing ? 2 : 1);
            const std::size_t to = std::min(text.find_first_of(" \t\r\n/>", from), close);
            const std::string name(text.substr(from, to - from));
            if (!closing && text[close - 1] != '/') open.push_back({name, i});
            if (closing) {
                if (open.empty())
                    return Unbalanced{static_cast<std::ptrdiff_t>(i),
                                      fmt::format("</{}> closes nothing", name)};
                if (open.back().name != name)
                    return Unbalanced{
                        static_cast<std::ptrdiff_t>(open.back().offset),
                        fmt::format("<{0}> is never closed; </{0}> is missing before </{1}>",
                                    open.back().name, name)};
                open.pop_back();
            }
        }
        i = close;
    }
    if (open.empty()) return std::nullopt;
    return Unbalanced{static_cast<std::ptrdiff_t>(open.back().offset),
                      fmt::format("<{0}> is never closed; </{0}> is missing", open.back().name)};
}

std::string parse_error(pugi::xml_parse_status status) {
    switch (status) {
        case pugi::status_bad_attribute:
            return "an attribute is malformed; write name=\"value\"";
        case pugi::status_bad_comment:
            return "a comment is malformed or never closed; write <!-- text -->";
        case pugi::status_bad_cdata:
            return "a CDATA section is malformed or never closed";
        case pugi::status_bad_doctype:
            return "the document type declaration is malformed";
        case pugi::status_bad_pi:
            return "a declaration <? ... ?> is malformed or never closed";
        case pugi::status_bad_pcdata:
            return "text stands outside of all elements";
        case pugi::status_unrecognized_tag:
            return "a '<' is not followed by the name of an element";
        default:
            return "an element is malformed";
    }
}

}  // namespace

XmlSource::XmlSource(const std::filesystem::path& file)
    : path_(file), name_(std::make_shared<const std::string>(file.string())) {
    std::error_code error;
    if (std::filesystem::is_directory(file, error))
        throw InputError(fmt::format("{}: is a folder; name a scene file", *name_));
    auto text = read_whole_file(file);
    if (!text)
        throw InputError(
            fmt::format("{}: cannot be opened; is the name right and the file "
                        "readable?",
                        *name_));
    text_ = *std::move(text);
    if (text_.starts_with("\xEF\xBB\xBF")) text_.erase(0, 3);  // the mark of UTF-8
    line_starts_.push_back(0);
    for (std::size_t i = 0; i < text_.size(); ++i)
        if (text_[i] == '\n') line_starts_.push_back(static_cast<std::ptrdiff_t>(i) + 1);
    parse();
}

void XmlSource::parse() {
    const std::size_t first = text_.find_first_not_of(blanks);
    if (first == text_.npos) fail(0, "the file is empty");
    if (text_.find('\0') != text_.npos)
        fail(0, "is a binary file, not an XML scene; nacre reads Mitsuba 3's XML");
    if (path_.extension() == ".pbrt")
        fail(0,
             "is a pbrt scene, not an XML scene; nacre reads Mitsuba 3's XML, so convert it "
             "first");
    if (text_[first] != '<')
        fail(static_cast<std::ptrdiff_t>(first),
             "is not an XML scene; nacre reads Mitsuba 3's XML, which begins with <scene");

    const pugi::xml_parse_result result =
        document_.load_buffer(text_.data(), text_.size(), pugi::parse_default, pugi::encoding_utf8);
    if (!result) {
        if (const auto unbalanced = find_unbalanced(text_))
            fail(unbalanced->offset, unbalanced->message);
        fail(std::min<std::ptrdiff_t>(result.offset, static_cast<std::ptrdiff_t>(text_.size())),
             result.status == pugi::status_no_document_element ? "the file holds no element"
                                                               : parse_error(result.status));
    }
    if (const pugi::xml_node second = root().next_sibling())
        throw InputError(
            fmt::format("{}: only one outermost element is allowed", locate(second).str()));
}

SourceLocation XmlSource::locate(std::ptrdiff_t offset) const {
    offset = std::max<std::ptrdiff_t>(offset, 0);
    const auto line = std::upper_bound(line_starts_.begin(), line_starts_.end(), offset) - 1;
    return {name_, static_cast<int>(line - line_starts_.begin()) + 1,
            static_cast<int>(offset - *line) + 1};
}

SourceLocation XmlSource::locate(const pugi::xml_node& node) const {
    // pugixml's offset is that of the name, behind the '<'; of text it is the text itself.
    return locate(node.offset_debug() - (node.type() == pugi::node_element ? 1 : 0));
}

SourceLocation XmlSource::find_id(std::string_view id) const {
    const pugi::xml_node found = document_.find_node([&](const pugi::xml_node& n) {
        return std::string_view(n.name()) != "ref" && id == n.attribute("id").value();
    });
    return found ? locate(found) : SourceLocation{};
}

void XmlSource::fail(std::ptrdiff_t offset, const std::string& message) const {
    throw InputError(fmt::format("{}: {}", locate(offset).str(), message));
}

XmlParameters::XmlParameters(const std::map<std::string, std::string>& defines) : values_(defines) {
    for (const auto& [name, value] : defines) defines_.insert(name);
}

void XmlParameters::set_default(const std::string& name, const std::string& value) {
    asked_.insert(name);
    values_.emplace(name, value);
}

std::string XmlParameters::substitute(std::string_view text, const SourceLocation& where) {
    std::string out;
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '$') {
            out += text[i];
            continue;
        }
        const std::string_view rest = text.substr(i + 1);
        // The longest name that fits, so that $spp is not $s followed by "pp".
        const std::pair<const std::string, std::string>* best = nullptr;
        for (const auto& entry : values_)
            if (rest.starts_with(entry.first) && (!best || entry.first.size() > best->first.size()))
                best = &entry;
        if (!best) {
            const auto end = std::find_if_not(rest.begin(), rest.end(), [](unsigned char c) {
                return std::isalnum(c) || c == '_';
            });
            const std::string name(rest.begin(), end);
            std::vector<std::string> known;
            for (const auto& entry : values_) known.push_back(entry.first);
            const std::string near = nearest_name(name, known);
            const std::string mend = name.empty() ? std::string("a name must follow the '$'")
                                     : near.empty()
                                         ? fmt::format("give it by <default> or -D {}=...", name)
                                         : fmt::format("did you mean '${}'?", near);
            throw InputError(
                fmt::format("{}: the parameter '${}' is not defined; {}", where.str(), name, mend));
        }
        out += best->second;
        used_.insert(best->first);
        asked_.insert(best->first);
        i += best->first.size();
    }
    return out;
}

void XmlParameters::check_all_used() const {
    for (const std::string& name : defines_) {
        if (used_.contains(name)) continue;
        std::vector<std::string> known;
        for (const std::string& other : asked_)
            if (other != name) known.push_back(other);
        throw InputError(fmt::format("command line: -D {}: the scene does not use '${}'{}", name,
                                     name, suggestion(name, known)));
    }
}

XmlElement::XmlElement(const XmlSource& source, const pugi::xml_node& element,
                       XmlParameters& parameters)
    : tag(element.name()), location(source.locate(element)), node(element) {
    const bool old = source.version < 2;
    if (old && tag == "lookAt") tag = "lookat";
    for (const pugi::xml_attribute& attribute : element.attributes()) {
        std::string value = parameters.substitute(attribute.value(), location);
        if (old && tag != "default" && std::string_view(attribute.name()) == "name")
            value = snake_case(value);
        if (!attributes_.emplace(attribute.name(), value).second)
            fail(fmt::format("<{}> has the attribute '{}' twice", tag, attribute.name()));
    }
}

void XmlElement::check_attributes(const std::vector<std::string>& required,
                                  const std::vector<std::string>& optional) const {
    std::vector<std::string> known = required;
    known.insert(known.end(), optional.begin(), optional.end());
    for (const auto& [name, value] : attributes_)
        if (std::find(known.begin(), known.end(), name) == known.end())
            fail(fmt::format("<{}> has no attribute '{}'{}", tag, name, suggestion(name, known)));
    for (const std::string& name : required)
        if (get(name).empty() && !(tag == "string" && name == "value" && has(name)))
            fail(fmt::format("<{}> needs the attribute '{}'", tag, name));
}

std::string XmlElement::get(const std::string& attribute) const {
    const auto at = attributes_.find(attribute);
    return at == attributes_.end() ? std::string() : at->second;
}

void XmlElement::fail(const std::string& message) const {
    throw InputError(fmt::format("{}: {}", location.str(), message));
}

std::string snake_case(std::string_view camel) {
    std::string out;
    for (std::size_t i = 0; i < camel.size(); ++i) {
        const auto c = static_cast<unsigned char>(camel[i]);
        if (i > 0 && std::isupper(c)) {
            const auto before = static_cast<unsigned char>(camel[i - 1]);
            if (std::islower(before) || std::isdigit(before)) out += '_';
            out += static_cast<char>(std::tolower(c));
        } else {
            out += static_cast<char>(c);
        }
    }
    return out;
}

}  // namespace nacre

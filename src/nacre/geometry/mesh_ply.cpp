// Stanford polygon files (Greg Turk 1994, The PLY Polygon File Format): text or binary of either
// byte order, any elements and properties in any order; what a mesh does not need is skipped.
#include <fmt/format.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstring>

#include "nacre/geometry/mesh_polygon.h"
#include "nacre/geometry/mesh_source.h"
#include "nacre/text/number.h"

namespace nacre {
namespace {

enum class Type : std::uint8_t { I8, U8, I16, U16, I32, U32, F32, F64 };

constexpr std::size_t size_of(Type t) {
    constexpr std::size_t kSizes[] = {1, 1, 2, 2, 4, 4, 4, 8};
    return kSizes[static_cast<int>(t)];
}

struct Property {
    std::string name;
    Type type{};
    bool list = false;
    Type count_type{};
};

struct Element {
    std::string name;
    std::int64_t count = 0;
    std::vector<Property> properties;

    /// Bytes that one element takes at least.
    std::size_t least_bytes(bool text) const {
        std::size_t bytes = 0;
        for (const Property& p : properties)
            bytes += text ? 2 : size_of(p.list ? p.count_type : p.type);
        return bytes;
    }
};

struct Header {
    bool text = false, big_endian = false;
    std::vector<Element> elements;
    std::size_t body = 0, lines = 0;  ///< bytes and lines that the header takes
};

Type parse_type(const MeshSource& source, std::size_t line, std::string_view word) {
    constexpr std::pair<std::string_view, Type> kTypes[] = {
        {"char", Type::I8},    {"int8", Type::I8},     {"uchar", Type::U8},
        {"uint8", Type::U8},   {"short", Type::I16},   {"int16", Type::I16},
        {"ushort", Type::U16}, {"uint16", Type::U16},  {"int", Type::I32},
        {"int32", Type::I32},  {"uint", Type::U32},    {"uint32", Type::U32},
        {"float", Type::F32},  {"float32", Type::F32}, {"double", Type::F64},
        {"float64", Type::F64}};
    for (const auto& [name, type] : kTypes)
        if (name == word) return type;
    source.fail(line, fmt::format("unknown property type '{}'; PLY knows char, uchar, short, "
                                  "ushort, int, uint, float and double",
                                  word));
}

bool is_integer(Type t) { return t != Type::F32 && t != Type::F64; }

Header read_header(const MeshSource& source) {
    Header header;
    const std::string_view text = source.bytes;
    header.body = byte_order_mark(text);
    if (text.substr(header.body, 3) != "ply")
        source.fail("is not a PLY file: it does not begin with 'ply'");
    // The first line tells where lines end, as bytes of the body may look like a line end.
    const std::size_t first_end = text.find_first_of("\r\n");
    const bool cr_alone =
        first_end != text.npos && text.substr(first_end, 2) != "\r\n" && text[first_end] == '\r';
    bool format_seen = false;
    while (true) {
        if (header.body >= text.size())
            source.fail(fmt::format(
                "is truncated: no 'end_header' in its {} bytes; export it again", text.size()));
        const std::size_t end =
            std::min(text.find(cr_alone ? '\r' : '\n', header.body), text.size());
        std::string_view rest = text.substr(header.body, end - header.body);
        header.body = std::min(end + 1, text.size());
        const std::size_t line = ++header.lines;
        const auto word = [&] { return take_word(rest); };
        const std::string_view keyword = word();
        if (keyword == "end_header") break;
        if (keyword == "format") {
            const std::string_view format = word();
            header.text = format == "ascii";
            header.big_endian = format == "binary_big_endian";
            if (!header.text && !header.big_endian && format != "binary_little_endian")
                source.fail(line, fmt::format("unknown format '{}'; PLY knows ascii, "
                                              "binary_little_endian and binary_big_endian",
                                              format));
            format_seen = true;
        } else if (keyword == "element") {
            Element element;
            element.name = word();
            const std::string_view count = word();
            const auto number = parse_integer(count);
            if (!number)
                source.fail(line, fmt::format("'{}' stands where the number of elements should be "
                                              "an integer",
                                              count));
            element.count = *number;
            if (element.count < 0)
                source.fail(line, fmt::format("element '{}' occurs {} times; a count cannot be "
                                              "negative",
                                              element.name, element.count));
            header.elements.push_back(std::move(element));
        } else if (keyword == "property") {
            if (header.elements.empty())
                source.fail(line, "property before any element; the header is out of order");
            Property property;
            std::string_view type = word();
            if (type == "list") {
                property.list = true;
                property.count_type = parse_type(source, line, word());
                if (!is_integer(property.count_type))
                    source.fail(line, "the length of a list cannot be a floating-point number");
                type = word();
            }
            property.type = parse_type(source, line, type);
            property.name = word();
            header.elements.back().properties.push_back(std::move(property));
        } else if (keyword != "ply" && keyword != "comment" && keyword != "obj_info" &&
                   !keyword.empty()) {
            source.fail(line, fmt::format("unknown header keyword '{}'", keyword.substr(0, 40)));
        }
    }
    if (!format_seen)
        source.fail("has no 'format' line in its header; is it a PLY file of version 1.0?");
    return header;
}

// The body as a row of numbers.
class Body {
  public:
    Body(const MeshSource& source, const Header& header)
        : source_(source),
          text_(header.text),
          swap_(header.big_endian != (std::endian::native == std::endian::big)),
          offset_(header.body),
          lines_(source, header.text ? header.body : source.bytes.size(), header.lines) {}

    std::size_t remaining() const {
        return text_ ? lines_.remaining() : source_.bytes.size() - offset_;
    }
    std::size_t line() const { return text_ ? lines_.line() : 0; }
    /// Where the body is, for messages.
    const Element* element = nullptr;
    std::int64_t index = 0;

    double next(Type type) {
        if (text_) {
            const std::string_view word = lines_.any_word();
            if (word.empty()) truncated();
            return lines_.to_number(word, "a property");
        }
        const std::size_t size = size_of(type);
        if (source_.bytes.size() - offset_ < size) truncated();
        const char* raw = source_.bytes.data() + offset_;
        offset_ += size;
        switch (type) {
            case Type::I8:
                return as<std::int8_t>(raw);
            case Type::U8:
                return as<std::uint8_t>(raw);
            case Type::I16:
                return as<std::int16_t>(raw);
            case Type::U16:
                return as<std::uint16_t>(raw);
            case Type::I32:
                return as<std::int32_t>(raw);
            case Type::U32:
                return as<std::uint32_t>(raw);
            case Type::F32:
                return as<float>(raw);
            case Type::F64:
                break;
        }
        return as<double>(raw);
    }

    std::int64_t next_count(const Property& property) {
        const double count = next(property.count_type);
        const std::size_t item = text_ ? 2 : size_of(property.type);
        if (!(count >= 0) || count != std::floor(count))
            source_.fail_at(
                line(), fmt::format("{} {} has a list of {} items", element->name, index, count));
        // The last number of a text file may lack its blank.
        if (count > static_cast<double>((remaining() + 1) / item)) truncated();
        return static_cast<std::int64_t>(count);
    }

    [[noreturn]] void truncated() const {
        source_.fail(fmt::format("is truncated in {} {} of {} (counted from 0); export it again",
                                 element->name, index, element->count));
    }

  private:
    template <class T>
    double as(const char* raw) const {
        std::array<char, sizeof(T)> bytes;
        std::memcpy(bytes.data(), raw, sizeof(T));
        if (swap_) std::reverse(bytes.begin(), bytes.end());
        return static_cast<double>(std::bit_cast<T>(bytes));
    }

    const MeshSource& source_;
    bool text_, swap_;
    std::size_t offset_;
    TextLines lines_;
};

void skip(Body& body, const Property& property) {
    const std::int64_t count = property.list ? body.next_count(property) : 1;
    for (std::int64_t i = 0; i < count; ++i) body.next(property.type);
}

void read_vertices(const MeshSource& source, Body& body, const Element& element, Mesh& mesh) {
    // Slots: position, normal, texture coordinates.
    constexpr int kUnused = 8;
    std::vector<int> slots;
    bool seen[kUnused + 1] = {};
    constexpr std::string_view kNames[kUnused] = {"x", "y", "z", "nx", "ny", "nz", "u", "v"};
    for (const Property& p : element.properties) {
        int slot = kUnused;
        for (int i = 0; i < kUnused; ++i)
            if (!p.list && p.name == kNames[i]) slot = i;
        if (!p.list && (p.name == "s" || p.name == "texture_u" || p.name == "texture_s")) slot = 6;
        if (!p.list && (p.name == "t" || p.name == "texture_v" || p.name == "texture_t")) slot = 7;
        if (seen[slot] && slot != kUnused) slot = kUnused;
        seen[slot] = true;
        slots.push_back(slot);
    }
    if (!seen[0] || !seen[1] || !seen[2])
        source.fail("has vertices without x, y and z; export them with positions");
    const bool normals = seen[3] && seen[4] && seen[5], uvs = seen[6] && seen[7];
    const auto count = static_cast<std::size_t>(element.count);
    mesh.positions.reserve(count + 1);
    if (normals) mesh.normals.reserve(count);
    if (uvs) mesh.uvs.reserve(count);
    for (body.index = 0; body.index < element.count; ++body.index) {
        float value[kUnused + 1] = {};
        for (std::size_t i = 0; i < slots.size(); ++i) {
            if (slots[i] == kUnused)
                skip(body, element.properties[i]);
            else
                value[slots[i]] = static_cast<float>(body.next(element.properties[i].type));
        }
        mesh.positions.emplace_back(value[0], value[1], value[2]);
        if (normals) mesh.normals.emplace_back(value[3], value[4], value[5]);
        if (uvs) mesh.uvs.push_back({value[6], value[7]});
    }
}

bool names_vertices(const Property& p) {
    return p.list && (p.name == "vertex_indices" || p.name == "vertex_index");
}

void read_faces(const MeshSource& source, Body& body, const Element& element, std::int64_t vertices,
                Mesh& mesh, Polygons& polygons) {
    const bool strips = element.name == "tristrips";
    if (element.count > 0 &&
        std::none_of(element.properties.begin(), element.properties.end(), names_vertices))
        source.fail(
            fmt::format("has element '{}' without a list 'vertex_indices'; export it with "
                        "the corners of its faces",
                        element.name));
    mesh.triangles.reserve(static_cast<std::size_t>(element.count));
    std::vector<std::uint32_t> corners;
    const auto finish = [&] {
        if (strips)
            add_strip(mesh, corners);
        else
            polygons.add(mesh, corners);
        corners.clear();
    };
    for (body.index = 0; body.index < element.count; ++body.index) {
        for (const Property& property : element.properties) {
            if (!names_vertices(property)) {
                skip(body, property);
                continue;
            }
            const std::int64_t count = body.next_count(property);
            for (std::int64_t c = 0; c < count; ++c) {
                const double index = body.next(property.type);
                if (strips && index == -1) {  // a new strip begins
                    if (!corners.empty()) finish();
                    continue;
                }
                if (!(index >= 0 && index < static_cast<double>(vertices)) ||
                    index != std::floor(index))
                    source.fail_at(
                        body.line(),
                        fmt::format("{} {} names vertex {}, but vertices run from 0 to "
                                    "{}",
                                    strips ? "strip" : "face", body.index, index, vertices - 1));
                corners.push_back(static_cast<std::uint32_t>(index));
            }
            if (!strips || !corners.empty()) finish();
        }
    }
}

}  // namespace

Mesh read_ply(const MeshSource& source) {
    const Header header = read_header(source);
    std::int64_t vertices = -1;
    for (const Element& element : header.elements)
        if (element.name == "vertex" && vertices < 0) vertices = element.count;
    if (vertices < 0) source.fail("has no element 'vertex'; export the mesh with its vertices");
    if (vertices > 0xffffffffll)
        source.fail(fmt::format("has {} vertices; at most 2^32 - 1 can be indexed", vertices));
    Mesh mesh;
    Polygons polygons;
    Body body(source, header);
    for (const Element& element : header.elements) {
        body.element = &element;
        body.index = 0;
        const std::size_t least = element.least_bytes(header.text);
        if (least == 0) continue;
        if (static_cast<std::size_t>(element.count) > (body.remaining() + 1) / least)
            source.fail(
                fmt::format("is truncated: its header promises {} of element '{}', which "
                            "take {} bytes each or more, but {} bytes are left; export it "
                            "again",
                            element.count, element.name, least, body.remaining()));
        if (element.name == "vertex" && mesh.positions.empty()) {
            read_vertices(source, body, element, mesh);
        } else if (element.name == "face" || element.name == "tristrips") {
            read_faces(source, body, element, vertices, mesh, polygons);
        } else {
            for (; body.index < element.count; ++body.index)
                for (const Property& property : element.properties) skip(body, property);
        }
    }
    polygons.cut_concave(mesh);
    return mesh;
}

}  // namespace nacre

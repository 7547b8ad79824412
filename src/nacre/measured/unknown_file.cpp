#include "nacre/measured/unknown_file.h"

#include "nacre/text/lines.h"

namespace nacre {
namespace {

struct Signature {
    std::string_view bytes;
    const char* what;
};

using namespace std::string_view_literals;

constexpr const char* picture = "it is a picture";
constexpr const char* mesh = "it is a mesh";
constexpr const char* packed = "it is compressed; unpack it first";

/// In the order in which they are tried.
constexpr Signature signatures[] = {
    {"version https://git-lfs"sv,
     "it is a pointer of Git LFS, not the data; fetch them with 'git lfs pull'"},
    {"\x89PNG"sv, picture},
    {"\xff\xd8\xff"sv, picture},
    {"GIF8"sv, picture},
    {"\x76\x2f\x31\x01"sv, picture},
    {"#?RADIANCE"sv, picture},
    {"#?RGBE"sv, picture},
    {"PF\n"sv, picture},
    {"Pf\n"sv, picture},
    {"II*\0"sv, picture},
    {"MM\0*"sv, picture},
    {"ply\n"sv, mesh},
    {"ply\r"sv, mesh},
    {"solid "sv, mesh},
    {"OFF"sv, mesh},
    {"glTF"sv, mesh},
    {"v "sv, mesh},
    {"mtllib "sv, mesh},
    {"PK\x03\x04"sv, packed},
    {"\x1f\x8b"sv, packed},
    {"BZh"sv, packed},
    {"\xfd"
     "7zXZ"sv,
     packed},
    {"7z\xbc\xaf"sv, packed},
    {"\x28\xb5\x2f\xfd"sv, packed},
    {"%PDF"sv, "it is a PDF document"},
    {"\x93NUMPY"sv, "it is an array of NumPy"},
    {"\x89HDF"sv, "it is an HDF5 file"},
    {"{"sv, "it is JSON"},
    {"["sv, "it is JSON"},
    {"<scene"sv, "it is a scene"},
    {"<"sv, "it is XML of another kind"},
};

std::string lower(std::string_view text) {
    std::string r(text);
    for (char& c : r)
        if (c >= 'A' && c <= 'Z') c = char(c - 'A' + 'a');
    return r;
}

}  // namespace

std::string what_it_seems_to_be(const FileStart& start) {
    std::string_view head = start.head;
    if (head.empty()) return "it is empty; fetch it again";
    if (is_utf16(head)) return "it is text in UTF-16; save it as UTF-8";
    if (head.find_first_not_of('\0') == head.npos)
        return "it begins with nothing but zeros; it is damaged: fetch it again";
    head.remove_prefix(byte_order_mark(head));
    while (!head.empty() && is_blank(head.front())) head.remove_prefix(1);
    if (head.empty()) return "it holds nothing but blanks";
    const std::string begin = lower(head.substr(0, 1024));
    if (begin.starts_with("<!doctype html") || begin.find("<html") != begin.npos)
        return "it is a web page, saved instead of the data; fetch the file itself";
    if (begin.starts_with("<?xml") && head.find("<scene") != head.npos) return "it is a scene";
    for (const Signature& s : signatures)
        if (head.starts_with(s.bytes)) return s.what;
    const bool text =
        std::all_of(head.begin(), head.begin() + std::min<std::size_t>(head.size(), 512),
                    [](char c) { return is_blank(c) || (unsigned char)(c) >= 32; });
    return text ? "it is text of another kind" : "it is binary of another kind, or damaged";
}

}  // namespace nacre

#include "nacre/measured/tensor_file.h"

#include <bit>
#include <cstring>

namespace nacre {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's numbers are copied as bytes");

struct TypeInfo {
    std::string_view name;
    std::size_t size;
};
constexpr TypeInfo types[] = {{"uint8", 1},   {"int8", 1},    {"uint16", 2}, {"int16", 2},
                              {"uint32", 4},  {"int32", 4},   {"uint64", 8}, {"int64", 8},
                              {"float16", 2}, {"float32", 4}, {"float64", 8}};

/// Takes numbers off the header.
class HeaderReader {
  public:
    explicit HeaderReader(const MeasuredSource& source) : source_(source) {}

    template <class T>
    T take(const std::string& within) {
        T value;
        std::memcpy(&value, text(sizeof(T), within).data(), sizeof(T));
        return value;
    }
    std::string_view text(std::size_t length, const std::string& within) {
        if (source_.bytes.size() - at_ < length)
            source_.fail(
                fmt::format("breaks off within {}; it is incomplete: fetch it again", within));
        at_ += length;
        return source_.bytes.substr(at_ - length, length);
    }

  private:
    const MeasuredSource& source_;
    std::size_t at_ = 0;
};

/// Bytes that a shape takes; nothing beyond 2^63.
std::optional<std::uint64_t> bytes_of(const std::vector<std::uint64_t>& shape, TensorType type) {
    std::uint64_t bytes = size_of(type);
    bool none = false;
    for (const std::uint64_t n : shape) none = none || n == 0;
    if (none) return 0;
    for (const std::uint64_t n : shape) {
        if (n > (std::uint64_t(1) << 63) / bytes) return std::nullopt;
        bytes *= n;
    }
    return bytes;
}

Tensor take_tensor(HeaderReader& header, const MeasuredSource& source, const std::string& name) {
    const std::string within = fmt::format("the description of field '{}'", name);
    Tensor t;
    const auto dimensions = header.take<std::uint16_t>(within);
    const auto kind = header.take<std::uint8_t>(within);
    const auto offset = header.take<std::uint64_t>(within);
    if (kind < 1 || kind > std::size(types))
        source.fail(
            fmt::format("field '{}' holds numbers of the unknown kind {}; known are 1 "
                        "(uint8) to 11 (float64)",
                        name, kind));
    t.type = TensorType(kind);
    for (int d = 0; d < dimensions; ++d) t.shape.push_back(header.take<std::uint64_t>(within));
    const auto bytes = bytes_of(t.shape, t.type);
    if (!bytes)
        source.fail(
            fmt::format("field '{}' claims {} numbers, which no file can hold; it is "
                        "damaged: fetch it again",
                        name, t.shape_text()));
    const std::uint64_t size = source.bytes.size();
    if (offset > size || *bytes > size - offset)
        source.fail(
            fmt::format("field '{}' has {} bytes from byte {} on, but the file has {}; it "
                        "is incomplete: fetch it again",
                        name, *bytes, offset, size));
    t.bytes = source.bytes.substr(offset, *bytes);
    return t;
}

}  // namespace

std::string_view name_of(TensorType type) { return types[std::size_t(type) - 1].name; }
std::size_t size_of(TensorType type) { return types[std::size_t(type) - 1].size; }

std::string Tensor::shape_text() const {
    std::string text;
    for (const std::uint64_t n : shape) text += fmt::format("{}{}", text.empty() ? "" : " x ", n);
    return text.empty() ? "1" : text;
}

std::vector<float> Tensor::floats() const {
    std::vector<float> values(count());
    if (!values.empty()) std::memcpy(values.data(), bytes.data(), bytes.size());
    return values;
}

bool is_tensor_file(std::string_view head) { return head.starts_with(tensor_magic); }

TensorFile parse_tensor_file(const MeasuredSource& source) {
    HeaderReader header(source);
    const std::string within = "the header of the tensor file";
    if (header.text(tensor_magic.size(), within) != tensor_magic) source.fail("is no tensor file");
    const int major = header.take<std::uint8_t>(within), minor = header.take<std::uint8_t>(within);
    if (major != 1 || minor != 0)
        source.fail(
            fmt::format("is a tensor file of version {}.{}; only 1.0 can be read", major, minor));
    const auto fields = header.take<std::uint32_t>(within);
    TensorFile file;
    for (std::uint32_t i = 0; i < fields; ++i) {
        const std::string field = fmt::format("the description of field {} of {}", i + 1, fields);
        const auto length = header.take<std::uint16_t>(field);
        const std::string name(header.text(length, field));
        if (!file.emplace(name, take_tensor(header, source, name)).second)
            source.fail(fmt::format("has two fields '{}'; it is damaged: fetch it again", name));
    }
    return file;
}

}  // namespace nacre

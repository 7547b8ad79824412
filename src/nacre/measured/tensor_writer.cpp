#include "nacre/measured/tensor_writer.h"

#include <bit>
#include <stdexcept>

namespace nacre {
namespace {

static_assert(std::endian::native == std::endian::little, "the file's numbers are copied as bytes");

template <class T>
void put(std::string& bytes, T value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

std::size_t aligned(std::size_t position) { return (position + 7) / 8 * 8; }

}  // namespace

void TensorWriter::add(std::string_view name, std::vector<std::uint64_t> shape,
                       std::span<const float> values) {
    std::uint64_t count = 1;
    for (const std::uint64_t n : shape) count *= n;
    if (count != values.size())
        throw std::logic_error(
            fmt::format("field '{}' has {} values, but its shape {}", name, values.size(), count));
    fields_.push_back(
        {std::string(name), TensorType::f32, std::move(shape),
         std::string(reinterpret_cast<const char*>(values.data()), values.size_bytes())});
}

void TensorWriter::add(std::string_view name, std::string_view bytes) {
    fields_.push_back({std::string(name), TensorType::u8, {bytes.size()}, std::string(bytes)});
}

std::string TensorWriter::bytes() const {
    std::size_t header = tensor_magic.size() + 2 + 4;
    for (const Field& f : fields_) header += 2 + f.name.size() + 2 + 1 + 8 + 8 * f.shape.size();
    std::string bytes(tensor_magic);
    put(bytes, std::uint8_t{1});
    put(bytes, std::uint8_t{0});
    put(bytes, std::uint32_t(fields_.size()));
    std::size_t begin = aligned(header);
    for (const Field& f : fields_) {
        put(bytes, std::uint16_t(f.name.size()));
        bytes += f.name;
        put(bytes, std::uint16_t(f.shape.size()));
        put(bytes, std::uint8_t(f.type));
        put(bytes, std::uint64_t(begin));
        for (const std::uint64_t n : f.shape) put(bytes, n);
        begin = aligned(begin + f.data.size());
    }
    for (const Field& f : fields_) {
        bytes.resize(aligned(bytes.size()));
        bytes += f.data;
    }
    return bytes;
}

}  // namespace nacre

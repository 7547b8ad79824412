#pragma once
// The container of the RGL material database: arrays with names.
//
//   bytes  what
//   12     "tensor_file" and a zero
//   1 + 1  version: 1, 0
//   4      number of fields; of each follow
//     2 + n  length of the name, the name
//     2      number of dimensions
//     1      kind of numbers (TensorType)
//     8      where its data begin, from the start of the file
//     8 each the sizes of the dimensions, the slowest first
// All little-endian.
#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/measured/formats.h"

namespace nacre {

enum class TensorType : std::uint8_t { u8 = 1, i8, u16, i16, u32, i32, u64, i64, f16, f32, f64 };

/// "float32"; and how many bytes one number has.
std::string_view name_of(TensorType type);
std::size_t size_of(TensorType type);

struct Tensor {
    TensorType type;
    std::vector<std::uint64_t> shape;
    std::string_view bytes;  ///< lie in what was parsed; not aligned

    std::size_t count() const { return bytes.size() / size_of(type); }
    /// "8 x 3 x 32 x 32".
    std::string shape_text() const;
    /// The numbers of a tensor of float32.
    std::vector<float> floats() const;
};

using TensorFile = std::map<std::string, Tensor, std::less<>>;

/// What a tensor file begins with.
inline constexpr std::string_view tensor_magic{"tensor_file\0", 12};

/// Whether a file begins so.
bool is_tensor_file(std::string_view head);

/// All fields; they refer to source.bytes. Throws InputError: another version, a header that breaks
/// off, unknown kinds, shapes beyond 2^63 bytes, data beyond the end of the file, a name twice.
TensorFile parse_tensor_file(const MeasuredSource& source);

}  // namespace nacre

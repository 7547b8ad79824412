#pragma once
// Tensor files (tensor_file.h) as bytes.
#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "nacre/measured/tensor_file.h"

namespace nacre {

class TensorWriter {
  public:
    /// A field of float32, the slowest dimension first. Throws std::logic_error unless the shape has
    /// as many numbers as `values`.
    void add(std::string_view name, std::vector<std::uint64_t> shape,
             std::span<const float> values);
    /// A field of uint8 with one dimension.
    void add(std::string_view name, std::string_view bytes);
    /// The file; data begin at multiples of eight bytes.
    std::string bytes() const;

  private:
    struct Field {
        std::string name;
        TensorType type;
        std::vector<std::uint64_t> shape;
        std::string data;
    };
    std::vector<Field> fields_;
};

}  // namespace nacre

#pragma once
// Files of measured reflectance that tests make.
#include <gtest/gtest.h>

#include <cstring>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include "nacre/math/error.h"
#include "nacre/measured/formats.h"
#include "nacre/measured/tensor_file.h"

namespace nacre::test {

/// A tensor file, field by field; everything in it can be made wrong.
class MadeTensor {
  public:
    struct Field {
        int type = 10;  ///< float32
        std::vector<std::uint64_t> shape;
        std::string bytes;
        std::uint64_t offset = 0;  ///< 0: where the bytes are put
    };
    std::vector<std::pair<std::string, Field>> fields;
    int major = 1, minor = 0;
    std::uint32_t count = 0;  ///< of fields in the header, 0: as many as there are

    Field& add(const std::string& name, std::vector<std::uint64_t> shape,
               const std::vector<float>& values) {
        std::string bytes(values.size() * 4, '\0');
        if (!values.empty()) std::memcpy(bytes.data(), values.data(), bytes.size());
        return fields.emplace_back(name, Field{10, std::move(shape), bytes}).second;
    }
    Field& add_bytes(const std::string& name, const std::string& bytes) {
        return fields.emplace_back(name, Field{1, {bytes.size()}, bytes}).second;
    }
    Field& operator[](const std::string& name) {
        for (auto& [n, f] : fields)
            if (n == name) return f;
        throw std::logic_error("no field " + name);
    }
    void remove(const std::string& name) {
        std::erase_if(fields, [&](const auto& f) { return f.first == name; });
    }
    void set(const std::string& name, std::size_t i, float value) {
        std::memcpy((*this)[name].bytes.data() + 4 * i, &value, 4);
    }

    std::string bytes() const {
        std::size_t header = 18;
        for (const auto& [name, f] : fields) header += 2 + name.size() + 11 + 8 * f.shape.size();
        std::string head = std::string("tensor_file\0", 12) + char(major) + char(minor), data;
        const auto put = [&](auto value) {
            head.append(reinterpret_cast<const char*>(&value), sizeof value);
        };
        put(count ? count : std::uint32_t(fields.size()));
        for (const auto& [name, f] : fields) {
            put(std::uint16_t(name.size()));
            head += name;
            put(std::uint16_t(f.shape.size()));
            put(std::uint8_t(f.type));
            put(f.offset ? f.offset : std::uint64_t(header + data.size()));
            for (const std::uint64_t n : f.shape) put(n);
            data += f.bytes;
        }
        return head + data;
    }
};

/// An RGL file whose tables come from functions of (phi_i, theta_i, x, y), x and y in [0, 1]: 3
/// incidences of theta_i, 7 x 5 nodes of visible normals, 5 x 4 of values.
struct MadeRgl {
    std::vector<float> phi{0.f}, theta{0.f, 0.7f, 1.4f}, wavelengths;
    std::function<double(double, double, double, double)> vndf = [](auto...) { return 1.; };
    std::function<double(double, double, double, double)> luminance = [](auto...) { return 1.; };
    std::function<double(int, double, double, double, double)> value = [](auto...) { return 1.; };
    std::function<double(double, double)> ndf = [](auto...) { return 1.; };
    std::function<double(double, double)> sigma = [](auto...) { return 1.; };
    int channels = 3, warp_width = 7, warp_height = 5, width = 5, height = 4;
    bool jacobian = false;

    MadeTensor file() const {
        MadeTensor t;
        const std::uint64_t p = phi.size(), n = theta.size();
        t.add_bytes("description", "made by a test");
        t.add("phi_i", {p}, phi);
        t.add("theta_i", {n}, theta);
        t.add("ndf", {2, 5}, flat(5, 2, ndf));
        t.add("sigma", {2, 5}, flat(5, 2, sigma));
        t.add("vndf", {p, n, std::uint64_t(warp_height), std::uint64_t(warp_width)},
              slices(warp_width, warp_height, vndf));
        t.add("luminance", {p, n, std::uint64_t(height), std::uint64_t(width)},
              slices(width, height, luminance));
        std::vector<float> all;
        for (const float a : phi)
            for (const float b : theta)
                for (int c = 0; c < channels; ++c)
                    for (const float v : flat(width, height, [&](double x, double y) {
                             return value(c, a, b, x, y);
                         }))
                        all.push_back(v);
        const std::vector<std::uint64_t> shape{p, n, std::uint64_t(channels), std::uint64_t(height),
                                               std::uint64_t(width)};
        t.add(wavelengths.empty() ? "rgb" : "spectra", shape, all);
        if (!wavelengths.empty()) t.add("wavelengths", {wavelengths.size()}, wavelengths);
        t.add_bytes("jacobian", std::string(1, char(jacobian)));
        return t;
    }

  private:
    template <class F>
    static std::vector<float> flat(int w, int h, F&& f) {
        std::vector<float> values;
        for (int y = 0; y < h; ++y)
            for (int x = 0; x < w; ++x)
                values.push_back(float(f(double(x) / (w - 1), double(y) / (h - 1))));
        return values;
    }
    template <class F>
    std::vector<float> slices(int w, int h, F&& f) const {
        std::vector<float> values;
        for (const float a : phi)
            for (const float b : theta)
                for (const float v : flat(w, h, [&](double x, double y) { return f(a, b, x, y); }))
                    values.push_back(v);
        return values;
    }
};

/// A file in the XML of Klems matrices, of a small basis of 1 + 4 patches unless it names another.
struct MadeKlems {
    std::string structure = "Columns", basis_name = "small", column_basis = "small",
                row_basis = "small", part = "Visible", definition;
    /// Direction and numbers.
    std::vector<std::pair<std::string, std::string>> blocks;

    std::string text() const {
        std::string t =
            "<?xml version=\"1.0\"?>\n<WindowElement>\n<Optical>\n<Layer>\n"
            "<Material><Name>blind</Name></Material>\n<DataDefinition>\n"
            "<IncidentDataStructure>" +
            structure + "</IncidentDataStructure>\n";
        if (!basis_name.empty())
            t += "<AngleBasis><AngleBasisName>" + basis_name + "</AngleBasisName>\n" +
                 (definition.empty() ? ring(0, 30, 1) + ring(30, 90, 4) : definition) +
                 "</AngleBasis>\n";
        t += "</DataDefinition>\n";
        for (const auto& [direction, numbers] : blocks)
            t += "<WavelengthData><Wavelength unit=\"Integral\">" + part +
                 "</Wavelength>\n<WavelengthDataBlock><WavelengthDataDirection>" + direction +
                 "</WavelengthDataDirection>\n<ColumnAngleBasis>" + column_basis +
                 "</ColumnAngleBasis>\n<RowAngleBasis>" + row_basis +
                 "</RowAngleBasis>\n<ScatteringData>\n" + numbers +
                 "</ScatteringData></WavelengthDataBlock></WavelengthData>\n";
        return t + "</Layer>\n</Optical>\n</WindowElement>\n";
    }
    static std::string ring(double low, double high, int n) {
        return fmt::format(
            "<AngleBasisBlock><nPhis>{}</nPhis><ThetaBounds><LowerTheta>{}</LowerTheta>"
            "<UpperTheta>{}</UpperTheta></ThetaBounds></AngleBasisBlock>\n",
            n, low, high);
    }
};

inline std::unique_ptr<Measured> parsed(const std::string& bytes) {
    return parse_measured({bytes, "x.data"});
}

/// What refuses these bytes, or "no error".
inline std::string refusal(const std::string& bytes) {
    try {
        parsed(bytes);
    } catch (const InputError& e) {
        return e.what();
    }
    return "no error";
}

/// Unit vector by degrees.
inline Vec3d towards(double theta, double phi) {
    const double d = 3.14159265358979323846 / 180., s = std::sin(theta * d);
    return {s * std::cos(phi * d), s * std::sin(phi * d), std::cos(theta * d)};
}

inline std::vector<double> value_at(const Measured& m, const Vec3d& wi, const Vec3d& wo) {
    std::vector<double> v(std::size_t(m.info().channels));
    if (!m.eval(wi, wo, v)) v.clear();
    return v;
}

inline std::filesystem::path measured_data() {
    return std::filesystem::path(NACRE_SHARED_DIR) / "data/brdf";
}

}  // namespace nacre::test

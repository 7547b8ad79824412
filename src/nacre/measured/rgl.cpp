// The .bsdf files of the RGL material database (rgl.epfl.ch/materials): tensor files with the
// fields of the adaptive parameterisation (rgl_brdf.h).
#include "nacre/measured/rgl.h"

#include <cmath>
#include <numbers>

#include "nacre/measured/tensor_file.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

/// Fields of one file, checked.
class Fields {
  public:
    explicit Fields(const MeasuredSource& source)
        : source_(source), fields_(parse_tensor_file(source)) {}

    const Tensor* look(std::string_view name) const {
        const auto found = fields_.find(name);
        return found == fields_.end() ? nullptr : &found->second;
    }
    const Tensor& find(std::string_view name, TensorType type, std::size_t dimensions) const {
        const Tensor* t = look(name);
        if (!t)
            fail(
                fmt::format("has no field '{}': it is a tensor file, but no BRDF of the RGL "
                            "database, or damaged",
                            name));
        if (t->type != type)
            fail(fmt::format("field '{}' holds {}, not {}", name, name_of(t->type), name_of(type)));
        if (t->shape.size() != dimensions)
            fail(fmt::format("field '{}' has {} dimensions ({}), not {}", name, t->shape.size(),
                             t->shape_text(), dimensions));
        return *t;
    }
    /// float32 numbers, all finite.
    std::vector<float> numbers(std::string_view name, std::size_t dimensions) const {
        std::vector<float> values = find(name, TensorType::f32, dimensions).floats();
        if (values.empty()) fail(fmt::format("field '{}' is empty", name));
        for (std::size_t i = 0; i < values.size(); ++i)
            if (!std::isfinite(values[i]))
                fail(fmt::format("field '{}': number {} of {} is {}; it is damaged: fetch it again",
                                 name, i + 1, values.size(), values[i]));
        return values;
    }
    /// The same, ascending, within [low, high].
    std::vector<float> nodes(std::string_view name, double low, double high) const {
        std::vector<float> values = numbers(name, 1);
        for (std::size_t i = 0; i < values.size(); ++i) {
            if (i > 0 && !(values[i] > values[i - 1]))
                fail(fmt::format("field '{}' must ascend, but {} follows {}", name, values[i],
                                 values[i - 1]));
            if (!(values[i] >= low && values[i] <= high))
                fail(fmt::format("field '{}': {} lies outside {:.5g} to {:.5g}", name, values[i],
                                 low, high));
        }
        return values;
    }
    /// A table, which has `slices` of at least 2 x 2 nodes, and no negative values.
    template <class Table>
    Table table(std::string_view name, std::vector<std::uint64_t> slices, bool clamp) const {
        std::vector<float> values = numbers(name, slices.size() + 2);
        const std::vector<std::uint64_t>& shape =
            find(name, TensorType::f32, slices.size() + 2).shape;
        check_slices(name, slices);
        const std::uint64_t width = shape.back(), height = shape[shape.size() - 2];
        check_nodes(name, width, height);
        for (float& v : values) {
            if (v < 0.f && !clamp)
                fail(
                    fmt::format("field '{}' holds {}, but must not be negative; it is damaged: "
                                "fetch it again",
                                name, v));
            v = std::max(v, 0.f);
        }
        return Table(int(width), int(height), std::move(values));
    }
    void check_slices(std::string_view name, const std::vector<std::uint64_t>& slices) const {
        const Tensor& t = *look(name);
        for (std::size_t d = 0; d < slices.size(); ++d)
            if (t.shape[d] != slices[d])
                fail(fmt::format("field '{}' is {}, which does not go with {} phi_i and {} theta_i",
                                 name, t.shape_text(), slices[0], slices[1]));
    }
    void check_nodes(std::string_view name, std::uint64_t width, std::uint64_t height) const {
        if (width < 2 || height < 2 || width > 65536 || height > 65536)
            fail(fmt::format("field '{}' is {}: each slice needs 2 to 65536 nodes along both axes",
                             name, look(name)->shape_text()));
    }
    [[noreturn]] void fail(std::string_view what) const { source_.fail(what); }

  private:
    const MeasuredSource& source_;
    TensorFile fields_;
};

/// spectra as [phi][theta][channel][y][x] in the file, the channel last in the tables.
void take_spectra(const Fields& fields, RglTables& t, MeasuredInfo& info,
                  const std::vector<std::uint64_t>& slices) {
    const bool spectral = fields.look("spectra") != nullptr;
    const char* name = spectral ? "spectra" : "rgb";
    const std::vector<float> values = fields.numbers(name, 5);
    const std::vector<std::uint64_t>& shape = fields.look(name)->shape;
    fields.check_slices(name, slices);
    fields.check_nodes(name, shape[4], shape[3]);
    if (spectral) {
        for (const float nm : fields.nodes("wavelengths", 1., 1e6)) info.wavelengths.push_back(nm);
        if (shape[2] != info.wavelengths.size())
            fields.fail(fmt::format("field 'spectra' is {}, but there are {} wavelengths",
                                    fields.look(name)->shape_text(), info.wavelengths.size()));
        if (shape[2] > max_measured_channels)
            fields.fail(fmt::format("has {} wavelengths; at most {} can be read", shape[2],
                                    max_measured_channels));
    } else if (shape[2] != 3) {
        fields.fail(fmt::format("field 'rgb' is {}: the third number must be 3",
                                fields.look(name)->shape_text()));
    }
    t.channels = info.channels = int(shape[2]);
    t.width = int(shape[4]);
    t.height = int(shape[3]);
    if (t.width != t.luminance.width() || t.height != t.luminance.height())
        fields.fail(fmt::format("fields '{}' ({}) and 'luminance' ({}) have different nodes", name,
                                fields.look(name)->shape_text(),
                                fields.look("luminance")->shape_text()));
    t.spectra.resize(values.size());
    const std::size_t nodes = shape[3] * shape[4], n = shape[2];
    for (std::size_t s = 0; s < slices[0] * slices[1]; ++s)
        for (std::size_t c = 0; c < n; ++c)
            for (std::size_t i = 0; i < nodes; ++i)
                t.spectra[(s * nodes + i) * n + c] = values[(s * n + c) * nodes + i];
}

/// Text in a field of bytes, without what no text holds.
std::string text_of(const Tensor& t) {
    std::string text;
    for (const char c : t.bytes)
        if (c == 0)
            break;
        else
            text += (unsigned char)(c) < 32 ? ' ' : c;
    return text;
}

Vec3d direction(double theta, double phi) {
    return {std::sin(theta) * std::cos(phi), std::sin(theta) * std::sin(phi), std::cos(theta)};
}

}  // namespace

std::unique_ptr<RglMeasured> parse_rgl(const MeasuredSource& source) {
    const Fields fields(source);
    MeasuredInfo info;
    info.format = "rgl";
    if (const Tensor* t = fields.look("description"); t && t->type == TensorType::u8)
        info.description = text_of(*t);
    RglTables t;
    const double slack = 1e-5;
    std::vector<float> phi = fields.nodes("phi_i", -2. * pi - slack, 2. * pi + slack);
    std::vector<float> theta = fields.nodes("theta_i", 0., 0.5 * pi + slack);
    const std::vector<std::uint64_t> slices{phi.size(), theta.size()};
    t.incidence = ParameterGrid(std::move(phi), std::move(theta));
    t.ndf = fields.table<BilinearTable>("ndf", {}, false);
    t.sigma = fields.table<BilinearTable>("sigma", {}, false);
    t.vndf = fields.table<MarginalWarp>("vndf", slices, false);
    // Only where samples go: noise below 0 needs none.
    t.luminance = fields.table<MarginalWarp>("luminance", slices, true);
    take_spectra(fields, t, info, slices);
    const Tensor& jacobian = fields.find("jacobian", TensorType::u8, 1);
    if (jacobian.bytes.empty()) fields.fail("field 'jacobian' is empty");
    t.jacobian = jacobian.bytes[0] != 0;
    info.isotropic = t.isotropic();
    info.cosine = true;
    info.parameterisation = fmt::format(
        "adaptive, by visible normals (Dupuy and Jakob 2018): {}theta_i ({}), {} x {} warped half "
        "vectors",
        info.isotropic ? "" : fmt::format("phi_i ({}), ", slices[0]), slices[1], t.width, t.height);
    info.scale = t.jacobian ? "times D(h) / (4 sigma(wi)), from the file's ndf and sigma" : "none";
    if (const Tensor* valid = fields.look("valid"); valid && valid->type == TensorType::u8) {
        std::size_t set = 0;
        for (const char c : valid->bytes) set += std::size_t(__builtin_popcount((unsigned char)c));
        info.notes.push_back(fmt::format(
            "the field 'valid' marks {} of {} nodes; files of the database use it either way "
            "round, so nothing is left out for it",
            set, 8 * valid->bytes.size()));
    }
    return std::make_unique<RglMeasured>(RglBrdf(std::move(t)), std::move(info));
}

RglMeasured::RglMeasured(RglBrdf brdf, MeasuredInfo info) : brdf_(std::move(brdf)) {
    info_ = std::move(info);
    count_samples();
}

bool RglMeasured::eval(const Vec3d& wi, const Vec3d& wo, std::span<double> out) const {
    float value[max_measured_channels];
    if (!brdf_.eval(Vec3f(wi), Vec3f(wo), value)) return false;
    for (int c = 0; c < info_.channels; ++c) out[c] = double(value[c]) / wo.z;
    return true;
}

void RglMeasured::eval_many(std::span<const Vec3d> wi, std::span<const Vec3d> wo,
                            std::span<double> out, std::span<bool> known) const {
    const std::size_t n = std::size_t(info_.channels);
    constexpr std::size_t block = 256;
    std::vector<float> values(n * std::min(block, wi.size()));
    for (std::size_t first = 0; first < wi.size(); first += block) {
        const std::size_t count = std::min(block, wi.size() - first);
        Vec3f given[block], other[block];
        for (std::size_t i = 0; i < count; ++i) {
            given[i] = Vec3f(wi[first + i]);
            other[i] = Vec3f(wo[first + i]);
            known[first + i] = given[i].z > 0.f && other[i].z > 0.f;
        }
        const std::span<float> here = std::span(values).first(count * n);
        brdf_.eval_many({given, count}, {other, count}, here, {});
        for (std::size_t k = 0; k < here.size(); ++k)
            out[first * n + k] = double(here[k]) / wo[first + k / n].z;
    }
}

void RglMeasured::for_each_sample(const std::function<void(const MeasuredSample&)>& visit) const {
    const RglTables& t = brdf_.tables();
    std::vector<double> value(std::size_t(info_.channels));
    std::size_t slice = 0;
    for (const float phi : t.incidence.slow())
        for (const float theta : t.incidence.fast()) {
            const Vec3d wi = direction(theta, phi);
            for (int y = 0; y < t.height; ++y)
                for (int x = 0; x < t.width; ++x) {
                    const RglBrdf::Node node = brdf_.node(Vec3f(wi), slice, x, y);
                    const bool above = node.direction.z > 0.f;
                    bool negative = false;
                    const float* stored =
                        t.spectra.data() + ((slice * t.height + y) * t.width + x) * value.size();
                    for (std::size_t c = 0; c < value.size(); ++c) {
                        value[c] = above ? double(stored[c]) * node.factor / node.direction.z : 0.;
                        negative |= stored[c] < 0.f;
                    }
                    visit({wi, Vec3d(node.direction),
                           !above     ? SampleState::missing
                           : negative ? SampleState::negative
                                      : SampleState::good,
                           value});
                }
            ++slice;
        }
}

const MeasuredFormat& rgl_format() {
    static const MeasuredFormat format{
        .name = "rgl",
        .title = "RGL",
        .ending = ".bsdf",
        .summary =
            "tensor files of the RGL database, isotropic and anisotropic, rgb and spectral "
            "(Dupuy and Jakob 2018)",
        .memory = 3.,
        .recognise = [](const FileStart& start) { return is_tensor_file(start.head); },
        .read = [](const MeasuredSource& source) -> std::unique_ptr<Measured> {
            return parse_rgl(source);
        },
        .keeps = {.wavelengths = true, .anisotropy = true},
        .write = write_rgl,
    };
    return format;
}

}  // namespace nacre

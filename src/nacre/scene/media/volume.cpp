#include "nacre/scene/volume.h"

#include "nacre/scene/integrable_volume.h"
#include "nacre/scene/media/volume_grid.h"
#include "nacre/text/names.h"

namespace nacre {

namespace {

class ConstantVolume final : public IntegrableVolume {
  public:
    explicit ConstantVolume(SpectrumPtr value) : value_(std::move(value)) {}

    Spectral eval(const Point3f&, const Wavelengths& w) const override { return value_->eval(w); }
    float max() const override { return value_->max(); }
    Spectral integral(const Point3f&, const Vec3f&, float begin, float end,
                      const Wavelengths& w) const override {
        return value_->eval(w) * Spectral(end - begin);
    }
    Box3f bounds() const override { return {{-1e30f, -1e30f, -1e30f}, {1e30f, 1e30f, 1e30f}}; }

  private:
    SpectrumPtr value_;
};

VolumePtr make_constant_volume(const SceneNode& node, ColorRole role, BuildContext&) {
    return std::make_shared<ConstantVolume>(get_spectrum(node, "value", role, make_constant(1.f)));
}

VolumePtr make_grid(const SceneNode& node, ColorRole role, BuildContext& context) {
    GridVolumeOptions options;
    options.to_world = node.get_transform("to_world");
    options.role = role;
    if (node.get_choice("filter_type", {"trilinear", "nearest"}) == "nearest")
        options.filter = VolumeFilter::nearest;
    const std::string wrap = node.get_choice("wrap_mode", {"clamp", "repeat", "mirror"});
    if (wrap == "repeat") options.wrap = VolumeWrap::repeat;
    if (wrap == "mirror") options.wrap = VolumeWrap::mirror;
    const bool use_grid_bbox = node.get_bool("use_grid_bbox", false);
    const bool raw = node.get_bool("raw", false);
    // How Mitsuba samples on a GPU, and a maximum for it to trust: nacre knows the maximum.
    node.get_bool("accel", true);
    node.get_float("max_value", 0.0);

    const std::filesystem::path file = context.file(node, "filename");
    if (file.extension() == ".vdb")
        return make_vdb_volume(file, node.get_string("grid", ""), use_grid_bbox, options);
    const std::shared_ptr<const VoxelGrid> grid = read_vol(file);
    if (raw && grid->channels == 3)
        node.fail_at("raw",
                     "raw=true is for data that are no colours, but the three channels of a "
                     "medium's volume are red, green and blue; leave raw out");
    if (use_grid_bbox) options.to_world = options.to_world * grid->file_placement;
    return make_grid_volume(grid, options, file.string());
}

using Factory = VolumePtr (*)(const SceneNode&, ColorRole, BuildContext&);
constexpr std::pair<std::string_view, Factory> factories[] = {
    {"constvolume", make_constant_volume},
    {"gridvolume", make_grid},
};

}  // namespace

VolumePtr make_volume(const SceneNode& node, ColorRole role, BuildContext& context) {
    std::vector<std::string> known;
    for (const auto& [name, factory] : factories) {
        if (name == node.type) {
            VolumePtr volume = factory(node, role, context);
            node.check_all_used();
            return volume;
        }
        known.emplace_back(name);
    }
    node.fail(unknown_name("volume type", node.type, known));
}

}  // namespace nacre

// nacre image: from one image format to another, brighter or darker.
#include <CLI/CLI.hpp>

#include "apps/cli/number_option.h"
#include "apps/cli/output_file.h"
#include "apps/cli/verb.h"
#include "nacre/image/image.h"

namespace nacre::cli {
namespace {

struct ImageArguments {
    std::string input, output;
    float exposure = 0;
};

int run(const ImageArguments& o) {
    check_image_output(o.output);
    refuse_input_as_output(o.output, {o.input});
    Image image = read_image(o.input);
    const float gain = std::exp2(o.exposure);
    for (int c = 0; c < image.channel_count(); ++c) {
        const std::string& name = image.channels[c];
        if (name != "R" && name != "G" && name != "B" && name != "Y") continue;
        for (std::size_t i = c; i < image.data.size(); i += image.channels.size())
            image.data[i] *= gain;
    }
    write_image(image, o.output);
    return success;
}

}  // namespace

Action set_up_image(CLI::App& app, const Invocation&) {
    auto o = std::make_shared<ImageArguments>();
    app.add_option("input", o->input, "image: .exr, .pfm, .hdr, .png, .jpg")->required();
    app.add_option("-o,--output", o->output, "image: .exr, .pfm, .hdr, .png")->required();
    add_number(app, "--exposure", o->exposure, {-100, 100}, "stops: every one doubles the light");
    return [o] { return run(*o); };
}

}  // namespace nacre::cli

// OpenEXR, read from and written to memory through the library's string streams: a file's name
// stays out of the library's messages and an incomplete write is noticed by whoever writes the
// bytes.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputPart.h>
#include <OpenEXR/ImfMultiPartInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <algorithm>
#include <cctype>

#include "nacre/image/formats.h"
#include "nacre/math/error.h"

namespace nacre::image_formats {
namespace {

/// R, G, B, A first, then the others by name (which is how the file stores all of them).
int channel_rank(const std::string& name) {
    constexpr std::string_view order = "RGBA";
    return name.size() == 1 && order.find(name) != order.npos ? static_cast<int>(order.find(name))
                                                              : 4;
}

std::vector<std::string> channels_of(const Imf::Header& header) {
    std::vector<std::string> names;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c)
        names.emplace_back(c.name());
    return names;
}

std::string upper(std::string text) {
    for (char& c : text) c = static_cast<char>(std::toupper(static_cast<unsigned char>(c)));
    return text;
}

/// Channels of a file that make a picture: those named PREFIX.R, PREFIX.G, PREFIX.B (and A), in
/// either case, or PREFIX.Y alone.
struct Layer {
    int part = 0;
    std::string name;  ///< for file.exr#name; empty for plain R, G, B in a file of one part
    bool plain = false;
    std::map<std::string, std::string> channels;  ///< R, G, B, A or Y -> name in the file
};

std::vector<Layer> layers_of(const Imf::MultiPartInputFile& file) {
    std::vector<Layer> layers;
    for (int part = 0; part < file.parts(); ++part) {
        const Imf::Header& header = file.header(part);
        std::map<std::string, std::map<std::string, std::string>> by_prefix;
        for (const std::string& name : channels_of(header)) {
            const std::size_t dot = name.rfind('.');
            by_prefix[dot == name.npos ? "" : name.substr(0, dot)]
                     [upper(dot == name.npos ? name : name.substr(dot + 1))] = name;
        }
        const std::string part_name = file.parts() == 1  ? ""
                                      : header.hasName() ? header.name()
                                                         : fmt::to_string(part);
        for (auto& [prefix, channels] : by_prefix) {
            const bool rgb =
                channels.contains("R") && channels.contains("G") && channels.contains("B");
            // Luminance beside chroma (RY, BY) is no grey picture.
            const bool grey = channels.contains("Y") && !channels.contains("RY") &&
                              !channels.contains("BY") && !channels.contains("R") &&
                              !channels.contains("G") && !channels.contains("B");
            if (!rgb && !grey) continue;
            Layer layer{part, part_name, prefix.empty(), {}};
            if (!prefix.empty()) layer.name += (part_name.empty() ? "" : ".") + prefix;
            for (const char* c : {"R", "G", "B", "A", "Y"})
                if ((*c == 'Y') == grey || *c == 'A')
                    if (const auto found = channels.find(c); found != channels.end())
                        layer.channels[c] = found->second;
            layers.push_back(std::move(layer));
        }
    }
    return layers;
}

std::string joined(const std::vector<std::string>& words) {
    std::string text;
    for (const std::string& w : words) text += (text.empty() ? "" : ", ") + w;
    return text;
}

Layer choose(const Imf::MultiPartInputFile& file, const std::string& wanted) {
    const std::vector<Layer> layers = layers_of(file);
    std::vector<std::string> names;
    for (const Layer& l : layers) {
        if (!wanted.empty() && (l.name == wanted || (l.plain && fmt::to_string(l.part) == wanted)))
            return l;
        names.push_back(l.name.empty() ? fmt::to_string(l.part) : l.name);
    }
    if (layers.empty()) {
        std::vector<std::string> channels;
        for (int part = 0; part < file.parts(); ++part)
            for (std::string& c : channels_of(file.header(part))) channels.push_back(std::move(c));
        throw InputError(fmt::format(
            "has no R, G and B and no single luminance Y; its channels are: {}", joined(channels)));
    }
    if (!wanted.empty() && layers.size() == 1 && layers.front().name.empty())
        throw InputError(fmt::format(
            "has no layers but one picture, R, G and B or Y by themselves: leave out '#{}'",
            wanted));
    if (!wanted.empty())
        throw InputError(fmt::format("has no layer '{}'; it has: {}", wanted, joined(names)));
    const auto plain = [](const Layer& l) { return l.plain; };
    if (std::ranges::count_if(layers, plain) == 1) return *std::ranges::find_if(layers, plain);
    if (layers.size() == 1) return layers.front();
    throw InputError(
        fmt::format("holds several pictures: {}; name one behind the file, as in "
                    "file.exr#{}",
                    joined(names), names.front()));
}

/// Where a header puts its pixels: within the display window, which is the picture.
struct Windows {
    Imath::Box2i data, display, both;

    explicit Windows(const Imf::Header& header)
        : data(header.dataWindow()), display(header.displayWindow()) {
        both.min = {std::max(data.min.x, display.min.x), std::max(data.min.y, display.min.y)};
        both.max = {std::min(data.max.x, display.max.x), std::min(data.max.y, display.max.y)};
        if (both.isEmpty())
            throw InputError(fmt::format(
                "shows nothing: its data window ({}) lies outside its display window ({})",
                text(data), text(display)));
    }
    static std::string text(const Imath::Box2i& b) {
        return fmt::format("{}, {} to {}, {}", b.min.x, b.min.y, b.max.x, b.max.y);
    }
    static double width(const Imath::Box2i& b) { return double(b.max.x) - b.min.x + 1; }
    static double height(const Imath::Box2i& b) { return double(b.max.y) - b.min.y + 1; }
};

void copy_metadata(const Imf::Header& header, Image& image) {
    for (auto a = header.begin(); a != header.end(); ++a) {
        // `type` and `name` describe the part of the file, not the picture.
        const std::string key = a.name();
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
        if (text && key != "type" && key != "name") image.metadata[key] = text->value();
    }
}

Image decode(const std::string& bytes, const std::string& wanted, bool any_channels) {
    Imf::StdISStream stream;
    stream.str(bytes);
    Imf::MultiPartInputFile file(stream);
    Layer layer;
    if (!any_channels || !wanted.empty()) layer = choose(file, wanted);
    const Imf::Header& header = file.header(layer.part);
    if (header.hasType() && header.type().starts_with("deep"))
        throw InputError("is a deep image; flatten it");
    // The layer's own names become R, G, B, A; of the rest of its part all is kept.
    std::map<std::string, std::string> renamed;
    for (const auto& [to, from] : layer.channels) renamed[from] = to;
    std::vector<std::pair<std::string, std::string>> names;  // ours, the file's
    for (const std::string& name : channels_of(header)) {
        const Imf::Channel& channel = header.channels()[name.c_str()];
        if (channel.xSampling != 1 || channel.ySampling != 1)
            throw InputError(fmt::format(
                "channel {} is stored at a lower resolution than the image; save it as plain RGB",
                name));
        const auto found = renamed.find(name);
        const bool taken = found == renamed.end() && layer.channels.contains(name);
        if (!taken) names.emplace_back(found == renamed.end() ? name : found->second, name);
    }
    if (names.empty()) throw InputError("has no channels");
    std::stable_sort(names.begin(), names.end(), [](const auto& a, const auto& b) {
        return channel_rank(a.first) < channel_rank(b.first);
    });
    const Windows windows(header);
    // Deflate packs at most 1032 to 1; the DWA codecs store a constant block of 8 x 8 pixels in a
    // few bits and deflate those once more.
    const Imf::Compression codec = header.compression();
    const bool dwa = codec == Imf::DWAA_COMPRESSION || codec == Imf::DWAB_COMPRESSION;
    const auto n = static_cast<double>(names.size());
    check_size(Windows::width(windows.data), Windows::height(windows.data), n,
               static_cast<double>(bytes.size()), dwa ? 65536 : 1032);
    // A small window in a large picture is nothing unusual, up to a point.
    check_size(Windows::width(windows.display), Windows::height(windows.display), n,
               static_cast<double>(bytes.size()) + 65536, 1032);
    if (!file.partComplete(layer.part))
        throw InputError("is truncated: rows are missing; copy it again");

    std::vector<std::string> ours;
    for (const auto& [name, of_file] : names) ours.push_back(name);
    Image stored(static_cast<int>(Windows::width(windows.data)),
                 static_cast<int>(Windows::height(windows.data)), ours);
    const std::size_t pixel = sizeof(float) * ours.size();
    Imf::FrameBuffer buffer;
    for (int c = 0; c < stored.channel_count(); ++c)
        buffer.insert(names[c].second, Imf::Slice::Make(Imf::FLOAT, &stored.data[c], windows.data,
                                                        pixel, pixel * stored.width));
    Imf::InputPart part(file, layer.part);
    part.setFrameBuffer(buffer);
    part.readPixels(windows.data.min.y, windows.data.max.y);
    copy_metadata(header, stored);
    for (const Layer& l : layers_of(file))
        if (!l.name.empty()) stored.layers.push_back(l.name);
    if (windows.data == windows.display) return stored;

    // Black and transparent where nothing is stored; what lies beyond the picture's edge is not
    // shown.
    Image shown(static_cast<int>(Windows::width(windows.display)),
                static_cast<int>(Windows::height(windows.display)), ours);
    shown.metadata = std::move(stored.metadata);
    shown.layers = std::move(stored.layers);
    shown.data_window = Windows::text(windows.data);
    const Imath::V2i at = windows.both.min - windows.display.min,
                     from = windows.both.min - windows.data.min;
    const int width = windows.both.max.x - windows.both.min.x + 1,
              height = windows.both.max.y - windows.both.min.y + 1;
    for (int y = 0; y < height; ++y)
        std::copy_n(&stored.data[(std::size_t(from.y + y) * stored.width + from.x) * ours.size()],
                    width * ours.size(),
                    &shown.data[(std::size_t(at.y + y) * shown.width + at.x) * ours.size()]);
    return shown;
}

}  // namespace

Image decode_exr(const std::string& bytes, const std::string& layer, bool any_channels) {
    try {
        return decode(bytes, layer, any_channels);
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& e) {
        std::string reason = e.what();
        while (!reason.empty() && (reason.back() == '.' || reason.back() == '\n'))
            reason.pop_back();
        throw InputError(fmt::format("is damaged or truncated ({}); copy it again", reason));
    }
}

std::string encode_exr(const Image& image) {
    Imf::Header header(image.width, image.height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    const std::size_t pixel = sizeof(float) * image.channels.size();
    for (int c = 0; c < image.channel_count(); ++c) {
        header.channels().insert(image.channels[c], Imf::Channel(Imf::FLOAT));
        buffer.insert(image.channels[c],
                      Imf::Slice(Imf::FLOAT,
                                 reinterpret_cast<char*>(const_cast<float*>(image.data.data() + c)),
                                 pixel, pixel * image.width));
    }
    for (const auto& [key, value] : image.metadata) header.insert(key, Imf::StringAttribute(value));
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(image.height);
    }  // the table of row offsets is written by the destructor
    return stream.str();
}

}  // namespace nacre::image_formats

// OpenEXR, read from and written to memory through the library's string streams: a file's name
// stays out of the library's messages and an incomplete write is noticed by whoever writes the
// bytes.
#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfCompression.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include "nacre/math/error.h"
#include "nacre/scene/image_formats.h"

namespace nacre::image_formats {
namespace {

/// R, G, B, A first, then the others by name (which is how the file stores all of them).
int channel_rank(const std::string& name) {
    constexpr std::string_view order = "RGBA";
    return name.size() == 1 && order.find(name) != order.npos ? static_cast<int>(order.find(name))
                                                              : 4;
}

Image decode(const std::string& bytes) {
    Imf::StdISStream stream;
    stream.str(bytes);
    Imf::InputFile file(stream);
    const Imf::Header& header = file.header();
    const Imath::Box2i window = header.dataWindow();
    std::vector<std::string> names;
    for (auto c = header.channels().begin(); c != header.channels().end(); ++c) {
        if (c.channel().xSampling != 1 || c.channel().ySampling != 1)
            throw InputError(fmt::format(
                "channel {} is stored at a lower resolution than the image; save it as plain RGB",
                c.name()));
        names.emplace_back(c.name());
    }
    if (names.empty()) throw InputError("has no channels");
    std::stable_sort(names.begin(), names.end(), [](const auto& a, const auto& b) {
        return channel_rank(a) < channel_rank(b);
    });
    const double width = double(window.max.x) - window.min.x + 1,
                 height = double(window.max.y) - window.min.y + 1;
    // Deflate packs at most 1032 to 1; the DWA codecs store a constant block of 8 x 8 pixels in a
    // few bits and deflate those once more.
    const Imf::Compression codec = header.compression();
    const bool dwa = codec == Imf::DWAA_COMPRESSION || codec == Imf::DWAB_COMPRESSION;
    check_size(width, height, static_cast<double>(names.size()), static_cast<double>(bytes.size()),
               dwa ? 65536 : 1032);
    if (!file.isComplete()) throw InputError("is truncated: rows are missing; copy it again");

    Image image(static_cast<int>(width), static_cast<int>(height), names);
    Imf::FrameBuffer buffer;
    for (int c = 0; c < image.channel_count(); ++c)
        buffer.insert(names[c], Imf::Slice::Make(Imf::FLOAT, &image.data[c], window,
                                                 sizeof(float) * names.size(),
                                                 sizeof(float) * names.size() * image.width));
    file.setFrameBuffer(buffer);
    file.readPixels(window.min.y, window.max.y);
    for (auto a = header.begin(); a != header.end(); ++a) {
        // `type` and `name` describe the part of the file, not the picture.
        const std::string key = a.name();
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
        if (text && key != "type" && key != "name") image.metadata[key] = text->value();
    }
    return image;
}

}  // namespace

Image decode_exr(const std::string& bytes) {
    try {
        return decode(bytes);
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

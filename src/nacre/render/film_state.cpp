#include "nacre/render/film_state.h"

#include <OpenEXR/ImfChannelList.h>
#include <OpenEXR/ImfFrameBuffer.h>
#include <OpenEXR/ImfHeader.h>
#include <OpenEXR/ImfInputFile.h>
#include <OpenEXR/ImfOutputFile.h>
#include <OpenEXR/ImfStdIO.h>
#include <OpenEXR/ImfStringAttribute.h>

#include <cmath>

#include "nacre/math/error.h"
#include "nacre/text/number.h"
#include "nacre/text/split_words.h"
#include "nacre/text/whole_file.h"

namespace nacre {
namespace {

// A double as two numbers of 32 bits, in the order of this processor's memory.
static_assert(std::endian::native == std::endian::little);
static_assert(sizeof(PixelSums) == 14 * sizeof(std::uint32_t));

constexpr const char* colors[] = {"R", "G", "B"};

/// The channel of each 32-bit word of PixelSums.
std::vector<std::string> word_names(const std::string& prefix) {
    std::vector<std::string> names;
    for (const char* what : {"sum", "square"})
        for (const char* c : colors)
            for (const char* half : {"low", "high"})
                names.push_back(fmt::format("{}{}.{}.{}", prefix, what, c, half));
    names.push_back(prefix + "count");
    names.push_back(prefix + "invalid");
    return names;
}

/// `insert(name, slice)` for each word of each pixel.
template <class F>
void for_each_word(std::vector<PixelSums>& pixels, int width, const std::string& prefix,
                   F&& insert) {
    char* at = reinterpret_cast<char*>(pixels.data());
    for (const std::string& name : word_names(prefix)) {
        insert(name, Imf::Slice(Imf::UINT, at, sizeof(PixelSums), sizeof(PixelSums) * width));
        at += sizeof(std::uint32_t);
    }
}

std::string text_of(const FilmSettings& s) {
    return fmt::format("{} {} {} {} {} {} {} {} {} {} {} {} {}", s.width, s.height, s.crop_x,
                       s.crop_y, s.crop_width, s.crop_height, int(s.sample_border), int(s.quantity),
                       s.filter.type, s.filter.radius, s.filter.stddev, s.filter.b, s.filter.c);
}

InputError damaged(const std::string& what) { return InputError("it holds " + what); }

/// The numbers of an attribute, one after the other.
class Numbers {
  public:
    Numbers(std::string name, std::string text)
        : name_(std::move(name)), text_(std::move(text)), words_(split_words(text_, " ;")) {}

    bool at_end() const { return next_ == words_.size(); }
    std::string_view word() {
        if (at_end()) throw damaged("too little in " + name_);
        return words_[next_++];
    }
    double number() {
        const std::string_view text = word();
        const auto n = parse_number(text);
        if (!n) throw damaged(fmt::format("'{}' in {}", text, name_));
        return *n;
    }
    int whole(int least, int most) {
        const std::string_view text = word();
        const auto n = parse_integer(text);
        if (!n || *n < least || *n > most) throw damaged(fmt::format("'{}' in {}", text, name_));
        return int(*n);
    }

  private:
    const std::string name_, text_;
    const std::vector<std::string_view> words_;
    std::size_t next_ = 0;
};

FilmSettings settings_of(const std::string& text) {
    constexpr int most = 1 << 24;
    Numbers n("nacre.film", text);
    FilmSettings s;
    s.width = n.whole(1, most);
    s.height = n.whole(1, most);
    s.crop_x = n.whole(0, most);
    s.crop_y = n.whole(0, most);
    s.crop_width = n.whole(1, most);
    s.crop_height = n.whole(1, most);
    s.sample_border = n.whole(0, 1) != 0;
    s.quantity = FilmQuantity(n.whole(0, 2));
    s.filter.type = std::string(n.word());
    s.filter.radius = float(n.number());
    s.filter.stddev = float(n.number());
    s.filter.b = float(n.number());
    s.filter.c = float(n.number());
    return s;
}

std::string attribute(const Imf::Header& header, const char* name) {
    const auto* text = header.findTypedAttribute<Imf::StringAttribute>(name);
    if (!text) throw damaged(fmt::format("no {}", name));
    return text->value();
}

bool is_finite(const PixelSums& p) {
    for (int c = 0; c < 3; ++c)
        if (!std::isfinite(p.sum[c]) || !(p.sum2[c] >= 0)) return false;
    return true;
}

}  // namespace

std::string FilmState::encode(const Film& film, const std::map<std::string, std::string>& notes) {
    Film copy(film.settings());  // OpenEXR asks for memory that it may write to
    copy.merge(film);
    const int width = film.width(), height = film.height();
    std::vector<Vec3f> mean, variance;
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x) {
            mean.push_back(film.mean(x, y));
            variance.push_back(film.sample_variance(x, y));
        }
    Imf::Header header(width, height);
    header.compression() = Imf::ZIP_COMPRESSION;
    Imf::FrameBuffer buffer;
    const auto insert = [&](const std::string& name, const Imf::Slice& slice) {
        header.channels().insert(name, Imf::Channel(slice.type));
        buffer.insert(name, slice);
    };
    const auto insert_colors = [&](const std::string& prefix, std::vector<Vec3f>& values) {
        for (int c = 0; c < 3; ++c)
            insert(prefix + colors[c],
                   Imf::Slice(Imf::FLOAT, reinterpret_cast<char*>(&values[0][c]), sizeof(Vec3f),
                              sizeof(Vec3f) * width));
    };
    insert_colors("", mean);
    insert_colors("variance.", variance);
    for_each_word(copy.pixels_, width, "", insert);
    if (!copy.negative_.empty()) for_each_word(copy.negative_, width, "negative.", insert);

    std::string invalid;
    for (const InvalidSample& s : film.invalid_)
        invalid += fmt::format("{}{} {} {} {} {} {}", invalid.empty() ? "" : "; ", s.x, s.y,
                               s.sample, s.value.x, s.value.y, s.value.z);
    for (const auto& [name, value] : notes)
        header.insert("nacre." + name, Imf::StringAttribute(value));
    header.insert("nacre.film", Imf::StringAttribute(text_of(film.settings())));
    header.insert("nacre.invalid_samples", Imf::StringAttribute(invalid));
    Imf::StdOSStream stream;
    {
        Imf::OutputFile file(stream, header);
        file.setFrameBuffer(buffer);
        file.writePixels(height);
    }  // the table of row offsets is written by the destructor
    return stream.str();
}

FilmState FilmState::decode(const std::string& bytes) {
    try {
        Imf::StdISStream stream;
        stream.str(bytes);
        Imf::InputFile file(stream);
        const Imf::Header& header = file.header();
        FilmSettings settings = settings_of(attribute(header, "nacre.film"));
        const Imath::Box2i window = header.dataWindow();
        if (window.min != Imath::V2i(0, 0) || window.max.x != settings.crop_width - 1 ||
            window.max.y != settings.crop_height - 1)
            throw damaged("pixels of another film");
        if (!file.isComplete()) throw damaged("not all rows");
        FilmState state{Film(settings), {}};
        Film& film = state.film;
        Imf::FrameBuffer buffer;
        const auto insert = [&](const std::string& name, const Imf::Slice& slice) {
            const Imf::Channel* channel = header.channels().findChannel(name);
            if (!channel || channel->type != slice.type) throw damaged("no " + name);
            buffer.insert(name, slice);
        };
        for_each_word(film.pixels_, film.width(), "", insert);
        if (!film.negative_.empty())
            for_each_word(film.negative_, film.width(), "negative.", insert);
        file.setFrameBuffer(buffer);
        file.readPixels(0, film.height() - 1);
        if (!std::ranges::all_of(film.pixels_, is_finite) ||
            !std::ranges::all_of(film.negative_, is_finite))
            throw damaged("values that are not numbers");

        Numbers invalid("nacre.invalid_samples", attribute(header, "nacre.invalid_samples"));
        while (!invalid.at_end()) {
            InvalidSample s{};
            s.x = int(invalid.number());
            s.y = int(invalid.number());
            s.sample = std::uint32_t(invalid.number());
            for (int c = 0; c < 3; ++c) s.value[c] = float(invalid.number());
            const int x = s.x - settings.crop_x, y = s.y - settings.crop_y;
            if (x < 0 || y < 0 || x >= film.width() || y >= film.height())
                throw damaged("an invalid sample beyond its pixels");
            film.invalid_.push_back(s);
        }
        for (auto a = header.begin(); a != header.end(); ++a) {
            const std::string name = a.name();
            const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
            if (text && name.starts_with("nacre.")) state.notes[name.substr(6)] = text->value();
        }
        state.notes.erase("film");
        state.notes.erase("invalid_samples");
        return state;
    } catch (const InputError&) {
        throw;
    } catch (const std::exception& error) {
        throw InputError(fmt::format("it is damaged or truncated ({})", error.what()));
    }
}

void FilmState::save(const Film& film, const std::map<std::string, std::string>& notes,
                     const std::filesystem::path& file) {
    write_whole_file(file, encode(film, notes));
}

FilmState FilmState::load(const std::filesystem::path& file) {
    const std::optional<std::string> bytes = read_whole_file(file);
    if (!bytes) throw InputError("it cannot be read");
    return decode(*bytes);
}

}  // namespace nacre

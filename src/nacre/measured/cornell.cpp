// The gonioreflectometer measurements of Cornell's Program of Computer Graphics, as text: a count
// of wavelengths, the wavelengths (nm), then a sample a line: theta_i phi_i theta_s phi_s (radians)
// and a BRDF value (sr^-1) for each wavelength. '#' begins a comment.
//
//   S. C. Foo 1997, A Gonioreflectometer for Measuring the Bidirectional Reflectance of Materials
//   for Use in Illumination Computations, Cornell University. Isotropic.
#include <numbers>

#include "nacre/measured/number_text.h"
#include "nacre/measured/scattered.h"
#include "nacre/text/lines.h"
#include "nacre/text/number.h"

namespace nacre {
namespace {

constexpr double pi = std::numbers::pi;

/// The measured geometries lie 5 to 15 degrees from each other.
constexpr double reach = 0.2;

/// Begins with a count and as many wavelengths, or says so in a comment.
bool is_cornell(const FileStart& start) {
    LineSplitter lines(start.head);
    std::string_view line;
    std::vector<double> numbers;
    while (lines.next(line)) {
        if (line.starts_with('#') && line.find("num wls") != line.npos) return true;
        // The last line of the beginning may be cut.
        if (lines.offset() >= start.head.size() && start.size > start.head.size()) break;
        std::string_view rest = without_comment(line);
        for (std::string_view word = take_word(rest); !word.empty(); word = take_word(rest)) {
            const auto value = parse_number(word);
            if (!value) return false;
            numbers.push_back(*value);
        }
        if (numbers.empty()) continue;
        const double n = numbers[0];
        if (!(n >= 1. && n <= max_measured_channels && n == std::floor(n))) return false;
        for (std::size_t i = 1; i < numbers.size() && double(i) <= n; ++i)
            if (!(numbers[i] > (i > 1 ? numbers[i - 1] : 100.))) return false;
        if (double(numbers.size()) > n) return numbers.size() > 1;
    }
    return false;
}

class Reader {
  public:
    explicit Reader(const MeasuredSource& source) : source_(source), lines_(source.bytes) {}

    std::unique_ptr<Measured> read() {
        MeasuredInfo info;
        info.format = "cornell";
        info.parameterisation = "scattered directions theta_i, phi_i, theta_s, phi_s";
        info.scale = "none: sr^-1";
        read_wavelengths(info);
        info.description = description_;
        const std::size_t n = std::size_t(info.channels);
        ScatteredBuilder builder(std::move(info));
        while (next_numbers()) {
            if (numbers_.size() != 4 + n)
                source_.fail(lines_.line(),
                             fmt::format("has {} numbers, but a sample has 4 angles and {} values",
                                         numbers_.size(), n));
            const double ti = theta("theta_i", numbers_[0]), pi_ = phi("phi_i", numbers_[1]);
            const double to = theta("theta_s", numbers_[2]), po = phi("phi_s", numbers_[3]);
            builder.add(polar_direction(ti, pi_), polar_direction(to, po),
                        std::span<const double>(numbers_).subspan(4));
        }
        return builder.build(source_, reach);
    }

  private:
    double theta(std::string_view name, double value) {
        // At the horizon itself no light falls in or is seen.
        return std::min(checked_theta(source_, lines_.line(), name, value, 0.5 * pi),
                        0.5 * pi - 1e-9);
    }
    double phi(std::string_view name, double value) {
        return checked_phi(source_, lines_.line(), name, value);
    }

    /// The numbers of the next line that has any. Comments before the first are the description.
    bool next_numbers() {
        numbers_.clear();
        std::string_view line;
        while (lines_.next(line)) {
            const std::string_view text = without_comment(line);
            if (!started_ && text.empty() && line.starts_with('#')) describe(line.substr(1));
            take_numbers(source_, lines_.line(), text, false, numbers_);
            if (numbers_.empty()) continue;
            started_ = true;
            return true;
        }
        return false;
    }
    void describe(std::string_view comment) {
        while (!comment.empty() && is_blank(comment.front())) comment.remove_prefix(1);
        if (comment.empty() || comment.starts_with("num wls")) return;
        description_ += (description_.empty() ? "" : "; ") + std::string(comment);
    }
    void read_wavelengths(MeasuredInfo& info) {
        if (!next_numbers()) source_.fail("holds no numbers; it is incomplete: fetch it again");
        const double n = numbers_[0];
        if (!(n >= 1. && n <= max_measured_channels && n == std::floor(n)))
            source_.fail(lines_.line(), fmt::format("the number of wavelengths must be a whole "
                                                    "number from 1 to {}, not {:g}",
                                                    max_measured_channels, n));
        std::vector<double>& nm = info.wavelengths;
        nm.assign(numbers_.begin() + 1, numbers_.end());
        while (nm.size() < std::size_t(n)) {
            if (!next_numbers())
                source_.fail(
                    fmt::format("breaks off after {} of {} wavelengths; it is incomplete: "
                                "fetch it again",
                                nm.size(), n));
            nm.insert(nm.end(), numbers_.begin(), numbers_.end());
        }
        if (nm.size() > std::size_t(n))
            source_.fail(lines_.line(),
                         fmt::format("{} wavelengths stand where {} were announced", nm.size(), n));
        for (std::size_t i = 0; i < nm.size(); ++i)
            if (!(nm[i] > (i ? nm[i - 1] : 0.)))
                source_.fail(
                    lines_.line(),
                    fmt::format("wavelengths must be positive and ascend, but {:g} {}", nm[i],
                                i ? fmt::format("follows {:g}", nm[i - 1]) : "is the first"));
        info.channels = int(nm.size());
    }

    const MeasuredSource& source_;
    LineSplitter lines_;
    std::vector<double> numbers_;
    std::string description_;
    bool started_ = false;
};

}  // namespace

const MeasuredFormat& cornell_format() {
    static const MeasuredFormat format{
        .name = "cornell",
        .title = "Cornell",
        .ending = ".brdf",
        .summary =
            "text of Cornell's gonioreflectometer: scattered samples over wavelengths (Foo "
            "1997)",
        .memory = 24.,
        .recognise = is_cornell,
        .read = [](const MeasuredSource& source) { return Reader(source).read(); },
    };
    return format;
}

}  // namespace nacre

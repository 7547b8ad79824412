// BSDFs in the XML of WINDOW and Radiance (WindowElement): matrices over the patches of a Klems
// basis (klems.h), for light from front and back, reflected and transmitted. "Front" is what the
// file calls so. Of several parts of the spectrum the visible one is read.
#include <pugixml.hpp>

#include "nacre/measured/klems.h"
#include "nacre/measured/number_text.h"
#include "nacre/text/lines.h"
#include "nacre/text/names.h"
#include "nacre/text/number.h"

namespace nacre {
namespace {

using Ring = KlemsBasis::Ring;

/// The bases that files may name without defining them.
const std::vector<KlemsBasis>& known_bases() {
    static const std::vector<KlemsBasis> bases{
        {"LBNL/Klems Full",
         {{0, 5, 1},
          {5, 15, 8},
          {15, 25, 16},
          {25, 35, 20},
          {35, 45, 24},
          {45, 55, 24},
          {55, 65, 24},
          {65, 75, 16},
          {75, 90, 12}}},
        {"LBNL/Klems Half",
         {{0, 6.5, 1},
          {6.5, 19.5, 8},
          {19.5, 32.5, 12},
          {32.5, 46.5, 16},
          {46.5, 61.5, 20},
          {61.5, 76.5, 12},
          {76.5, 90, 4}}},
        {"LBNL/Klems Quarter", {{0, 9, 1}, {9, 27, 8}, {27, 46, 12}, {46, 66, 12}, {66, 90, 8}}},
    };
    return bases;
}

std::string text_of(const pugi::xml_node& node, const char* child) {
    std::string_view text = node.child(child).text().get();
    while (!text.empty() && is_blank(text.front())) text.remove_prefix(1);
    while (!text.empty() && is_blank(text.back())) text.remove_suffix(1);
    return std::string(text);
}

class Reader {
  public:
    explicit Reader(const MeasuredSource& source) : source_(source) {}

    std::unique_ptr<Measured> read() {
        const pugi::xml_parse_result result = document_.load_buffer(
            source_.bytes.data(), source_.bytes.size(), pugi::parse_default, pugi::encoding_utf8);
        if (!result)
            source_.fail(fmt::format("the XML breaks off or is damaged ({}); fetch it again",
                                     result.description()));
        const pugi::xml_node layer =
            document_.child("WindowElement").child("Optical").child("Layer");
        if (!layer) source_.fail("has no WindowElement with Optical and Layer: it holds no BSDF");
        info_.format = "klems";
        info_.isotropic = false;
        info_.channels = 1;
        info_.scale = "none: sr^-1";
        describe(layer.child("Material"));
        read_definition(layer.child("DataDefinition"));
        read_matrices(layer);
        return std::make_unique<KlemsMeasured>(std::move(matrices_), std::move(info_));
    }

  private:
    std::size_t line_of(std::ptrdiff_t offset) const {
        const std::size_t end =
            std::min(std::size_t(std::max<std::ptrdiff_t>(offset, 0)), source_.bytes.size());
        return 1 + std::size_t(std::count(source_.bytes.begin(),
                                          source_.bytes.begin() + std::ptrdiff_t(end), '\n'));
    }
    std::size_t line_of(const pugi::xml_node& node) const { return line_of(node.offset_debug()); }

    void describe(const pugi::xml_node& material) {
        const std::string name = text_of(material, "Name"),
                          maker = text_of(material, "Manufacturer");
        if (name != "Name") info_.description = name;
        if (!maker.empty() && maker != "Manufacturer")
            info_.description += (info_.description.empty() ? "by " : ", by ") + maker;
    }

    double number(const pugi::xml_node& node, const char* child) const {
        const std::string text = text_of(node, child);
        const auto value = parse_number(text);
        if (!value || !std::isfinite(*value))
            source_.fail(line_of(node), fmt::format("{} of {} must be a number, not '{}'", child,
                                                    node.name(), text.substr(0, 24)));
        return *value;
    }

    void read_definition(const pugi::xml_node& definition) {
        const std::string structure = text_of(definition, "IncidentDataStructure");
        if (structure.starts_with("TensorTree"))
            source_.fail(line_of(definition.child("IncidentDataStructure")),
                         "is a tensor tree, which is not read; Radiance's bsdf2klems makes a "
                         "matrix of it");
        if (structure != "Columns" && structure != "Rows")
            source_.fail(line_of(definition),
                         fmt::format("IncidentDataStructure must be Columns or Rows, not '{}'",
                                     structure.substr(0, 24)));
        rows_are_incident_ = structure == "Rows";
        for (const pugi::xml_node& basis : definition.children("AngleBasis")) read_basis(basis);
    }

    void read_basis(const pugi::xml_node& node) {
        KlemsBasis basis;
        basis.name = text_of(node, "AngleBasisName");
        for (const pugi::xml_node& block : node.children("AngleBasisBlock")) {
            const pugi::xml_node bounds = block.child("ThetaBounds");
            const double n = number(block, "nPhis"), low = number(bounds, "LowerTheta"),
                         high = number(bounds, "UpperTheta");
            const double before = basis.rings.empty() ? 0. : basis.rings.back().upper;
            if (!(n >= 1. && n <= 360. && n == std::floor(n)))
                source_.fail(
                    line_of(block),
                    fmt::format("nPhis must be a whole number from 1 to 360, not {:g}", n));
            if (low != before || !(high > low) || high > 90.)
                source_.fail(line_of(block),
                             fmt::format("rings must follow each other up to 90 degrees, but {:g} "
                                         "to {:g} follows {:g}",
                                         low, high, before));
            basis.rings.push_back({low, high, int(n)});
        }
        if (basis.rings.empty() || basis.rings.back().upper != 90.)
            source_.fail(line_of(node),
                         fmt::format("the angle basis '{}' does not reach 90 degrees", basis.name));
        if (basis.size() > 10000)
            source_.fail(line_of(node), fmt::format("the angle basis '{}' has {} patches; at most "
                                                    "10000 can be read",
                                                    basis.name, basis.size()));
        bases_.push_back(std::move(basis));
    }

    const KlemsBasis& find_basis(const pugi::xml_node& block, const char* child) const {
        const std::string name = text_of(block, child);
        std::string known;
        for (const auto* list : {&bases_, &known_bases()})
            for (const KlemsBasis& b : *list) {
                if (plain_name(b.name) == plain_name(name)) return b;
                if (known.find("'" + b.name + "'") == known.npos)
                    known += (known.empty() ? "'" : ", '") + b.name + "'";
            }
        source_.fail(line_of(block), fmt::format("{} '{}' is not defined; known are {}", child,
                                                 name.substr(0, 40), known));
    }

    void read_matrices(const pugi::xml_node& layer) {
        // Which part of the spectrum: the visible one, else the first.
        std::vector<std::string> parts;
        for (const pugi::xml_node& data : layer.children("WavelengthData")) {
            const std::string part = text_of(data, "Wavelength");
            if (std::find(parts.begin(), parts.end(), part) == parts.end()) parts.push_back(part);
        }
        if (parts.empty()) source_.fail("has no WavelengthData: it holds no BSDF");
        std::string chosen = parts[0];
        for (const std::string& part : parts)
            if (plain_name(part) == "visible") chosen = part;
        for (const std::string& part : parts)
            if (part != chosen)
                info_.notes.push_back(fmt::format("also holds '{}', which is not read", part));
        if (plain_name(chosen) != "visible")
            info_.notes.push_back(fmt::format("of the part '{}' of the spectrum", chosen));
        for (const pugi::xml_node& data : layer.children("WavelengthData"))
            if (text_of(data, "Wavelength") == chosen)
                for (const pugi::xml_node& block : data.children("WavelengthDataBlock"))
                    read_matrix(block);
        std::size_t values = 0;
        for (const KlemsMatrix& m : matrices_) {
            values += m.value.size();
            if (!m.value.empty() && info_.parameterisation.empty())
                info_.parameterisation =
                    fmt::format("patches: {} ({} x {})", m.in.name, m.out.size(), m.in.size());
        }
        if (values == 0) source_.fail("has no WavelengthDataBlock: it holds no BSDF");
    }

    void read_matrix(const pugi::xml_node& block) {
        constexpr std::string_view directions[] = {"Transmission Front", "Transmission Back",
                                                   "Reflection Front", "Reflection Back"};
        const std::string direction = text_of(block, "WavelengthDataDirection");
        const int d = find_name(direction, directions);
        if (d < 0)
            source_.fail(line_of(block),
                         fmt::format("WavelengthDataDirection '{}' is not known; known are "
                                     "Transmission and Reflection, each Front and Back",
                                     direction.substr(0, 40)));
        KlemsMatrix& m = matrices_[std::size_t(d)];
        if (!m.value.empty())
            source_.fail(line_of(block), fmt::format("'{}' stands twice", direction));
        const KlemsBasis& columns = find_basis(block, "ColumnAngleBasis");
        const KlemsBasis& rows = find_basis(block, "RowAngleBasis");
        const pugi::xml_node data = block.child("ScatteringData");
        std::string text = data.text().get();
        for (char& c : text)
            if (c == ',') c = ' ';
        std::vector<double> values;
        take_numbers(source_, line_of(data), text, false, values);
        const std::size_t r = std::size_t(rows.size()), c = std::size_t(columns.size());
        if (values.size() != r * c)
            source_.fail(line_of(data),
                         fmt::format("'{}' has {} numbers, but {} x {} patches need {}", direction,
                                     values.size(), r, c, r * c));
        for (std::size_t i = 0; i < values.size(); ++i)
            if (std::isnan(values[i]))
                source_.fail(line_of(data), fmt::format("'{}': number {} of {} is not a number",
                                                        direction, i + 1, values.size()));
        if (rows_are_incident_) {
            m.in = rows;
            m.out = columns;
            m.value.resize(values.size());
            for (std::size_t i = 0; i < r; ++i)
                for (std::size_t o = 0; o < c; ++o) m.value[o * r + i] = values[i * c + o];
        } else {
            m.in = columns;
            m.out = rows;
            m.value = std::move(values);
        }
    }

    const MeasuredSource& source_;
    pugi::xml_document document_;
    MeasuredInfo info_;
    bool rows_are_incident_ = false;
    std::vector<KlemsBasis> bases_;
    std::array<KlemsMatrix, 4> matrices_;
};

}  // namespace

const MeasuredFormat& klems_format() {
    static const MeasuredFormat format{
        .name = "klems",
        .title = "Klems XML",
        .ending = ".xml",
        .summary =
            "BSDF matrices of WINDOW and Radiance, reflection and transmission of both sides",
        .memory = 24.,
        .recognise =
            [](const FileStart& start) {
                return start.head.find("<WindowElement") != start.head.npos;
            },
        .read = [](const MeasuredSource& source) { return Reader(source).read(); },
    };
    return format;
}

}  // namespace nacre

#include "write/vector/dxf_sink.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstddef>
#include <span>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <cpl_vsi.h>

#include "core/height_text.hpp"
#include "core/text.hpp"
#include "dem2buildings/error.hpp"
#include "read/gdal_messages.hpp"
#include "write/file_writer.hpp"
#include "write/staging.hpp"
#include "write/vector/layer_names.hpp"

namespace d2b::writing {

std::string drawing_layer_name(const std::string& name) {
    constexpr std::string_view allowed = "$-_";
    std::string result = name;
    for (char& letter : result)
        if (std::isalnum(static_cast<unsigned char>(letter)) == 0 ||
            static_cast<unsigned char>(letter) >= 0x80U)
            letter = allowed.find(letter) == std::string_view::npos ? '_' : letter;
    return result;
}

namespace {

// Group codes of DXF.
constexpr int kind_code = 0;
constexpr int text_code = 1;
constexpr int name_code = 2;
constexpr int layer_code = 8;
constexpr int variable_code = 9;
constexpr int size_code = 40;
constexpr int colour_code = 62;
constexpr int follow_code = 66;
constexpr int flag_code = 70;
constexpr int across_code = 72;
constexpr int upright_code = 73;
constexpr int comment_code = 999;

constexpr int closed_polyline = 1;
constexpr int polyline_3d = 8;
constexpr int vertex_3d = 32;

std::string group(int code, std::string_view value) {
    return std::to_string(code) + "\n" + std::string(value) + "\n";
}

std::string group(int code, int value) {
    return group(code, std::to_string(value));
}

/// Beginning of our drawings, so that no other one is replaced.
std::string signature() {
    return group(comment_code, "Made by dem2buildings");
}

/// Writes a real with a point, because some readers take a number without one for an integer.
std::string group(int code, double value) {
    std::string text = number_text(value);
    if (text.find_first_of(".e") == std::string::npos)
        text += ".0";
    return group(code, text);
}

/// @param first code of x; those of y and z are 10 and 20 larger
std::string place(int first, const Position& at, double z) {
    return group(first, at.x) + group(first + 10, at.y) + group(first + 20, z);
}

/// Stretch of a horizontal line inside a polygon.
struct Span {
    double left = 0;
    double right = 0;
    double y = 0;
    [[nodiscard]] double width() const { return right - left; }
};

void add_crossings(const WorldRing& ring, double y, std::vector<double>& crossings) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
        const Position& a = ring[i];
        const Position& b = ring[(i + 1) % ring.size()];
        if ((a.y <= y) != (b.y <= y))
            crossings.push_back(a.x + (y - a.y) / (b.y - a.y) * (b.x - a.x));
    }
}

/// Returns the widest of a few stretches, in whose middle a text stays inside the polygon.
Span widest_span(const WorldPolygon& polygon) {
    constexpr int lines = 7;
    const auto [low, high] = std::ranges::minmax(polygon.exterior, {}, &Position::y);
    Span widest;
    for (int i = 1; i <= lines; ++i) {
        const double y = low.y + (high.y - low.y) * i / (lines + 1);
        std::vector<double> crossings;
        add_crossings(polygon.exterior, y, crossings);
        for (const WorldRing& ring : polygon.interiors)
            add_crossings(ring, y, crossings);
        std::ranges::sort(crossings);
        for (std::size_t k = 0; k + 1 < crossings.size(); k += 2)
            if (const Span span{crossings[k], crossings[k + 1], y}; span.width() > widest.width())
                widest = span;
    }
    return widest;
}

Span widest_span(std::span<const WorldPolygon> parts) {
    Span widest;
    for (const WorldPolygon& part : parts)
        if (const Span span = widest_span(part); span.width() > widest.width())
            widest = span;
    return widest;
}

int colour_of(LayerRole role) {
    constexpr int red = 1;
    constexpr int yellow = 2;
    constexpr int blue = 5;
    constexpr int magenta = 6;
    constexpr int grey = 8;
    constexpr int orange = 30;
    switch (role) {
        case LayerRole::buildings:
            return red;
        case LayerRole::contours:
            return orange;
        case LayerRole::roofs:
            return blue;
        case LayerRole::doubtful:
            return yellow;
        case LayerRole::rejected:
            return grey;
        case LayerRole::problems:
        case LayerRole::missing:
            return magenta;
    }
    return red;
}

std::string text_layer(const std::string& layer) {
    return layer == "buildings" ? "heights" : layer + "_heights";
}

class DxfSink final : public FileSink<FeatureSink> {
  public:
    DxfSink(WriteOptions options, VectorFormat format, FileDestination destination)
        : options_(std::move(options)), format_(std::move(format)), file_(std::move(destination)) {}

    void begin(std::span<const LayerSpec> layers, const Provenance& provenance) override;
    void add(std::size_t index, const Feature& feature) override;
    void prepare(CommitList& commit) override {
        file_.write(group(kind_code, "ENDSEC") + group(kind_code, "EOF"));
        file_.prepare(commit);
    }
    [[nodiscard]] std::vector<std::string> take_warnings() override { return file_.take_warnings(); }
    [[nodiscard]] Layers layers(std::optional<Layers> asked) const override {
        return asked.value_or(Layers::both);
    }
    [[nodiscard]] std::string layer_name(LayerRole role, Layers layers) const override {
        return name_of(options_, format_, role, layers);
    }

  private:
    [[nodiscard]] int colour_of_layer(const std::string& name) const;
    void write_ring(const std::string& layer, const WorldRing& ring, std::span<const double> elevations);
    void write_height(const LayerSpec& layer, const Feature& feature, const BuildingRecord& record);

    WriteOptions options_;
    VectorFormat format_;
    FileWriter file_;
    std::vector<LayerSpec> layers_;
};

bool has_heights(const LayerSpec& layer) {
    return std::ranges::any_of(layer.fields, [](const FieldSpec& field) { return field.name == "p90"; });
}

int DxfSink::colour_of_layer(const std::string& name) const {
    for (const LayerRole role : {LayerRole::contours, LayerRole::roofs, LayerRole::doubtful,
                                 LayerRole::rejected, LayerRole::problems, LayerRole::missing})
        for (const Layers layers : {Layers::both, Layers::contours})
            if (name == layer_name(role, layers) && name != layer_name(LayerRole::buildings, Layers::both))
                return colour_of(role);
    return colour_of(LayerRole::buildings);
}

void DxfSink::begin(std::span<const LayerSpec> layers, const Provenance& provenance) {
    constexpr int white = 7;
    layers_.assign(layers.begin(), layers.end());
    std::string text = signature();
    for (const auto& [name, value] : provenance.metadata) {
        std::string line = name + ": " + value;
        std::ranges::replace_if(
            line, [](unsigned char letter) { return letter < ' '; }, ' ');
        text += group(comment_code, line);
    }
    text += group(kind_code, "SECTION") + group(name_code, "HEADER") + group(variable_code, "$ACADVER") +
            group(text_code, "AC1009") + group(kind_code, "ENDSEC");
    std::vector<std::pair<std::string, int>> drawn;
    for (const LayerSpec& layer : layers_) {
        drawn.emplace_back(layer.name, colour_of_layer(layer.name));
        if (has_heights(layer))
            drawn.emplace_back(text_layer(layer.name), white);
    }
    text += group(kind_code, "SECTION") + group(name_code, "TABLES") + group(kind_code, "TABLE") +
            group(name_code, "LAYER") + group(flag_code, static_cast<int>(drawn.size()));
    for (const auto& [name, colour] : drawn)
        text += group(kind_code, "LAYER") + group(name_code, name) + group(flag_code, 0) +
                group(colour_code, colour) + group(6, "CONTINUOUS");
    text += group(kind_code, "ENDTAB") + group(kind_code, "ENDSEC") + group(kind_code, "SECTION") +
            group(name_code, "ENTITIES");
    file_.write(text);
}

void DxfSink::write_ring(const std::string& layer, const WorldRing& ring,
                         std::span<const double> elevations) {
    const bool level = std::ranges::all_of(elevations, [&](double z) { return z == elevations.front(); });
    file_.write(group(kind_code, "POLYLINE") + group(layer_code, layer) + group(follow_code, 1) +
                place(10, {}, level ? elevations.front() : 0) +
                group(flag_code, closed_polyline + (level ? 0 : polyline_3d)));
    for (std::size_t i = 0; i < ring.size(); ++i)
        file_.write(group(kind_code, "VERTEX") + group(layer_code, layer) +
                    place(10, ring[i], elevations[i]) +
                    (level ? std::string() : group(flag_code, vertex_3d)));
    file_.write(group(kind_code, "SEQEND") + group(layer_code, layer));
}

void DxfSink::write_height(const LayerSpec& layer, const Feature& feature, const BuildingRecord& record) {
    constexpr double largest_m = 2;
    constexpr double narrowest = 3;  // times its height a text of four letters is wide
    constexpr int middle = 1;
    constexpr int middle_upright = 2;
    const double p90 = record.heights_m[p90_share];
    const Span span = widest_span(feature.parts);
    if (!std::isfinite(p90) || !(span.width() > 0))
        return;
    const double size = std::min(largest_m * layer.style.metre_scale, span.width() / narrowest);
    const Position at{(span.left + span.right) / 2, span.y};
    file_.write(group(kind_code, "TEXT") + group(layer_code, text_layer(layer.name)) +
                place(10, at, record.ground) + group(size_code, size) +
                group(text_code, height_range_text(record.heights_m[0], p90)) + group(across_code, middle) +
                place(11, at, record.ground) + group(upright_code, middle_upright));
}

void DxfSink::add(std::size_t index, const Feature& feature) {
    const LayerSpec& layer = layers_.at(index);
    if (feature.place) {
        file_.write(group(kind_code, "POINT") + group(layer_code, layer.name) + place(10, *feature.place, 0));
        return;
    }
    const auto* building = std::get_if<BuildingRecord>(&feature.record);
    const double level =
        building != nullptr && std::isfinite(building->ground) ? building->ground : feature.z;
    for (const WorldPolygon& part : feature.parts) {
        std::size_t corner = 0;
        const auto write = [&](const WorldRing& ring) {
            const std::vector<double> flat(ring.size(), level);
            const std::span<const double> own = part.elevations;
            write_ring(layer.name, ring, own.empty() ? flat : own.subspan(corner, ring.size()));
            corner += ring.size();
        };
        write(part.exterior);
        std::ranges::for_each(part.interiors, write);
    }
    if (building != nullptr)
        write_height(layer, feature, *building);
}

void refuse_options(const WriteOptions& options) {
    for (const auto& [name, given] :
         {std::pair{"-append", options.append}, std::pair{"-footprints", options.has_footprints()},
          std::pair{"-fields", options.fields != FieldNames::own},
          std::pair{"-lco", !options.layer_options.empty()},
          std::pair{"-dsco", !options.dataset_options.empty()}})
        if (given)
            throw OptionError(std::string(name) +
                              " cannot be used with a DXF, a drawing without fields that is written whole; "
                              "leave it out, or write a GeoPackage.");
}

/// True if a drawing begins as those of a run.
bool is_result(const std::string& path) {
    std::string beginning(signature().size(), '\0');
    VSILFILE* const file = VSIFOpenL(path.c_str(), "rb");
    if (file == nullptr)
        return false;
    beginning.resize(VSIFReadL(beginning.data(), 1, beginning.size(), file));
    VSIFCloseL(file);
    return beginning == signature();
}

}  // namespace

std::unique_ptr<FeatureSink> open_dxf_sink(const WriteOptions& options, const VectorFormat& format,
                                           const Destination& destination) {
    refuse_options(options);
    if (is_stream(options.destination))
        throw OptionError("A DXF cannot be written to \"" + destination.name + "\"; give a file.");
    FileDestination place{destination.name, destination.path, destination.local, {}};
    if (destination.exists) {
        const reading::GdalMessages quiet;
        if (open_dataset(format, destination.path, GDAL_OF_READONLY) == nullptr)
            throw OptionError("\"" + destination.name +
                              "\" exists and is not a DXF; choose another name, or remove it first.");
        if (!is_result(destination.path))
            throw OptionError("\"" + destination.name +
                              "\" is a drawing that dem2buildings has not written, and -overwrite would "
                              "lose it; choose another name, or remove it first.");
        place.old = {{destination.path}, stamp_of({destination.path})};
    }
    return std::make_unique<DxfSink>(options, format, std::move(place));
}

}  // namespace d2b::writing

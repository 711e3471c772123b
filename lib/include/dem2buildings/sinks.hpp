#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <variant>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/options.hpp"
#include "dem2buildings/records.hpp"
#include "dem2buildings/report.hpp"
#include "dem2buildings/world_polygon.hpp"

namespace d2b {

class CommitList;

enum class FieldType { integer, real, text };

/// Column of a layer. Names have at most 10 ASCII characters, because a Shapefile truncates longer ones.
struct FieldSpec {
    std::string name;
    std::string alias;  ///< readable name with the unit
    FieldType type = FieldType::real;
    std::string unit;  ///< "m", "m2", "ft", ...; "" if there is none
    std::string description;
};

/// Features that have the same text in a field.
struct StyleClass {
    std::string value;
    std::string colour;  ///< "red,green,blue,alpha", each from 0 to 255
};

/// Default style of a layer in a GIS. Fields are named as in the layer's spec. A layer without a title has no
/// style.
struct LayerStyle {
    std::string title{};   ///< title of the legend; "" for no style
    std::string colour{};  ///< field of heights in m that determines the colour; "" for a single colour
    std::string label{};   ///< field shown on large-scale maps; "" for none
    /// Labels only features in which these two fields are equal; "" for all.
    std::array<std::string, 2> labelled{};
    double label_scale = 2500;
    bool labels_on = true;    ///< false to offer labels, but not to show them
    std::string order{};      ///< field that determines the drawing order, low to high; "" for any order
    std::string certainty{};  ///< field from 0 to 1: features below `certain` are paler; "" for none
    double certain = 1;
    // Fields of slanted faces in degrees: the azimuth gives the hue, the slope the saturation. Flat faces
    // without an azimuth are light, those without a slope grey.
    // "" for other features.
    std::string slope{};
    std::string azimuth{};
    std::string classified{};  ///< field of texts that determines the colour; "" for other features
    std::vector<StyleClass> classes = {};  ///< in the order of the legend

    // Solid for 3D views. `height` is the height of its top above the ground and `min_height`, if set, that
    // of its bottom. The top is at elevation `top`; if that is empty, the bottom is at `bottom`; if both are,
    // there is no solid.
    std::string top{};
    std::string bottom{};
    std::string height{};
    std::string min_height{};
    double vertical_scale = 1;  ///< units of the map in one vertical unit
    double metre_scale = 1;     ///< units of the map in a metre
};

/// Definition of a layer of another dataset, whose features are written again as they are. Made by
/// open_footprints(); only sinks that open_sink() makes can read the features.
class OriginalLayer {
  public:
    OriginalLayer() = default;
    OriginalLayer(const OriginalLayer&) = delete;
    OriginalLayer& operator=(const OriginalLayer&) = delete;
    virtual ~OriginalLayer() = default;

    [[nodiscard]] virtual std::vector<std::string> field_names() const = 0;
};

struct LayerSpec {
    std::string name;
    std::string title;
    std::string description;
    std::vector<FieldSpec> fields;  ///< the first is the feature's number
    bool with_z = false;            ///< every vertex has Feature::z
    bool with_arcs = false;         ///< write circular arcs as curves if the format supports them
    LayerStyle style = {};
    bool points = false;  ///< features are points, otherwise polygons
    /// Features have the geometry, number and fields of this layer, and then those above; null for others.
    std::shared_ptr<const OriginalLayer> original = {};
};

/// Value of a field. std::monostate is NULL.
using FieldValue = std::variant<std::monostate, std::int64_t, double, std::string>;

struct Feature {
    std::vector<FieldValue> values;   ///< one per field, in the same order
    std::vector<WorldPolygon> parts;  ///< at least one; written as a MultiPolygon (with arcs a MultiSurface)
    double z = 0;
    FeatureRecord record = {};           ///< typed attributes
    std::optional<Position> place = {};  ///< position in a layer of points, instead of the parts
    /// Feature of LayerSpec::original, written instead of the parts; empty in other layers.
    std::vector<std::byte> original = {};
};

/// Rounding of coordinates by a destination.
struct CoordinateRounding {
    enum class To {
        nothing,             ///< keeps all digits
        decimals,            ///< fixed number of digits after the decimal point
        significant_digits,  ///< fixed number of significant digits
    };
    To to = To::nothing;
    int digits = 0;
    std::string cause = {};  ///< option to name in messages: "-lco COORDINATE_PRECISION=5"
};

/// Metadata of a dataset.
struct Provenance {
    std::string crs_wkt;                          ///< CRS of the written coordinates; "" for none
    std::map<std::string, std::string> metadata;  ///< source, options, thresholds, units, version
    /// Names of metadata that must be equal for appending features.
    std::vector<std::string> binding = {};
};

/// Returns the name of a layer if the user chooses none.
[[nodiscard]] inline std::string default_layer_name(LayerRole role) {
    return role == LayerRole::buildings  ? "buildings"
           : role == LayerRole::contours ? "contours"
           : role == LayerRole::roofs    ? "roofs"
           : role == LayerRole::doubtful ? "doubtful"
           : role == LayerRole::rejected ? "rejected"
           : role == LayerRole::missing  ? "missing"
                                         : "problems";
}

/// Receives features: a file (see open_sink()), or a list in a program or test.
///
/// Call order: optionally require_crs() and rehearse(); begin(); add() in the order of features in their
/// layers; prepare() or finish(). All calls come from the thread that called run(). A sink destroyed before
/// prepare() or finish() leaves the destination unchanged.
class FeatureSink {
  public:
    FeatureSink() = default;
    FeatureSink(const FeatureSink&) = delete;
    FeatureSink& operator=(const FeatureSink&) = delete;
    virtual ~FeatureSink() = default;

    /// Called before the work begins. @param wkt CRS of the coordinates to be written; "" for none @param
    /// name of the CRS in messages @param place one of the positions @throws OutputError if the destination
    /// cannot hold such coordinates
    virtual void require_crs(const std::string& /*wkt*/, const std::string& /*name*/,
                             const Position& /*place*/) {}
    /// Preflight check: tries to write such layers and removes them again. Called before the work begins.
    /// @param provenance as far as it is known @param place position of one of the features @throws
    /// OutputError, OptionError
    virtual void preflight(std::span<const LayerSpec> /*layers*/, const Provenance& /*provenance*/,
                           const Position& /*place*/) {}
    /// @throws OutputError
    virtual void begin(std::span<const LayerSpec> layers, const Provenance& provenance) = 0;
    /// @param layer index into the layers passed to begin() @throws OutputError
    virtual void add(std::size_t layer, const Feature& feature) = 0;
    /// Known after rehearse().
    [[nodiscard]] virtual CoordinateRounding rounding() const { return {}; }
    /// Receives the report of the run before prepare() or finish().
    virtual void take_report(const RunReport& /*report*/) {}
    /// Makes the result visible, all of it or nothing. @throws OutputError
    virtual void finish() = 0;
    /// Completes the result and adds it to `commit`. Called by run()
    /// instead of finish(), because all sinks are published together. A sink that publishes nothing, such as
    /// a list in memory, just finishes. @param commit publishes before this sink is destroyed @throws
    /// OutputError
    virtual void prepare(CommitList& /*commit*/) { finish(); }

    /// Returns the first free feature number, given the existing contents of the destination (append). Known
    /// after begin(), because nobody else adds to the destination from then on.
    [[nodiscard]] virtual std::int64_t first_id() const { return 1; }

    /// Returns the layers to write. @param asked nothing if the option was not given @throws OptionError if
    /// the destination cannot hold the requested layers
    [[nodiscard]] virtual Layers layers(std::optional<Layers> asked) const {
        return asked.value_or(Layers::both);
    }

    /// Returns true if the destination can also hold a layer of points.
    [[nodiscard]] virtual bool takes_points() const { return true; }

    /// Returns warnings since the last call, one sentence each.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }

    /// Returns the destination's name of a layer. @param layers that are written
    [[nodiscard]] virtual std::string layer_name(LayerRole role, Layers /*layers*/) const {
        return default_layer_name(role);
    }
};

/// Receives a raster on the DEM's window: a file (see open_auxiliary_sinks()), or an array in a program or
/// test.
///
/// Call order: write() for parts of the window, each cell once; prepare() or finish(). All calls come from
/// the thread that called run(). Detection results come unit by unit, a few rows at a time; elevations
/// (Sinks::elevations) come in whole rows from first to last. A sink destroyed before prepare() or finish()
/// leaves the destination unchanged.
class RasterSink {
  public:
    RasterSink() = default;
    RasterSink(const RasterSink&) = delete;
    RasterSink& operator=(const RasterSink&) = delete;
    virtual ~RasterSink() = default;

    /// @param part rows and columns of the whole raster @param values part.rows * part.cols of them, row by
    /// row, NaN if there is none @throws OutputError
    virtual void write(const Window& part, std::span<const float> values) = 0;
    /// Makes the raster visible, all of it or nothing. @throws OutputError
    virtual void finish() = 0;
    /// Same as FeatureSink::prepare().
    virtual void prepare(CommitList& /*commit*/) { finish(); }

    /// Returns warnings since the last call, one sentence each.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
};

}  // namespace d2b

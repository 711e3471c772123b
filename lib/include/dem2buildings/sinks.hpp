#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
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

/// One column of a layer. Names have at most 10 ASCII characters, so that a Shapefile keeps them.
struct FieldSpec {
    std::string name;
    std::string alias;  ///< for people, with the unit
    FieldType type = FieldType::real;
    std::string unit;  ///< "m", "m2", "ft", ...; "" where there is none
    std::string description;
};

/// How a GIS shows a layer by default; fields by their names in the layer's spec. Without a title a layer has
/// no style.
struct LayerStyle {
    std::string title{};   ///< of the legend: what the colours say; "" for no style
    std::string colour{};  ///< field of heights in m that gives the colour; "" for one look for all
    std::string label{};   ///< field that is written on large maps; "" for none
    /// Only features are labelled in which these two fields are equal; "" for all.
    std::array<std::string, 2> labelled{};
    double label_scale = 2500;
    std::string order{};      ///< field by which features are drawn, low to high; "" for any order
    std::string certainty{};  ///< field from 0 to 1: what is below `certain` is drawn paler; "" for none
    double certain = 1;

    // The solid, for 3D, is `height` metres above the ground. Where `min_height` is named it begins that high
    // above the ground. It ends at elevation `top`, or else stands at elevation `bottom`; with neither there
    // is none.
    std::string top{};
    std::string bottom{};
    std::string height{};
    std::string min_height{};
    double vertical_scale = 1;  ///< units of the map in one vertical unit
    double metre_scale = 1;     ///< units of the map in a metre
};

struct LayerSpec {
    std::string name;
    std::string title;
    std::string description;
    std::vector<FieldSpec> fields;  ///< the first is the number of a feature
    bool with_z = false;            ///< every vertex carries Feature::z
    bool with_arcs =
        false;  ///< runs of vertices that stand for arcs are written as such where the format has curves
    LayerStyle style = {};
    bool points = false;  ///< features are places, else polygons
};

/// std::monostate is NULL.
using FieldValue = std::variant<std::monostate, std::int64_t, double, std::string>;

struct Feature {
    std::vector<FieldValue> values;   ///< one a field, in their order
    std::vector<WorldPolygon> parts;  ///< at least one; written as a MultiPolygon (with arcs a MultiSurface)
    double z = 0;
    FeatureRecord record = {};           ///< what it is
    std::optional<Position> place = {};  ///< of a layer of points, in place of the parts
};

/// How a destination rounds the coordinates that it gets.
struct CoordinateRounding {
    enum class To {
        nothing,             ///< every coordinate is kept as it is
        decimals,            ///< a number of digits behind the point
        significant_digits,  ///< a number of digits from the first that is not 0
    };
    To to = To::nothing;
    int digits = 0;
    std::string cause = {};  ///< what messages name: "-lco COORDINATE_PRECISION=5"
};

/// What a dataset says of itself.
struct Provenance {
    std::string crs_wkt;                          ///< of the coordinates that are written; "" for none
    std::map<std::string, std::string> metadata;  ///< source, options, thresholds, units, version
    /// Names of metadata that must be equal where features are appended.
    std::vector<std::string> binding = {};
};

/// Where features go: a file (write/), or a list in tests and in other programs.
/// May be asked whether it takes a CRS; then begin, then add in the order in which features are to stand in
/// their layers, then prepare or finish; all of it from the thread that called run(). A sink that is
/// destroyed before that leaves the destination as it was.
class FeatureSink {
  public:
    FeatureSink() = default;
    FeatureSink(const FeatureSink&) = delete;
    FeatureSink& operator=(const FeatureSink&) = delete;
    virtual ~FeatureSink() = default;

    /// Asked before the work begins. @param wkt of the coordinates that will be written; "" for none @param
    /// name what messages call it @param place a position among them
    /// @throws OutputError where the destination cannot hold such coordinates
    virtual void require_crs(const std::string& /*wkt*/, const std::string& /*name*/,
                             const Position& /*place*/) {}
    /// Tries, before the work, whether such layers can be written; nothing is left of the trial.
    /// @param provenance as far as it is known @param place a position among the features
    /// @throws OutputError, OptionError
    virtual void rehearse(std::span<const LayerSpec> /*layers*/, const Provenance& /*provenance*/,
                          const Position& /*place*/) {}
    /// @throws OutputError
    virtual void begin(std::span<const LayerSpec> layers, const Provenance& provenance) = 0;
    /// @param layer index into the layers that begin() got @throws OutputError
    virtual void add(std::size_t layer, const Feature& feature) = 0;
    /// Known once rehearse() has been called.
    [[nodiscard]] virtual CoordinateRounding rounding() const { return {}; }
    /// Told before prepare() or finish() what the run has done.
    virtual void take_report(const RunReport& /*report*/) {}
    /// Makes the result visible, all of it or nothing. @throws OutputError
    virtual void finish() = 0;
    /// Called by run() in place of finish(): completes the result and leaves it to `commit` to show it when
    /// all sinks are as far. A sink that shows nothing to others, such as a list in memory, just finishes.
    /// @param commit shows its results before this sink is destroyed @throws OutputError
    virtual void prepare(CommitList& /*commit*/) { finish(); }

    /// The first number that a feature may take, given what the destination already holds (append). Known
    /// once begin() has been called: nobody else adds to the destination from then on.
    [[nodiscard]] virtual std::int64_t first_id() const { return 1; }

    /// The layers that the destination gets. @param asked nothing where that is left open
    /// @throws OptionError where it cannot hold what is asked for
    [[nodiscard]] virtual Layers layers(std::optional<Layers> asked) const {
        return asked.value_or(Layers::both);
    }

    /// Whether there is room for a layer of points beside the others.
    [[nodiscard]] virtual bool takes_points() const { return true; }

    /// What it has noticed since the last call, a sentence each, for the run to warn of.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }

    /// What the destination calls a layer. @param layers what is written
    [[nodiscard]] virtual std::string layer_name(LayerRole role, Layers /*layers*/) const {
        return role == LayerRole::buildings  ? "buildings"
               : role == LayerRole::contours ? "contours"
               : role == LayerRole::doubtful ? "doubtful"
               : role == LayerRole::rejected ? "rejected"
                                             : "problems";
    }
};

/// Where a raster goes that lies on the DEM's window: a file (write/), or an array in tests and in other
/// programs. Parts of the window, each cell in one of them, then prepare or finish, from the thread that
/// called run(). What is found comes unit by unit, a few rows at a time; elevations (Sinks::elevations) come
/// in whole rows from the first to the last. A sink that is destroyed before that leaves the destination as
/// it was.
class RasterSink {
  public:
    RasterSink() = default;
    RasterSink(const RasterSink&) = delete;
    RasterSink& operator=(const RasterSink&) = delete;
    virtual ~RasterSink() = default;

    /// @param part rows and columns of the whole raster @param values part.rows * part.cols of them, row by
    /// row, NaN where there is none @throws OutputError
    virtual void write(const Window& part, std::span<const float> values) = 0;
    /// Makes the raster visible, all of it or nothing. @throws OutputError
    virtual void finish() = 0;
    /// As FeatureSink::prepare().
    virtual void prepare(CommitList& /*commit*/) { finish(); }

    /// What it has noticed since the last call, a sentence each, for the run to warn of.
    [[nodiscard]] virtual std::vector<std::string> take_warnings() { return {}; }
};

}  // namespace d2b

#include "view/page/page_sink.hpp"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <filesystem>
#include <set>
#include <utility>
#include <variant>

#include <nlohmann/json.hpp>

#include "core/crs.hpp"
#include "core/height_classes.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/report.hpp"
#include "view/page_parts.hpp"
#include "write/staging.hpp"
#include "write/surface/surface_text.hpp"
#include "write/xml_text.hpp"
#include "write/zlib.hpp"

namespace d2b::view {

void VarintBuffer::put(std::uint64_t number) {
    for (; number >= 0x80; number >>= 7U)
        bytes_ += static_cast<char>((number & 0x7FU) | 0x80U);
    bytes_ += static_cast<char>(number);
}

void VarintBuffer::put_zigzag(std::int64_t number) {
    const auto bits = static_cast<std::uint64_t>(number);
    put(number < 0 ? ~(bits << 1U) : bits << 1U);
}

std::string base64(std::string_view bytes) {
    constexpr std::string_view letters = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        std::uint32_t three = 0;
        for (std::size_t k = i; k < i + 3; ++k)
            three = three << 8U | (k < bytes.size() ? static_cast<unsigned char>(bytes[k]) : 0U);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k > bytes.size() ? '=' : letters[three >> (18 - 6 * k) & 0x3FU];
    }
    return text;
}

std::string hex_decoded(std::string_view digits) {
    std::string bytes;
    for (std::size_t i = 0; i + 1 < digits.size(); i += 2) {
        unsigned byte = 0;
        std::from_chars(digits.data() + i, digits.data() + i + 2, byte, 16);
        bytes += static_cast<char>(byte);
    }
    return bytes;
}

namespace {

/// Limit that a browser without a graphics card can render, with twice as many triangles, in a fraction of a
/// second.
constexpr std::int32_t max_samples_per_side = 400;

std::int32_t samples(std::int32_t cells, std::int32_t step) {
    return (cells + step - 1) / step;
}

using Json = nlohmann::ordered_json;

/// Rounds to thousandths, because the numbers are only displayed.
Json value_json(const FieldValue& value) {
    constexpr double digits = 1000;
    if (const auto* whole = std::get_if<std::int64_t>(&value))
        return *whole;
    if (const auto* real = std::get_if<double>(&value))
        return std::isfinite(*real) ? Json(std::round(*real * digits) / digits) : Json();
    if (const auto* text = std::get_if<std::string>(&value))
        return *text;
    return {};
}

Json style_json(const LayerStyle& style) {
    Json classes = Json::array();
    for (const StyleClass& one : style.classes) {
        const Json parts = Json::parse("[" + one.colour + "]");
        classes.push_back({{"value", one.value}, {"colour", {parts[0], parts[1], parts[2]}}});
    }
    return {{"title", style.title},     {"colour", style.colour},         {"certainty", style.certainty},
            {"certain", style.certain}, {"classified", style.classified}, {"classes", std::move(classes)}};
}

/// Returns the height classes of the QGIS styles.
Json classes_json() {
    Json classes = Json::array();
    for (std::size_t i = 0; i < height_classes().size(); ++i)
        classes.push_back({{"from", height_classes()[i].from},
                           {"colour", height_classes()[i].colour},
                           {"label", class_label(i)}});
    return classes;
}

/// Appends the length and the bytes.
void append_section(const std::string& bytes, std::string& to) {
    for (unsigned shift = 0; shift < 32; shift += 8)
        to += static_cast<char>(bytes.size() >> shift & 0xFFU);
    to += bytes;
}

/// Substitutes placeholders. @param names replaced if the text contains @NAME@; replacements are not scanned
/// again
std::string substituted(std::string_view text,
                        const std::vector<std::pair<std::string, std::string>>& names) {
    std::string result;
    while (!text.empty()) {
        const std::size_t at = text.find('@');
        result += text.substr(0, at);
        if (at == std::string_view::npos)
            break;
        text.remove_prefix(at);
        bool found = false;
        for (const auto& [name, value] : names)
            if (text.starts_with("@" + name + "@")) {
                result += value;
                text.remove_prefix(name.size() + 2);
                found = true;
                break;
            }
        if (!found) {
            result += '@';
            text.remove_prefix(1);
        }
    }
    return result;
}

class PageSink final : public writing::FileSink<SurfaceSink> {
  public:
    PageSink(writing::FileDestination place, const PageParts& parts, const PageInput& input,
             std::shared_ptr<const PageRelief> relief, std::uint64_t most)
        : parts_(parts),
          window_(input.dem.window),
          title_(input.title.empty() ? std::filesystem::path(place.name).stem().string() : input.title),
          credit_(input.credit),
          date_(input.dem.date),
          relief_(std::move(relief)),
          most_(most),
          file_(std::move(place)) {}

    [[nodiscard]] SurfaceForm form() const override { return SurfaceForm::tiers; }
    void begin(const SurfaceMeta& meta) override;
    void add(const SurfacePart& part) override;
    void take_report(const RunReport& report) override;
    void prepare(CommitList& commit) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return file_.take_warnings(); }

  private:
    [[nodiscard]] Json about() const;
    [[nodiscard]] Json frame() const;
    [[nodiscard]] Json position() const;
    [[nodiscard]] Json fields() const;
    [[nodiscard]] std::string data() const;
    void check_size(std::uint64_t bytes) const;

    const PageParts& parts_;
    Window window_;
    std::string title_;
    std::string credit_;
    std::string date_;  ///< of the elevations
    std::shared_ptr<const PageRelief> relief_;
    std::uint64_t most_;
    writing::FileWriter file_;
    SurfaceMeta meta_;
    PageStack stack_;
    std::vector<Json> columns_;  ///< one per field, with one value per building
    std::vector<CutStack> cuts_;
};

void PageSink::begin(const SurfaceMeta& meta) {
    meta_ = meta;
    columns_.assign(meta.fields.size(), Json::array());
}

void PageSink::add(const SurfacePart& part) {
    for (const SurfaceBuilding& building : part.buildings) {
        stack_.add(building, part.points);
        for (std::size_t i = 0; i < columns_.size(); ++i)
            columns_[i].push_back(value_json(building.values[i]));
    }
    // Deflating leaves no less than a quarter.
    check_size(stack_.packed().bytes().size() / 4);
}

void PageSink::take_report(const RunReport& report) {
    cuts_ = report.cuts;
}

void PageSink::check_size(std::uint64_t bytes) const {
    if (bytes > most_)
        throw OutputError("\"" + file_.name() + "\" would be longer than " + std::to_string(most_ >> 20U) +
                          " MiB, which makes browsers slow; use a smaller window (-te, -projwin or -srcwin), "
                          "or fewer levels (a lower -lod).");
}

/// Returns the scale and offset that convert steps to metres.
Json PageSink::frame() const {
    const SurfaceFrame& frame = meta_.frame;
    const std::array<double, 3> offset = frame.local({0, 0, 0});
    Json corners = Json::array();
    for (const Position& corner : meta_.corners)
        corners.push_back({corner.x * frame.horizontal_metres - frame.origin[0],
                           corner.y * frame.horizontal_metres - frame.origin[1]});
    return {{"scale",
             {frame.scale[0] * frame.horizontal_metres, frame.scale[1] * frame.horizontal_metres,
              frame.scale[2] * frame.vertical_metres}},
            {"offset", offset},
            {"origin", frame.origin},
            {"corners", std::move(corners)},
            {"relief",
             {{"rows", relief_->rows()},
              {"cols", relief_->cols()},
              {"down", static_cast<double>(relief_->step()) / window_.rows},
              {"across", static_cast<double>(relief_->step()) / window_.cols}}}};
}

/// Returns latitude and longitude of the middle, for the position of the sun; null if the CRS is unknown.
Json PageSink::position() const {
    const Crs crs(meta_.provenance.crs_wkt);
    if (crs.kind() != Crs::Kind::projected)
        return {};
    std::array<Position, 1> middle{};
    for (const Position& corner : meta_.corners) {
        middle[0].x += corner.x / static_cast<double>(meta_.corners.size());
        middle[0].y += corner.y / static_cast<double>(meta_.corners.size());
    }
    try {
        CoordinateTransform(crs, Crs("EPSG:4326"), middle).apply(middle);
    } catch (const Error&) {
        return {};
    }
    return {std::round(middle[0].y * 100) / 100, std::round(middle[0].x * 100) / 100};
}

Json PageSink::fields() const {
    Json fields = Json::array();
    for (std::size_t i = 0; i < columns_.size(); ++i)
        fields.push_back({{"name", meta_.fields[i].name},
                          {"alias", meta_.fields[i].alias},
                          {"description", meta_.fields[i].description},
                          {"values", columns_[i]}});
    return fields;
}

Json PageSink::about() const {
    constexpr UncertaintyOverlay veil;
    Json levels = Json::array();
    const std::vector<PageStack::Count> counts = stack_.counts();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        Json level{{"contours", counts[i].contours}, {"corners", counts[i].corners}};
        level["rmse"] = i < cuts_.size() ? Json(cuts_[i].rmse_m) : Json();
        levels.push_back(std::move(level));
    }
    Json about{{"title", title_},
               {"credit", credit_},
               {"date", date_},
               {"crs", meta_.provenance.crs_wkt.empty() ? "" : Crs(meta_.provenance.crs_wkt).name()},
               {"buildings", stack_.buildings()},
               {"frame", frame()},
               {"position", position()},
               {"levels", std::move(levels)},
               {"roofs", {{"faces", stack_.faces().contours}, {"corners", stack_.faces().corners}}},
               {"classes", classes_json()},
               {"veil", {{"low", veil.low}, {"most", veil.most / 255}, {"least", veil.least / 255}}},
               {"blockStyle", style_json(meta_.block_style)},
               {"tierStyle", style_json(meta_.tier_style)},
               {"first", meta_.first_fields},
               {"alternatives", meta_.alternatives},
               {"fields", fields()}};
    for (const auto& [name, value] : meta_.provenance.metadata)
        about["metadata"][name] = value;
    return about;
}

std::string PageSink::data() const {
    std::string sections;
    append_section(writing::json_text(about()), sections);
    append_section(stack_.packed().bytes(), sections);
    append_section(relief_->packed().bytes(), sections);
    return base64(writing::zlib_compressed(sections));
}

void PageSink::prepare(CommitList& commit) {
    const std::string packed = data();
    check_size(packed.size() + parts_.html.size() + parts_.style.size() + parts_.script.size());
    const auto hash = [](std::string_view digits) { return "'sha256-" + base64(hex_decoded(digits)) + "'"; };
    file_.write(writing::page_signature);
    file_.write(substituted(parts_.html, {{"TITLE", writing::xml_text(title_)},
                                          {"SCRIPT_HASH", hash(parts_.script_sha256)},
                                          {"STYLE_HASH", hash(parts_.style_sha256)},
                                          {"STYLE", std::string(parts_.style)},
                                          {"LICENCE", writing::xml_text(parts_.licence)},
                                          {"DATA", packed},
                                          {"SCRIPT", std::string(parts_.script)}}));
    file_.prepare(commit);
}

}  // namespace

PageRelief::PageRelief(const Window& window, bool lowest)
    : window_(window),
      lowest_(lowest),
      step_(std::max(1, samples(std::max(window.rows, window.cols), max_samples_per_side))),
      rows_(samples(window.rows, step_)),
      cols_(samples(window.cols, step_)),
      values_(static_cast<std::size_t>(rows_) * static_cast<std::size_t>(cols_)),
      counts_(values_.size()) {}

void PageRelief::write(const Window& part, std::span<const float> values) {
    for (std::size_t i = 0; i < values.size(); ++i) {
        const auto at = static_cast<std::int32_t>(i);
        const std::int32_t row = (part.row - window_.row + at / part.cols) / step_;
        const std::int32_t col = (part.col - window_.col + at % part.cols) / step_;
        const auto sample =
            static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) + static_cast<std::size_t>(col);
        const auto value = static_cast<double>(values[i]);
        if (std::isnan(value))
            continue;
        if (!lowest_)
            values_[sample] += value;
        else if (counts_[sample] == 0 || value < values_[sample])
            values_[sample] = value;
        ++counts_[sample];
    }
}

std::optional<std::int64_t> PageRelief::centimetres(std::size_t sample) const {
    if (counts_[sample] == 0)
        return std::nullopt;
    return std::llround(100 * (lowest_ ? values_[sample] : values_[sample] / counts_[sample]));
}

VarintBuffer PageRelief::packed() const {
    VarintBuffer numbers;
    std::int64_t above = 0;
    for (std::int32_t row = 0; row < rows_; ++row) {
        std::int64_t before = above;
        for (std::int32_t col = 0; col < cols_; ++col) {
            const auto sample = static_cast<std::size_t>(row) * static_cast<std::size_t>(cols_) +
                                static_cast<std::size_t>(col);
            const auto height = centimetres(sample);
            if (!height) {
                numbers.put(0);
                continue;
            }
            const std::int64_t rise = *height - before;
            numbers.put((rise < 0 ? ~(static_cast<std::uint64_t>(rise) << 1U)
                                  : static_cast<std::uint64_t>(rise) << 1U) +
                        1);
            before = *height;
            if (col == 0)
                above = before;
        }
    }
    return numbers;
}

void PageStack::add(const SurfaceBuilding& building, const std::vector<SurfacePoint>& points) {
    ++buildings_;
    numbers_.put_zigzag(building.id - id_);
    numbers_.put_zigzag(building.base - base_);
    numbers_.put_zigzag(building.roof - building.base);
    numbers_.put(building.tiers.size());
    id_ = building.id;
    base_ = building.base;
    for (std::size_t i = 0; i < building.tiers.size(); ++i) {
        const SurfaceTier& tier = building.tiers[i];
        const bool stands_on_ground = tier.parent < 0;
        const auto parent = stands_on_ground ? i : static_cast<std::size_t>(tier.parent);
        numbers_.put(static_cast<std::uint64_t>(tier.level));
        numbers_.put(i - parent);
        numbers_.put_zigzag(tier.top - (stands_on_ground ? building.base : building.tiers[parent].top));
        numbers_.put(tier.rings.size());
        const auto level = static_cast<std::size_t>(tier.level);
        of_level_.resize(std::max(of_level_.size(), level));
        ++of_level_[level - 1].contours;
        for (const std::vector<SurfacePoint>& ring : tier.rings) {
            add_ring(ring);
            of_level_[level - 1].corners += static_cast<std::int64_t>(ring.size());
        }
    }
    numbers_.put(building.faces.size());
    corner_.z = building.base;
    std::set<std::int32_t> planes;  // twisted ones are divided into triangles
    for (const SurfaceFace& face : building.faces) {
        if (face.roof < 0 || planes.insert(face.roof).second)
            ++faces_.contours;
        add_face(face, points);
    }
}

void PageStack::add_face(const SurfaceFace& face, const std::vector<SurfacePoint>& points) {
    numbers_.put(1 + face.interiors.size());
    const auto add = [&](const std::vector<std::uint32_t>& ring) {
        numbers_.put(ring.size());
        faces_.corners += static_cast<std::int64_t>(ring.size());
        for (const std::uint32_t point : ring) {
            numbers_.put_zigzag(points[point].x - corner_.x);
            numbers_.put_zigzag(points[point].y - corner_.y);
            numbers_.put_zigzag(points[point].z - corner_.z);
            corner_ = points[point];
        }
    };
    add(face.exterior);
    for (const std::vector<std::uint32_t>& interior : face.interiors)
        add(interior);
}

void PageStack::add_ring(const std::vector<SurfacePoint>& ring) {
    numbers_.put(ring.size());
    for (const SurfacePoint& point : ring) {
        numbers_.put_zigzag(point.x - corner_.x);
        numbers_.put_zigzag(point.y - corner_.y);
        corner_ = point;
    }
}

std::vector<PageStack::Count> PageStack::counts() const {
    std::vector<Count> sums = of_level_;
    for (std::size_t i = 1; i < sums.size(); ++i) {
        sums[i].contours += sums[i - 1].contours;
        sums[i].corners += sums[i - 1].corners;
    }
    return sums;
}

Page open_page(writing::FileDestination place, const PageInput& subject, std::uint64_t most) {
    const PageParts* parts = page_parts();
    if (parts == nullptr)
        throw OptionError(
            "This dem2buildings was built without pages; leave -page out, or build it with "
            "-D D2B_BUILD_PAGE=ON.");
    auto relief = std::make_shared<PageRelief>(subject.dem.window, !subject.terrain);
    return {std::make_unique<PageSink>(std::move(place), *parts, subject, relief, most), relief};
}

}  // namespace d2b::view

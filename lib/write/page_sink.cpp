#include "write/page_sink.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <variant>
#include <vector>

#include <nlohmann/json.hpp>

#include "core/crs.hpp"
#include "core/height_classes.hpp"
#include "dem2buildings/error.hpp"
#include "dem2buildings/report.hpp"
#include "write/field_json.hpp"
#include "write/file_sink.hpp"
#include "write/packed_numbers.hpp"
#include "write/page_mark.hpp"
#include "write/page_parts.hpp"
#include "write/page_relief.hpp"
#include "write/page_stack.hpp"
#include "write/surface_file.hpp"
#include "write/xml_text.hpp"

namespace d2b {
namespace {

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
    return {{"title", style.title},
            {"colour", style.colour},
            {"certainty", style.certainty},
            {"certain", style.certain}};
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
std::string filled(std::string_view text, const std::vector<std::pair<std::string, std::string>>& names) {
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

class PageSink final : public FileSink<SurfaceSink> {
  public:
    PageSink(RasterPlace place, const PageParts& parts, const DemInfo& dem,
             std::shared_ptr<PageRelief> relief, std::uint64_t most)
        : name_(place.name),
          parts_(parts),
          window_(dem.window),
          title_(std::filesystem::path(place.name).stem().string()),
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
    [[nodiscard]] Json fields() const;
    [[nodiscard]] std::string data() const;
    void require_room(std::uint64_t bytes) const;

    std::string name_;
    const PageParts& parts_;
    Window window_;
    std::string title_;
    std::shared_ptr<PageRelief> relief_;
    std::uint64_t most_;
    SurfaceFile file_;
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
        stack_.add(building);
        for (std::size_t i = 0; i < columns_.size(); ++i)
            columns_[i].push_back(value_json(building.values[i]));
    }
    // Deflating leaves no less than a quarter.
    require_room(stack_.packed().bytes().size() / 4);
}

void PageSink::take_report(const RunReport& report) {
    cuts_ = report.cuts;
}

void PageSink::require_room(std::uint64_t bytes) const {
    if (bytes > most_)
        throw OutputError("\"" + name_ + "\" would be longer than " + std::to_string(most_ >> 20U) +
                          " MiB, with which browsers become slow; use a smaller window (-te, -projwin or "
                          "-srcwin), or fewer levels (a lower -lod).");
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
    constexpr Veil veil;
    Json levels = Json::array();
    const std::vector<PageStack::Count> counts = stack_.counts();
    for (std::size_t i = 0; i < counts.size(); ++i) {
        Json level{{"contours", counts[i].contours}, {"corners", counts[i].corners}};
        level["rmse"] = i < cuts_.size() ? Json(cuts_[i].rmse_m) : Json();
        levels.push_back(std::move(level));
    }
    Json about{{"title", title_},
               {"crs", meta_.provenance.crs_wkt.empty() ? "" : Crs(meta_.provenance.crs_wkt).name()},
               {"buildings", stack_.buildings()},
               {"frame", frame()},
               {"levels", std::move(levels)},
               {"classes", classes_json()},
               {"veil", {{"low", veil.low}, {"most", veil.most / 255}, {"least", veil.least / 255}}},
               {"blockStyle", style_json(meta_.block_style)},
               {"tierStyle", style_json(meta_.tier_style)},
               {"first", meta_.first_fields},
               {"fields", fields()}};
    for (const auto& [name, value] : meta_.provenance.metadata)
        about["metadata"][name] = value;
    return about;
}

std::string PageSink::data() const {
    std::string sections;
    append_section(json_text(about()), sections);
    append_section(stack_.packed().bytes(), sections);
    append_section(relief_->packed().bytes(), sections);
    return base64(deflated(sections));
}

void PageSink::prepare(CommitList& commit) {
    const std::string packed = data();
    require_room(packed.size() + parts_.html.size() + parts_.style.size() + parts_.script.size());
    const auto hash = [](std::string_view digits) { return "'sha256-" + base64(bytes_of_hex(digits)) + "'"; };
    file_.write(page_mark);
    file_.write(filled(parts_.html, {{"TITLE", xml_text(title_)},
                                     {"SCRIPT_HASH", hash(parts_.script_sha256)},
                                     {"STYLE_HASH", hash(parts_.style_sha256)},
                                     {"STYLE", std::string(parts_.style)},
                                     {"LICENCE", xml_text(parts_.licence)},
                                     {"DATA", packed},
                                     {"SCRIPT", std::string(parts_.script)}}));
    file_.prepare(commit);
}

}  // namespace

Page open_page(RasterPlace place, const PageSubject& subject, std::uint64_t most) {
    const PageParts* parts = page_parts();
    if (parts == nullptr)
        throw OptionError(
            "This dem2buildings was built without pages; leave -page out, or build it with "
            "-D D2B_BUILD_PAGE=ON.");
    auto relief = std::make_shared<PageRelief>(subject.dem.window, !subject.terrain);
    return {std::make_unique<PageSink>(std::move(place), *parts, subject.dem, relief, most),
            open_page_relief(relief)};
}

}  // namespace d2b

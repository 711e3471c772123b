#include "write/obj_sink.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>

#include "core/crs.hpp"
#include "write/coordinate_text.hpp"
#include "write/file_sink.hpp"
#include "write/surface_file.hpp"

namespace d2b {
namespace {

struct Group {
    FaceKind kind;
    const char* name;
};
constexpr std::array groups{Group{FaceKind::roof, "roof"}, Group{FaceKind::wall, "wall"},
                            Group{FaceKind::ground, "ground"}};

/// On one line, whatever is in it.
std::string comment(const std::string& text) {
    std::string line = "# ";
    for (const char c : text)
        line += c == '\n' || c == '\r' || c == '\\' ? ' ' : c;  // a backslash may go on on the next line
    return line + "\n";
}

class ObjSink final : public FileSink<SurfaceSink> {
  public:
    ObjSink(RasterPlace place, SurfaceSolids solids) : solids_(solids), file_(std::move(place)) {}

    [[nodiscard]] SurfaceForm form() const override { return SurfaceForm::shell; }
    void begin(const SurfaceMeta& meta) override;
    void add(const SurfacePart& part) override;
    void prepare(CommitList& commit) override { file_.prepare(commit); }
    [[nodiscard]] std::vector<std::string> take_warnings() override { return file_.take_warnings(); }

  private:
    void add_building(const SurfaceBuilding& building);

    SurfaceSolids solids_;
    SurfaceFile file_;
    std::optional<CoordinateText> text_;
    std::uint64_t before_ = 1;  ///< number of the next corner
    bool has_any_ = false;
};

void ObjSink::begin(const SurfaceMeta& meta) {
    text_.emplace(meta.frame);
    file_.write(comment("dem2buildings: metres from the origin, x to the east, y to the north, z up"));
    file_.write(comment("origin: " + origin_text(meta.frame)));
    if (!meta.provenance.crs_wkt.empty())
        file_.write(comment("crs: " + Crs(meta.provenance.crs_wkt).name()));
    for (const auto& [name, value] : meta.provenance.metadata)
        file_.write(comment(name + ": " + value));
}

void ObjSink::add(const SurfacePart& part) {
    std::string corners;
    for (const SurfacePoint& point : part.points)
        corners += "v " + (*text_)(point) + "\n";
    file_.write(corners);
    for (const SurfaceBuilding& building : part.buildings)
        add_building(building);
    before_ += part.points.size();
}

void ObjSink::add_building(const SurfaceBuilding& building) {
    std::string text;
    if (solids_ == SurfaceSolids::each)
        text = "o building_" + std::to_string(building.id) + "\n";
    else if (!has_any_)
        text = "o buildings\n";
    has_any_ = true;
    for (const Group& group : groups) {
        text += std::string("g ") + group.name + "\n";
        for (const SurfaceTriangle& triangle : building.triangles)
            if (triangle.kind == group.kind) {
                text += "f";
                for (const std::uint32_t corner : triangle.corners)
                    text += " " + std::to_string(before_ + corner);
                text += "\n";
            }
    }
    file_.write(text);
}

}  // namespace

std::unique_ptr<SurfaceSink> open_obj_sink(RasterPlace place, SurfaceSolids solids) {
    return std::make_unique<ObjSink>(std::move(place), solids);
}

}  // namespace d2b

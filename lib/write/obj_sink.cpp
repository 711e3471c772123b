#include "write/obj_sink.hpp"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "core/number_text.hpp"
#include "write/coordinate_text.hpp"
#include "write/face_looks.hpp"
#include "write/file_sink.hpp"
#include "write/surface_file.hpp"

namespace d2b {
namespace {

/// Returns a comment of one line, whatever the text contains.
std::string comment(const std::string& text) {
    std::string line = "# ";
    for (const char c : text)
        line += c == '\n' || c == '\r' || c == '\\' ? ' ' : c;  // a backslash would continue the line
    return line + "\n";
}

class ObjSink final : public FileSink<SurfaceSink> {
  public:
    ObjSink(RasterPlace place, RasterPlace materials, SurfaceSolids solids)
        : solids_(solids),
          library_(materials.name.substr(materials.name.find_last_of('/') + 1)),
          file_(std::move(place)),
          materials_(std::move(materials)) {}

    [[nodiscard]] SurfaceForm form() const override { return SurfaceForm::shell; }
    void begin(const SurfaceMeta& meta) override;
    void add(const SurfacePart& part) override;
    void prepare(CommitList& commit) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override;

  private:
    void add_building(const SurfaceBuilding& building);

    SurfaceSolids solids_;
    std::string library_;  ///< file name of the materials, without folder
    SurfaceFile file_;
    SurfaceFile materials_;
    std::optional<CoordinateText> text_;
    std::uint64_t before_ = 1;  ///< number of the next vertex
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
    file_.write("mtllib " + library_ + "\n");
    materials_.write(comment("dem2buildings"));
    for (const FaceLook& look : face_looks) {
        std::string colour;
        for (const double part : look.colour)
            colour += " " + number_text(part);
        materials_.write("newmtl " + std::string(look.name) + "\nKd" + colour + "\nillum 1\n");
    }
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
    for (std::size_t kind = 0; kind < face_looks.size(); ++kind) {
        const std::string name = face_looks[kind].name;
        text += "g " + name + "\nusemtl " + name + "\n";
        for (const SurfaceTriangle& triangle : building.triangles)
            if (triangle.kind == static_cast<FaceKind>(kind)) {
                text += "f";
                for (const std::uint32_t corner : triangle.corners)
                    text += " " + std::to_string(before_ + corner);
                text += "\n";
            }
    }
    file_.write(text);
}

void ObjSink::prepare(CommitList& commit) {
    materials_.prepare(commit);
    file_.prepare(commit);
}

std::vector<std::string> ObjSink::take_warnings() {
    std::vector<std::string> warnings = file_.take_warnings();
    const std::vector<std::string> more = materials_.take_warnings();
    warnings.insert(warnings.end(), more.begin(), more.end());
    return warnings;
}

}  // namespace

std::unique_ptr<SurfaceSink> open_obj_sink(RasterPlace place, RasterPlace materials, SurfaceSolids solids) {
    return std::make_unique<ObjSink>(std::move(place), std::move(materials), solids);
}

}  // namespace d2b

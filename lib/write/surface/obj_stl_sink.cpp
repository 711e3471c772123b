#include "write/surface/obj_stl_sink.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <utility>
#include <vector>

#include "core/crs.hpp"
#include "core/number_from_chars.hpp"
#include "core/text.hpp"
#include "write/staging.hpp"
#include "write/surface/surface_text.hpp"

namespace d2b::writing {
namespace {

constexpr int millimetres = 3;
constexpr int max_decimals = 12;

/// True if `decimals` decimals represent the step exactly.
bool is_exact_with(double step, int decimals) {
    const double units = step * std::pow(10, decimals);
    return units >= 1 && std::abs(units - std::round(units)) < 1e-9;
}

int decimals_of(const std::array<double, 2>& steps) {
    for (int decimals = 0; decimals <= max_decimals; ++decimals)
        if (is_exact_with(steps[0], decimals) && is_exact_with(steps[1], decimals))
            return decimals;
    constexpr double parts = 16;  // parts per step
    return std::clamp(static_cast<int>(std::ceil(-std::log10(std::min(steps[0], steps[1]) / parts))), 0,
                      max_decimals);
}

/// Rounds to a micrometre, because raster corners are not known more precisely.
double to_micrometre(double metres) {
    return std::round(metres * 1e6) / 1e6;
}

/// Returns a comment of one line, whatever the text contains.
std::string comment(const std::string& text) {
    std::string line = "# ";
    for (const char c : text)
        line += c == '\n' || c == '\r' || c == '\\' ? ' ' : c;  // a backslash would continue the line
    return line + "\n";
}

class ObjSink final : public FileSink<SurfaceSink> {
  public:
    ObjSink(FileDestination place, FileDestination materials, SurfaceSolids solids)
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
    FileWriter file_;
    FileWriter materials_;
    std::optional<LocalCoordinateFormatter> text_;
    std::uint64_t next_vertex_ = 1;  ///< number of the next vertex
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
    for (const FaceMaterial& look : face_materials) {
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
    next_vertex_ += part.points.size();
}

void ObjSink::add_building(const SurfaceBuilding& building) {
    std::string text;
    if (solids_ == SurfaceSolids::each)
        text = "o building_" + std::to_string(building.id) + "\n";
    else if (!has_any_)
        text = "o buildings\n";
    has_any_ = true;
    for (std::size_t kind = 0; kind < face_materials.size(); ++kind) {
        const std::string name = face_materials[kind].name;
        text += "g " + name + "\nusemtl " + name + "\n";
        for (const SurfaceTriangle& triangle : building.triangles)
            if (triangle.kind == static_cast<FaceKind>(kind)) {
                text += "f";
                for (const std::uint32_t corner : triangle.corners)
                    text += " " + std::to_string(next_vertex_ + corner);
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

using Vector = std::array<double, 3>;

Vector minus(const Vector& a, const Vector& b) {
    return {a[0] - b[0], a[1] - b[1], a[2] - b[2]};
}

/// Returns the unit normal on the side from which the vertices are counter-clockwise.
Vector normal(const Vector& a, const Vector& b, const Vector& c) {
    const Vector u = minus(b, a);
    const Vector v = minus(c, a);
    Vector n{u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0]};
    const double length = std::hypot(n[0], n[1], n[2]);
    for (double& part : n)
        part /= length;
    return n;
}

/// Parses three numbers in single precision, like readers of STL do.
Vector as_read(const std::string& text) {
    Vector numbers{};
    const char* at = text.data();
    for (double& number : numbers) {
        float read = 0;
        at = number_from_chars(at, text.data() + text.size(), read).ptr;
        number = static_cast<double>(read);
        at += at == text.data() + text.size() ? 0 : 1;  // skips a space
    }
    return numbers;
}

class StlSink final : public FileSink<SurfaceSink> {
  public:
    StlSink(FileDestination place, SurfaceSolids solids) : solids_(solids), file_(std::move(place)) {}

    [[nodiscard]] SurfaceForm form() const override { return SurfaceForm::shell; }
    void begin(const SurfaceMeta& meta) override {
        frame_ = meta.frame;
        text_.emplace(meta.frame);
    }
    void add(const SurfacePart& part) override;
    void prepare(CommitList& commit) override;
    [[nodiscard]] std::vector<std::string> take_warnings() override { return file_.take_warnings(); }

  private:
    void begin_solid(const std::string& name);
    void end_solid();
    [[nodiscard]] std::string facet(const SurfacePart& part, const SurfaceTriangle& triangle) const;

    SurfaceSolids solids_;
    FileWriter file_;
    SurfaceFrame frame_;
    std::optional<LocalCoordinateFormatter> text_;
    std::string solid_;  ///< name of the open solid
    bool has_any_ = false;
};

void StlSink::add(const SurfacePart& part) {
    for (const SurfaceBuilding& building : part.buildings) {
        if (solids_ == SurfaceSolids::each || !has_any_)
            begin_solid(solids_ == SurfaceSolids::one ? "buildings"
                                                      : "building_" + std::to_string(building.id));
        std::string text;
        for (const SurfaceTriangle& triangle : building.triangles)
            text += facet(part, triangle);
        file_.write(text);
    }
}

void StlSink::begin_solid(const std::string& name) {
    end_solid();
    file_.write("solid " + name + " origin " + origin_text(frame_) + "\n");
    solid_ = name;
    has_any_ = true;
}

void StlSink::end_solid() {
    if (has_any_)
        file_.write("endsolid " + solid_ + "\n");
}

std::string StlSink::facet(const SurfacePart& part, const SurfaceTriangle& triangle) const {
    constexpr int digits = 6;
    std::array<Vector, 3> at;
    std::string vertices;
    for (std::size_t i = 0; i < at.size(); ++i) {
        const std::string corner = (*text_)(part.points[triangle.corners[i]]);
        at[i] = as_read(corner);
        vertices += "vertex " + corner + "\n";
    }
    std::string text = "facet normal";
    for (const double part_of : normal(at[0], at[1], at[2]))
        text += " " + trimmed_decimal(part_of, digits);
    return text + "\nouter loop\n" + vertices + "endloop\nendfacet\n";
}

void StlSink::prepare(CommitList& commit) {
    if (!has_any_) {
        warn_of_no_building(file_, "an STL needs a solid");
        return;
    }
    end_solid();
    file_.prepare(commit);
}

}  // namespace

std::string trimmed_decimal(double value, int decimals) {
    std::string number = fixed_text(value, decimals);
    if (decimals > 0)
        number.erase(number.find_last_not_of('0') + 1);
    if (number.ends_with('.'))
        number.pop_back();
    return number == "-0" ? "0" : number;
}

LocalCoordinateFormatter::LocalCoordinateFormatter(const SurfaceFrame& frame)
    : frame_(frame),
      step_{frame.scale[0] * frame.horizontal_metres, frame.scale[1] * frame.horizontal_metres},
      shift_{to_micrometre(frame.translate[0] * frame.horizontal_metres - frame.origin[0]),
             to_micrometre(frame.translate[1] * frame.horizontal_metres - frame.origin[1])},
      decimals_(decimals_of(step_)) {}

std::string LocalCoordinateFormatter::operator()(const SurfacePoint& point) const {
    return trimmed_decimal(shift_[0] + static_cast<double>(point.x) * step_[0], decimals_) + " " +
           trimmed_decimal(shift_[1] + static_cast<double>(point.y) * step_[1], decimals_) + " " +
           trimmed_decimal(frame_.local(point)[2], millimetres);
}

std::string origin_text(const SurfaceFrame& frame) {
    std::string text;
    for (const double metres : frame.origin)
        text += (text.empty() ? "" : " ") + trimmed_decimal(metres, 0);
    return text;
}

std::unique_ptr<SurfaceSink> open_obj_sink(FileDestination place, FileDestination materials,
                                           SurfaceSolids solids) {
    return std::make_unique<ObjSink>(std::move(place), std::move(materials), solids);
}

std::unique_ptr<SurfaceSink> open_stl_sink(FileDestination place, SurfaceSolids solids) {
    return std::make_unique<StlSink>(std::move(place), solids);
}

}  // namespace d2b::writing

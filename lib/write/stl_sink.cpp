#include "write/stl_sink.hpp"

#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "core/number_from_chars.hpp"
#include "write/coordinate_text.hpp"
#include "write/file_sink.hpp"
#include "write/surface_file.hpp"

namespace d2b {
namespace {

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
    StlSink(RasterPlace place, SurfaceSolids solids) : solids_(solids), file_(std::move(place)) {}

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
    SurfaceFile file_;
    SurfaceFrame frame_;
    std::optional<CoordinateText> text_;
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
        text += " " + short_text(part_of, digits);
    return text + "\nouter loop\n" + vertices + "endloop\nendfacet\n";
}

void StlSink::prepare(CommitList& commit) {
    if (!has_any_) {
        file_.leave_out("an STL without a solid is none");
        return;
    }
    end_solid();
    file_.prepare(commit);
}

}  // namespace

std::unique_ptr<SurfaceSink> open_stl_sink(RasterPlace place, SurfaceSolids solids) {
    return std::make_unique<StlSink>(std::move(place), solids);
}

}  // namespace d2b

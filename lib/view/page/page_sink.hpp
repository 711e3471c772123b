#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "dem2buildings/dem_source.hpp"
#include "dem2buildings/sinks.hpp"
#include "dem2buildings/surfaces.hpp"
#include "write/file_target.hpp"

namespace d2b::view {

/// Variable-length integers (LEB128): seven bits per byte, low bits first; the eighth bit says that more
/// follow.
class VarintBuffer {
  public:
    void put(std::uint64_t number);
    /// ZigZag encoding: 0, -1, 1, -2, 2, ... become 0, 1, 2, 3, 4, ...
    void put_zigzag(std::int64_t number);

    [[nodiscard]] const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

/// Encodes as Base64 (RFC 4648).
[[nodiscard]] std::string base64(std::string_view bytes);
/// Decodes hexadecimal digits.
[[nodiscard]] std::string hex_decoded(std::string_view digits);

/// Ground of a page, in samples that are squares of cells: the mean of a terrain, or the minimum of
/// elevations that contain buildings.
class PageRelief final : public RasterSink {
  public:
    /// @param window of the DEM @param lowest true for the minimum per sample, false for the mean
    PageRelief(const Window& window, bool lowest);

    /// @param part of the window @param values in metres, NaN if missing
    void write(const Window& part, std::span<const float> values) override;
    void finish() override {}
    /// Returns centimetres, row by row, as differences to the previous sample, or to the one above at the
    /// begin of a row. 0 means no data, otherwise the zigzag-encoded difference plus one.
    [[nodiscard]] VarintBuffer packed() const;
    /// Samples per side.
    [[nodiscard]] std::int32_t rows() const { return rows_; }
    [[nodiscard]] std::int32_t cols() const { return cols_; }
    /// Cells per side of a sample.
    [[nodiscard]] std::int32_t step() const { return step_; }

  private:
    [[nodiscard]] std::optional<std::int64_t> centimetres(std::size_t sample) const;

    Window window_;
    bool lowest_;
    std::int32_t step_;
    std::int32_t rows_;
    std::int32_t cols_;
    std::vector<double> values_;  ///< sums or minima
    std::vector<std::int32_t> counts_;
};

/// Stacks of a page as packed integers. Per building: id, height of the base, height of the roof above it,
/// number of tiers; per tier: level, distance in the list to its parent (0 is the ground), height above it,
/// number of rings; per ring: number of vertices and their offsets to the east and north from the previous
/// vertex. Then, per building, the number of faces of its slanted roof; per face: number of rings as above,
/// but with heights as offsets as well, the first from the base. Ids and bases are differences to the
/// previous building.
class PageStack {
  public:
    /// @param points of the faces
    void add(const SurfaceBuilding& building, const std::vector<SurfacePoint>& points = {});

    /// Sums of a level and all below it.
    struct Count {
        std::int64_t contours = 0;
        std::int64_t corners = 0;
    };
    /// Starts with level 1.
    [[nodiscard]] std::vector<Count> counts() const;
    [[nodiscard]] const VarintBuffer& packed() const { return numbers_; }
    [[nodiscard]] std::int64_t buildings() const { return buildings_; }
    /// Faces of roofs, where the triangles of a divided one count once, and their vertices.
    [[nodiscard]] const Count& faces() const { return faces_; }

  private:
    void add_ring(const std::vector<SurfacePoint>& ring);
    void add_face(const SurfaceFace& face, const std::vector<SurfacePoint>& points);

    VarintBuffer numbers_;
    std::int64_t buildings_ = 0;
    std::int64_t id_ = 0;
    std::int64_t base_ = 0;
    SurfacePoint corner_;
    std::vector<Count> of_level_;
    Count faces_;
};

/// Sinks of a page: buildings and ground.
struct Page {
    std::unique_ptr<SurfaceSink> surface;
    std::shared_ptr<RasterSink> relief;  ///< shared with the surface, which writes the file
};

/// Input data of a page.
struct PageInput {
    const DemInfo& dem;
    bool terrain = true;  ///< true for a terrain, false for elevations that contain buildings
    std::string title{};  ///< "": the name of the file
    std::string credit{};
};

/// Writes one self-contained HTML file that shows the stack in a browser: page_parts() and the packed tiers
/// of all buildings. See docs/page.md. @param place of FileKind::page @param most largest file size in
/// bytes, because browsers become slow with more @throws OptionError if the library was built without pages
[[nodiscard]] Page open_page(writing::FileDestination place, const PageInput& subject,
                             std::uint64_t most = std::uint64_t{64} << 20);

}  // namespace d2b::view

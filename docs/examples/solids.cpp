// A sink of one's own: every tier of every building as a solid, in a file of CityJSON.
//   solids <dem> <destination.city.json>

#include <cstddef>
#include <cstdint>
#include <dem2buildings/dem2buildings.hpp>
#include <exception>
#include <fstream>
#include <iomanip>
#include <iostream>
#include <map>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace {

class Solids final : public d2b::FeatureSink {
  public:
    explicit Solids(const std::string& destination) : file_(destination) {
        file_ << std::setprecision(12) << R"({"type":"CityJSON","version":"1.1","CityObjects":{)";
    }

    void begin(std::span<const d2b::LayerSpec> /*layers*/, const d2b::Provenance& /*provenance*/) override {}

    /// A stack stands without gaps: where the part of one contour ends, those on it begin.
    void add(std::size_t /*layer*/, const d2b::Feature& feature) override {
        const auto* tier = std::get_if<d2b::ContourRecord>(&feature.record);
        if (tier == nullptr || tier->level == 0)  // level 0 is the terrain around all of them
            return;
        file_ << (solids_++ == 0 ? "" : ",") << "\n\"" << tier->id << R"(":{"type":"Building","attributes":{)"
              << R"("building":)" << tier->building_id << R"(,"level":)" << tier->level
              << R"(},"geometry":[)";
        for (std::size_t i = 0; i < feature.parts.size(); ++i) {
            file_ << (i == 0 ? "" : ",") << R"({"type":"Solid","lod":"1.3","boundaries":[[)";
            write_shell(feature.parts[i], tier->base, tier->top);
            file_ << "]]}";
        }
        file_ << "]}";
    }

    void finish() override {
        file_ << "\n},\"transform\":{\"scale\":[1,1,1],\"translate\":[0,0,0]},\"vertices\":[";
        for (std::size_t i = 0; i < vertices_.size(); ++i)
            file_ << (i == 0 ? "" : ",") << '[' << vertices_[i].x << ',' << vertices_[i].y << ','
                  << vertices_[i].z << ']';
        file_ << "]}\n";
        if (!file_.flush())
            throw d2b::OutputError("The solids cannot be written; is the disk full?");
    }

    [[nodiscard]] std::size_t solids() const { return solids_; }

  private:
    struct Vertex {
        double x;
        double y;
        double z;
    };

    /// The roof, the floor, whose rings run the other way round, and a wall an edge.
    void write_shell(const d2b::WorldPolygon& polygon, double base, double top) {
        std::vector<d2b::WorldRing> rings{polygon.exterior};
        rings.insert(rings.end(), polygon.interiors.begin(), polygon.interiors.end());
        write_face(rings, top);
        file_ << ',';
        for (d2b::WorldRing& ring : rings)
            ring = {ring.rbegin(), ring.rend()};
        write_face(rings, base);
        for (const d2b::WorldRing& ring : rings)
            for (std::size_t i = 0; i < ring.size(); ++i) {
                const d2b::Position& a = ring[i];
                const d2b::Position& b = ring[(i + 1) % ring.size()];
                file_ << ",[[" << add_vertex(b, base) << ',' << add_vertex(a, base) << ','
                      << add_vertex(a, top) << ',' << add_vertex(b, top) << "]]";
            }
    }

    void write_face(const std::vector<d2b::WorldRing>& rings, double z) {
        file_ << '[';
        for (std::size_t r = 0; r < rings.size(); ++r) {
            file_ << (r == 0 ? "[" : ",[");
            for (std::size_t i = 0; i < rings[r].size(); ++i)
                file_ << (i == 0 ? "" : ",") << add_vertex(rings[r][i], z);
            file_ << ']';
        }
        file_ << ']';
    }

    std::size_t add_vertex(const d2b::Position& position, double z) {
        vertices_.push_back({position.x, position.y, z});
        return vertices_.size() - 1;
    }

    std::ofstream file_;
    std::vector<Vertex> vertices_;
    std::size_t solids_ = 0;
};

}  // namespace

int main(int argc, char* argv[]) {
    if (argc != 3) {
        std::cerr << "usage: solids <dem> <destination.city.json>\n";
        return 2;
    }
    try {
        d2b::Options options;
        options.read.source = argv[1];
        options.write.layers = d2b::Layers::contours;
        const auto dem = d2b::open_dem(options.read);
        Solids solids(argv[2]);
        d2b::run(options, {*dem}, {solids});
        std::cout << solids.solids() << " tiers\n";
    } catch (const std::exception& error) {
        std::cerr << error.what() << '\n';
        return 1;
    }
}

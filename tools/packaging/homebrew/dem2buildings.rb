# Formula of Homebrew. Not tried: there is no macOS among the machines where the project is tested.
# It needs the address and the sum of a release.
class Dem2buildings < Formula
  desc "Building footprints from the elevation raster of a city"
  homepage "https://example.org/dem2buildings"
  url "https://example.org/dem2buildings/dem2buildings-0.1.0.tar.gz"
  sha256 "0000000000000000000000000000000000000000000000000000000000000000"
  license "MIT"

  depends_on "cmake" => :build
  depends_on "eigen" => :build
  depends_on "nlohmann-json" => :build
  depends_on "pkgconf" => :build
  depends_on "boost"
  depends_on "gdal"
  depends_on "geographiclib"
  depends_on "geos"
  depends_on "pango"
  depends_on "proj"
  depends_on "sqlite"

  def install
    system "cmake", "-S", ".", "-B", "build", "-DD2B_BUILD_TESTS=OFF", "-DD2B_BUILD_MESH=OFF", *std_cmake_args
    system "cmake", "--build", "build"
    system "cmake", "--install", "build"
  end

  test do
    system bin/"dem2buildings", "-q", share/"dem2buildings/sample_dems/town.tif", "town.gpkg"
    assert_path_exists testpath/"town.gpkg"
  end
end

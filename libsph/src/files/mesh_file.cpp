#include "files/mesh_file.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/importerdesc.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <fmt/format.h>

#include <algorithm>
#include <assimp/Importer.hpp>
#include <cctype>
#include <cmath>
#include <cstring>
#include <fstream>
#include <iterator>
#include <span>
#include <sstream>
#include <string_view>
#include <unordered_set>
#include <utility>
#include <vector>

#include "files/content_hash.hpp"
#include "sph/core/error.hpp"

namespace sph {
namespace {

/// Twice the area of a triangle over its longest edge squared: below it is a line.
constexpr double least_shape = 1e-9;

using Corner = std::array<double, 3>;

bool is_line(const Corner& a, const Corner& b, const Corner& c) {
  double u[3], v[3], longest = 0, area = 0;
  double edges[3] = {};
  for (std::size_t k = 0; k < 3; ++k) {
    u[k] = b[k] - a[k];
    v[k] = c[k] - a[k];
    edges[0] += u[k] * u[k];
    edges[1] += v[k] * v[k];
    edges[2] += (c[k] - b[k]) * (c[k] - b[k]);
  }
  longest = *std::max_element(edges, edges + 3);
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t m = (k + 1) % 3, n = (k + 2) % 3;
    const double w = u[m] * v[n] - u[n] * v[m];
    area += w * w;
  }
  return !(std::sqrt(area) > least_shape * longest);
}

class Welded {
 public:
  explicit Welded(const std::string& what) : what_(what) {}

  void add(const aiMesh& mesh) {
    for (unsigned f = 0; f < mesh.mNumFaces; ++f) {
      const aiFace& face = mesh.mFaces[f];
      ++facet_;
      if (face.mNumIndices != 3) refuse("has no three corners");
      std::array<std::uint32_t, 3> corners{};
      for (std::size_t k = 0; k < 3; ++k) corners[k] = number_of(mesh.mVertices[face.mIndices[k]]);
      const auto& v = all_.vertices;
      if (is_line(v[corners[0]], v[corners[1]], v[corners[2]])) refuse("has no area");
      all_.corners.push_back(corners);
    }
  }
  [[nodiscard]] Triangles take() { return std::move(all_); }

 private:
  std::uint32_t number_of(const aiVector3D& v) {
    const Corner at{v.x + 0.0, v.y + 0.0, v.z + 0.0};  // + 0: no -0
    for (double c : at)
      if (!std::isfinite(c)) refuse("has a corner that is no number");
    // As one more vertex, until one at the same place is found.
    all_.vertices.push_back(at);
    const auto [found, is_new] = numbers_.insert(static_cast<std::uint32_t>(all_.vertices.size() - 1));
    if (!is_new) all_.vertices.pop_back();
    return *found;
  }
  [[noreturn]] void refuse(std::string_view why) const {
    throw InputError(fmt::format("{}: facet {} {}; repair the mesh", what_, facet_, why));
  }

  std::string what_;
  Triangles all_;
  struct Hash {
    const std::vector<Corner>* vertices;
    std::size_t operator()(std::uint32_t v) const {
      return content_hash(std::as_bytes(std::span((*vertices)[v])));
    }
  };
  struct SamePlace {
    const std::vector<Corner>* vertices;
    bool operator()(std::uint32_t a, std::uint32_t b) const { return (*vertices)[a] == (*vertices)[b]; }
  };
  std::unordered_set<std::uint32_t, Hash, SamePlace> numbers_{16, Hash{&all_.vertices},
                                                              SamePlace{&all_.vertices}};
  std::uint64_t facet_ = 0;
};

/// Of the mesh alone: an OBJ's materials are none of ours, and may be pipes.
class OneFile : public Assimp::DefaultIOSystem {
 public:
  explicit OneFile(std::string path) : path_(std::move(path)) {}
  bool Exists(const char* file) const override { return file == path_ && DefaultIOSystem::Exists(file); }
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    return file == path_ ? DefaultIOSystem::Open(file, mode) : nullptr;
  }

 private:
  std::string path_;
};

/// It has the length that its count says, or the importer takes it for one of text.
bool is_stl_of_numbers(std::string_view content) {
  constexpr std::uint64_t head = 80, facet = 50;
  std::uint32_t count = 0;
  if (content.size() < head + sizeof count) return false;
  std::memcpy(&count, content.data() + head, sizeof count);
  return content.size() == head + sizeof count + facet * count;
}

bool ends_as_stl(std::string_view text) {
  const std::size_t end = text.find_last_not_of(" \t\r\n");
  if (end == std::string_view::npos) return false;
  const std::string_view last = text.substr(text.find_last_of("\r\n", end) + 1);
  constexpr std::string_view closing = "endsolid";
  const auto same = [](char c, char small) { return std::tolower(static_cast<unsigned char>(c)) == small; };
  return std::search(last.begin(), last.end(), closing.begin(), closing.end(), same) != last.end();
}

/// How many there are. The importer leaves out a fourth corner, and takes a third from the next facet.
std::size_t count_triangles(std::string text, const std::string& what) {
  std::istringstream words(std::move(text));
  std::size_t facets = 0, corners = 3;
  bool open = false;
  const auto close = [&] {
    if (open && corners != 3)
      throw InputError(
          fmt::format("{}: facet {} has {} corners; make triangles of it", what, facets, corners));
    open = false;
  };
  for (std::string before, word; words >> word; before = word) {
    if (open && word == "vertex") ++corners;
    if (word == "endfacet") close();
    if (before != "facet" || word != "normal") continue;
    close();
    ++facets;
    open = true;
    corners = 0;
  }
  close();
  return facets;
}

/// `read`: the facets that the importer found, which ends where it does not know the words.
void refuse_broken_stl(const std::string& path, const std::string& what, std::size_t read) {
  std::ifstream in(path, std::ios::binary);
  std::string content((std::istreambuf_iterator<char>(in)), std::istreambuf_iterator<char>());
  if (is_stl_of_numbers(content)) return;
  if (!ends_as_stl(content))
    throw InputError(what + ": ends before its last facet does; give the whole file");
  if (const std::size_t all = count_triangles(std::move(content), what); all != read)
    throw InputError(fmt::format(
        "{}: {} of {} facets can be read; begin each solid with a line \"solid NAME\"", what, read, all));
}

/// The importer leaves a vertex out that is no three numbers: facets would have others than they name.
void refuse_broken_vertex(const std::string& path, const std::string& what) {
  std::ifstream in(path, std::ios::binary);
  std::string text;
  for (std::size_t line = 1; std::getline(in, text); ++line) {
    std::istringstream words(text);
    std::string first;
    double x = 0, y = 0, z = 0;
    if (words >> first && first == "v" && !(words >> x >> y >> z))
      throw InputError(
          fmt::format("{}: line {} is of a vertex and has no three numbers; repair the mesh", what, line));
  }
}

}  // namespace

Triangles read_triangles(const std::string& path, const std::string& what) {
  Assimp::Importer importer;
  importer.SetIOHandler(new OneFile(path));  // the importer's from then on
  const aiScene* scene = importer.ReadFile(path, aiProcess_Triangulate);
  if (scene == nullptr) {
    refuse_broken_vertex(path, what);
    throw InputError(
        fmt::format("{}: cannot be read: {}; give an STL or OBJ file", what, importer.GetErrorString()));
  }
  const int reader = importer.GetPropertyInteger("importerIndex", -1);
  const aiImporterDesc* format =
      reader < 0 ? nullptr : importer.GetImporterInfo(static_cast<std::size_t>(reader));
  const std::string_view endings = format != nullptr ? format->mFileExtensions : "";
  if (endings != "stl" && endings != "obj")
    throw InputError(fmt::format("{}: is of another format ({}); give an STL or OBJ file", what,
                                 format != nullptr ? format->mName : "unknown"));
  std::size_t facets = 0;
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) facets += scene->mMeshes[m]->mNumFaces;
  if (endings == "stl") refuse_broken_stl(path, what, facets);
  if (endings == "obj") refuse_broken_vertex(path, what);
  Welded welded(what);
  for (unsigned m = 0; m < scene->mNumMeshes; ++m) welded.add(*scene->mMeshes[m]);
  Triangles all = welded.take();
  if (all.corners.empty()) throw InputError(what + ": holds no triangles; give an STL or OBJ file");
  return all;
}

std::string hash_of_file(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  if (!in) return {};
  const std::uint64_t hash = content_hash(in);
  return in.bad() ? std::string() : to_hex(hash);
}

}  // namespace sph

// Normals of files that have none, or none of use.
#include "content/models/normals.h"
#include "small_world.h"

#include <cmath>
#include <sstream>

namespace {

using namespace small_world;

/// A sphere without normals whose vertices are shared by all faces around them.
struct Sphere {
    std::vector<Vec3d> vertices{{0, 1, 0}, {0, -1, 0}};
    std::vector<std::array<std::size_t, 3>> faces;

    Sphere() {
        constexpr std::size_t columns = 48, rows = 23;
        const auto at = [](std::size_t i, std::size_t j) { return 2 + j * columns + i % columns; };
        for (std::size_t j = 0; j < rows; ++j)
            for (std::size_t i = 0; i < columns; ++i) {
                const double polar = M_PI * double(j + 1) / (rows + 1), around = 2 * M_PI * double(i) / columns;
                vertices.push_back({std::sin(polar) * std::sin(around), std::cos(polar), std::sin(polar) * std::cos(around)});
            }
        for (std::size_t i = 0; i < columns; ++i) {
            faces.push_back({0, at(i, 0), at(i + 1, 0)});
            faces.push_back({1, at(i + 1, rows - 1), at(i, rows - 1)});
            for (std::size_t j = 0; j + 1 < rows; ++j) {
                faces.push_back({at(i, j), at(i, j + 1), at(i + 1, j + 1)});
                faces.push_back({at(i, j), at(i + 1, j + 1), at(i + 1, j)});
            }
        }
    }

    std::string vertices_text() const {
        std::ostringstream text;
        for (const Vec3d& p : vertices) text << p[0] << ' ' << p[1] << ' ' << p[2] << '\n';
        return text.str();
    }
    std::string faces_text() const {
        std::ostringstream text;
        for (const auto& f : faces) text << "3 " << f[0] << ' ' << f[1] << ' ' << f[2] << '\n';
        return text.str();
    }
};

// The mean of the faces' normals about a vertex is within 2 degrees of the sphere's, that of one face 4 degrees and more away.
TEST(Normals, SharedVerticesAreSmoothed) {
    const Sphere sphere;
    std::ostringstream ply, off;
    ply << "ply\nformat ascii 1.0\nelement vertex " << sphere.vertices.size()
        << "\nproperty float x\nproperty float y\nproperty float z\nelement face " << sphere.faces.size()
        << "\nproperty list uchar int vertex_indices\nend_header\n"
        << sphere.vertices_text() << sphere.faces_text();
    off << "OFF\n"
        << sphere.vertices.size() << ' ' << sphere.faces.size() << " 0\n"
        << sphere.vertices_text() << sphere.faces_text();
    const Folder folder;
    for (const auto& [name, text] : {std::pair("s.ply", ply.str()), {"s.off", off.str()}}) {
        const auto model = load_model(folder.write(name, text));
        ASSERT_EQ(model->triangles(), sphere.faces.size()) << name;
        for (std::size_t v = 0; v < model->vertices(); ++v) {
            const float *const p = &model->positions[3 * v], *const n = &model->normals[3 * v];
            EXPECT_GT(p[0] * n[0] + p[1] * n[1] + p[2] * n[2], std::cos(2 * M_PI / 180)) << name << ", vertex " << v;
        }
    }
}

// Many programs write STL with normals (0, 0, 0).
TEST(Normals, ZeroOnesAreThoseOfTheTriangles) {
    const Sphere sphere;
    std::ostringstream stl;
    stl << "solid s\n";
    for (const auto& f : sphere.faces) {
        stl << "facet normal 0 0 0\nouter loop\n";
        for (const std::size_t v : f)
            stl << "vertex " << sphere.vertices[v][0] << ' ' << sphere.vertices[v][1] << ' ' << sphere.vertices[v][2] << '\n';
        stl << "endloop\nendfacet\n";
    }
    stl << "endsolid s\n";
    const Folder folder;
    const auto model = load_model(folder.write("s.stl", stl.str()));
    Model flat = *model;
    make_flat(flat);
    ASSERT_EQ(model->triangles(), sphere.faces.size());
    for (std::size_t i = 0; i < model->indices.size(); ++i)
        for (std::size_t c = 0; c < 3; ++c)
            EXPECT_NEAR(model->normals[3 * std::size_t(model->indices[i]) + c], flat.normals[3 * i + c], 1e-3) << "corner " << i;
}

}  // namespace
